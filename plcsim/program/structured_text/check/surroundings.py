"""What happens before and after a body: variables AT addresses, connections of a CONFIGURATION."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.check.kinds import plain
from plcsim.program.structured_text.check.located import MOST_VALUES, synchronised, values_in
from plcsim.program.structured_text.codes import FindingCode
from st_types.resolve.index import VariableEntry
from st_types.syntax import expressions as syntax

if TYPE_CHECKING:
    from collections.abc import Iterable

    from plcsim.program.structured_text.check.names import ScopeNames
    from plcsim.program.structured_text.check.statements import StatementChecker
    from plcsim.program.structured_text.check.typed import Statement
    from plcsim.program.structured_text.syntax.tree import ProgramConfiguration
    from st_types.resolve.scope import Scope


class Surroundings:
    """What happens before and after one body.

    Args:
        line: of the body.
    """

    def __init__(self, line: int) -> None:
        self._line = line
        self._before: list[Statement] = []
        self._after: list[Statement] = []

    def of(self, body: typed.CheckedBody) -> list[typed.CheckedBody]:
        """Surround a body; return the action that holds its statements then, if there is one."""
        if not self._before and not self._after:
            return []
        own = replace(body, name=f"body of {body.name}", kind="action")
        call = typed.CallAction(body.line, own.name)
        body.statements = [*self._before, call, *self._after]
        body.locals = ()
        return [own]

    def add_addresses(self, names: ScopeNames, scopes: Iterable[Scope], *, is_once: bool) -> None:
        """Let the variables AT addresses show what lies there.

        Args:
            names: of the body.
            scopes: that declare the variables.
            is_once: the body has one instance, so that what changes its variables from outside
                is meant for the address.
        """
        for scope in scopes:
            for entry in scope.index.variables:
                direct = names.direct(entry)
                symbol = names.symbols.of(entry)
                if direct is None or symbol is None or symbol.storage == "frame":
                    continue
                if values_in(plain(symbol.type)) > MOST_VALUES:
                    _refuse(entry)
                    continue
                variable = typed.Variable(symbol.type, symbol)
                before, after = synchronised(self._line, variable, direct)
                self._before += before if is_once else ()
                self._after += after

    def add_connections(
        self, connected: ProgramConfiguration, inner: StatementChecker, outer: StatementChecker
    ) -> None:
        """Take the connections of a PROGRAM.

        Args:
            connected: what its CONFIGURATION says.
            inner: knows the names of the PROGRAM.
            outer: knows those of the CONFIGURATION, and takes what is wrong.
        """
        line = outer.findings.line(connected)
        inputs = (e for e in inner.names.scope.index.variables if e.block.section == "VAR_INPUT")
        for argument in connected.arguments:
            name = argument.name or next((entry.name for entry in inputs), "")
            wanted = "VAR_OUTPUT" if argument.is_output else "VAR_INPUT"
            if _section_of(name, inner.names.scope) != wanted or argument.value is None:
                kind = "output" if argument.is_output else "input"
                message = f"{connected.type_name} has no {kind} {name}"
                outer.error(argument, FindingCode.UNKNOWN_PARAMETER, message)
                continue
            variable = inner.value(syntax.Name(connected.at, name))
            if argument.is_output:
                target = outer.assigned(argument.value)
                outer.check_fit(argument.value, variable, target.type)
                self._after.append(typed.Assign(line, target, variable))
            else:
                value = outer.value(argument.value)
                self._before.append(outer.assignment(argument.value, variable, value, line))


def _refuse(entry: VariableEntry) -> None:
    file = entry.resolver.file
    offset = file.tokens.offset(entry.node.at)
    message = f"{entry.name} has more than {MOST_VALUES} values: not supported AT an address"
    file.diagnostics.error(offset, message, "", FindingCode.NOT_SUPPORTED)


def _section_of(name: str, scope: Scope) -> str:
    """Return the section of a variable of a PROGRAM, "" where it has none of this name."""
    hit = scope.lookup("variables", name)
    entry: object = None if hit is None else hit.entry
    if isinstance(entry, VariableEntry) and entry.resolver.scope is scope:
        return entry.block.section
    return ""
