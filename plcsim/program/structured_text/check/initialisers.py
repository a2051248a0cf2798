"""FB_init: the method that sets up each instance of a function block before the first cycle.

What a declaration gives to it, ``x : Block(start := 7)``, is evaluated where the instance is
declared in a program, or around it. Its two inputs of CODESYS, bInitRetains and bInCopyCode, are
FALSE: no memory is kept, no code is changed online. A block that extends another one is set up
after it, and members before what holds them.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.check.findings import FileFindings
from plcsim.program.structured_text.check.kinds import plain
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.syntax.tree import ExpressionStatement
from st_types.syntax.expressions import Argument, Call, Index, Literal, MemberAccess, Name
from st_types.syntax.literals import Constant
from st_types.syntax.tree import ArraySpecification, NamedType
from st_types.types.derived import ArrayType, DataBlockType, StructType

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

    from plcsim.program.structured_text.check.classes import Class, Classes
    from plcsim.program.structured_text.check.kinds import Type
    from st_types.resolve.index import VariableEntry
    from st_types.resolve.scope import Scope
    from st_types.syntax.expressions import Expression
    from st_types.syntax.tree import TypeSpecification

KEY: Final = "FB_INIT"
MAX_INSTANCES: Final = 10_000
"""Instances that one variable sets up; a program of more is more likely wrong than meant."""

_IMPLIED: Final = ("BINITRETAINS", "BINCOPYCODE")
_NONE_HERE: Final = frozenset(["VAR_EXTERNAL", "VAR_TEMP", "VAR_IN_OUT", "VAR_INST"])


@dataclass(slots=True, eq=False)
class Initialisers:
    """Makes the calls of FB_init.

    Args:
        classes: the function blocks of the program, with their bases.
        hidden: codes of warnings that are not wanted.
    """

    classes: Classes
    hidden: Collection[FindingCode]
    _wanted: dict[Type, bool] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for each in self.classes.values():
            if KEY in each.methods:  # apart from the others', for each of a line is called
                each.methods[_label(each)] = each.methods[KEY]

    def calls(self, scopes: Iterable[Scope]) -> list[ExpressionStatement]:
        """Return the calls for all instances among the variables of some scopes."""
        if not any(KEY in each.methods for each in self.classes.values()):
            return []
        entries = (entry for scope in scopes for entry in scope.index.variables)
        return [call for entry in entries for call in self._of_variable(entry)]

    def _of_variable(self, entry: VariableEntry) -> Iterator[ExpressionStatement]:
        entry.resolver.complete(entry)
        if entry.block.section in _NONE_HERE or entry.data_type is None:
            return
        at = entry.node.at
        specification = entry.node.specification
        made = self._of_type(at, Name(at, entry.name), entry.data_type, specification)
        for number, each in enumerate(made):
            if number == MAX_INSTANCES:
                file = entry.resolver.file
                findings = FileFindings(file.tokens, file.diagnostics, self.hidden)
                message = f"{entry.name} has more than {MAX_INSTANCES} instances with FB_init"
                findings.error(entry.node, FindingCode.NOT_SUPPORTED, f"{message}: not supported")
                return
            yield each

    def _is_wanted(self, data_type: Type) -> bool:
        """Return whether a value of a type holds an instance that is to be set up."""
        data_type = plain(data_type)
        found = self._wanted.get(data_type)
        if found is None:
            self._wanted[data_type] = False
            found = self._has_own(data_type)
            if isinstance(data_type, ArrayType):
                found = self._is_wanted(data_type.element)
            elif isinstance(data_type, StructType):
                found = found or any(self._is_wanted(each.data_type) for each in data_type.members)
            self._wanted[data_type] = found
        return found

    def _has_own(self, data_type: Type) -> bool:
        own = self.classes.get(data_type) if isinstance(data_type, DataBlockType) else None
        return own is not None and any(KEY in each.methods for each in own.line())

    def _of_type(
        self, at: int, path: Expression, data_type: Type, node: TypeSpecification | None
    ) -> Iterator[ExpressionStatement]:
        data_type = plain(data_type)
        if not self._is_wanted(data_type):
            return
        if isinstance(data_type, ArrayType):
            yield from self._of_array(at, path, data_type, node)
            return
        assert isinstance(data_type, StructType)
        own = self.classes.get(data_type) if isinstance(data_type, DataBlockType) else None
        declared = _specifications(own)
        for member in data_type.members:
            inner = MemberAccess(at, path, member.name)
            yield from self._of_type(at, inner, member.data_type, declared.get(member.name))
        if own is not None:
            given = node.given[0] if isinstance(node, NamedType) and node.given else ()
            yield from self._of_instance(at, path, own, given)

    def _of_array(
        self,
        at: int,
        path: Expression,
        data_type: ArrayType[object],
        node: TypeSpecification | None,
    ) -> Iterator[ExpressionStatement]:
        element = node.element if isinstance(node, ArraySpecification) else None
        given = element.given if isinstance(element, NamedType) else ()
        places = product(*(range(low, high + 1) for low, high in data_type.bounds))
        for number, place in enumerate(places):
            numbers = [Literal(at, str(n), Constant("ANY_INT", n)) for n in place]
            one = element
            if isinstance(element, NamedType) and len(given) > 1:
                one = NamedType(element.at, element.name, given[number : number + 1])
            yield from self._of_type(at, Index(at, path, numbers), data_type.element, one)

    def _of_instance(
        self, at: int, path: Expression, own: Class, given: Sequence[Argument]
    ) -> Iterator[ExpressionStatement]:
        makers = [each for each in own.line() if KEY in each.methods]
        for maker in reversed(makers):
            inputs = [
                declaration.name
                for block in maker.methods[KEY].declaration.blocks
                if block.section == "VAR_INPUT"
                for declaration in block.declarations
            ]
            implied = [name for name in inputs if name.upper() in _IMPLIED]
            others = (name for name in inputs if name.upper() not in _IMPLIED)
            no = Literal(at, "FALSE", Constant("BOOL", value=False))
            arguments = [Argument(at, name, no) for name in implied]
            for each in given:
                name = each.name or next(others, "")
                if maker is makers[0] or name in inputs:
                    arguments.append(Argument(each.at, name, each.value))
            function = MemberAccess(at, path, _label(maker))
            yield ExpressionStatement(at, Call(at, function, arguments))


def _label(each: Class) -> str:
    """Return how the FB_init of one block is called; no name in a program has a point."""
    return f"{each.block.name}.{KEY}".upper()


def _specifications(own: Class | None) -> dict[str, TypeSpecification]:
    """Return how the members of a function block, and of what it extends, are declared."""
    lines = [] if own is None else list(own.line())
    return {
        entry.name: entry.node.specification
        for each in reversed(lines)
        for entry in each.block.scope.index.variables
    }
