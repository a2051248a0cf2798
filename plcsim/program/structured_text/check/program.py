"""Checking all files of a program, or of a library in Structured Text."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.check.findings import FileFindings
from plcsim.program.structured_text.check.initialisers import Initialisers
from plcsim.program.structured_text.check.kinds import plain
from plcsim.program.structured_text.check.names import ScopeNames, named
from plcsim.program.structured_text.check.programs import ALL_PROGRAMS, MeantProgram
from plcsim.program.structured_text.check.recursion import in_cycles
from plcsim.program.structured_text.check.statements import StatementChecker
from plcsim.program.structured_text.check.surroundings import Surroundings
from plcsim.program.structured_text.check.units import BodyJob, BodyOwner, UnitCollector
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.program_uses import program_uses
from st_types.resolve.declared import DeclaredFunction
from st_types.syntax.collector import collector_paused

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from plcsim.program.structured_text.check.classes import ClassMethod
    from plcsim.program.structured_text.check.open_arrays import OpenFunction
    from plcsim.program.structured_text.check.typed import Storage
    from plcsim.program.structured_text.syntax.tree import StructuredTextFile
    from st_types.resolve.declared import DeclaredFunctionBlock
    from st_types.resolve.scope import Scope

QUIET: Final = frozenset([FindingCode.UNUSED_VARIABLE, FindingCode.NARROWED])
"""Warnings that are told on demand only: sound programs are full of what they mean."""


@collector_paused()
def check_program(
    name: str,
    files: Sequence[StructuredTextFile],
    scope: Scope,
    *,
    hidden: Collection[FindingCode] = QUIET,
    storage: Storage = "program",
    meant: MeantProgram = ALL_PROGRAMS,
) -> typed.CheckedProgram:
    """Check all bodies of a program; findings go to the ``diagnostics`` of the files.

    Actions that nothing calls are left out, as Automation Studio leaves them out.

    Args:
        name: of the program or the library.
        files: parsed without errors.
        scope: what the program declares, what stands in the files (`declarations_of`) included.
        hidden: codes of warnings that are not wanted.
        storage: of the variables of the scope; those of a library are global ones.
        meant: of several PROGRAMs the one that is compiled.
    """
    checker = _ProgramChecker(scope, hidden, storage, meant)
    checker.uses = program_uses(file.tokens.source.text for file in files)
    checker.connected = meant.configured(files)
    for file in files:
        checker.add(file)
    bodies = checker.bodies()
    storages = checker.symbols.storages
    own = [each for each, storage in storages.items() if storage == "program"]
    return typed.CheckedProgram(name, bodies, own)


class _ProgramChecker(UnitCollector):
    """Checks the bodies."""

    def bodies(self) -> list[typed.CheckedBody]:
        """Check what is needed: actions as soon as something calls them."""
        found: list[typed.CheckedBody] = []
        self._take_named_actions()
        for each in self.symbols.classes.values():
            base = self._scope.find_function_block(each.block.node.base)
            if each.block.node.base and base is not None and base.data_type is not None:
                each.base = self.symbols.classes.get(base.data_type)
        self._set_up_instances()
        waiting = [job for job in reversed(self._jobs) if job.is_needed]
        while waiting:
            waiting += self._check(waiting.pop(), found)
        for job in self._jobs:
            if not job.is_needed and not self._is_called_outside(job):
                findings = FileFindings(job.file.tokens, job.file.diagnostics, self._hidden)
                message = f"nothing calls the action {job.name}; it is not compiled"
                findings.warning(job.unit, FindingCode.NEVER_CALLED, message)
        for job in self._jobs:
            if job.body is not None and job.kind in ("unit", "block"):
                found += self._surrounded(job, job.body)
        self._note_recursion()
        self._check_used()
        return found

    def _set_up_instances(self) -> None:
        """Call the FB_init of all instances at the beginning of INIT."""
        jobs = [job for job in self._jobs if job.kind == "unit"]
        if not jobs:
            return
        owner = jobs[0].owner
        calls = Initialisers(self.symbols.classes, self._hidden).calls(owner.scope.chain)
        init = next((job for job in jobs if job.name == "init"), None)
        if calls and init is not None:
            init.nodes = [*calls, *init.nodes]
        elif calls:
            self._jobs.append(replace(jobs[0], name="init", nodes=calls, calls=set()))

    def _surrounded(self, job: BodyJob, body: typed.CheckedBody) -> list[typed.CheckedBody]:
        """Surround a body by what happens before and after it; it becomes an action then.

        Returns:
            that action, where there is anything.
        """
        around = Surroundings(body.line)
        if self.symbols.name_addresses():
            findings = FileFindings(job.file.tokens, job.file.diagnostics, self._hidden)
            names = ScopeNames(job.owner.scope, self.symbols, findings)
            is_once = job.kind == "unit" or job.name.upper() in self.uses.named
            own = (job.owner.scope,) if job.kind == "block" else job.owner.scope.chain
            around.add_addresses(names, own, is_once=is_once)
        has_own = job.kind == "unit" and job.owner.scope is not self._scope
        if has_own and self.connected is not None:
            file, program = self.connected
            findings = FileFindings(file.tokens, file.diagnostics, self._hidden)
            inner = self._checker(job.owner, findings)
            around.add_connections(program, inner, self._checker(self._program, findings))
        return around.of(body)

    def _checker(self, owner: BodyOwner, findings: FileFindings) -> StatementChecker:
        """Return what checks statements that stand elsewhere than the bodies of an owner."""
        return StatementChecker(ScopeNames(owner.scope, self.symbols, findings), findings, {})

    def _is_called_outside(self, job: BodyJob) -> bool:
        """Return whether an action of a function block is called by an instance of it."""
        this, key = job.owner.this, self._scope.dialect.key(job.name)
        return this is not None and f"{this.block.name}.{key}" in self._methods

    def _check_used(self) -> None:
        """Tell which variables of the program, of functions and of blocks nothing names.

        Parameters are there for others.
        """
        for scope in self.symbols.storages:
            for entry in scope.index.variables:
                if entry.block.section not in _OWN or self.symbols.is_used(entry):
                    continue
                file = entry.resolver.file
                if FindingCode.UNUSED_VARIABLE not in self._hidden:
                    message = f"nothing uses {entry.name}"
                    offset = file.tokens.offset(entry.node.at)
                    file.diagnostics.warning(offset, message, "", FindingCode.UNUSED_VARIABLE)

    def _note_recursion(self) -> None:
        """Note which functions and methods call themselves."""
        calls: dict[str, set[str]] = {}
        for job in self._jobs:
            calls.setdefault(job.label, set()).update(job.calls)
        recursive = in_cycles(calls)
        for job in self._jobs:
            if job.body is not None:
                job.body.is_recursive = job.label in recursive

    def _check(self, job: BodyJob, into: list[typed.CheckedBody]) -> list[BodyJob]:
        """Check a body and return the actions that it is the first to call."""
        owner = job.owner
        findings = FileFindings(job.file.tokens, job.file.diagnostics, self._hidden)
        names = ScopeNames(owner.scope, self.symbols, findings)
        names.values = self._values.setdefault(owner.scope, {})
        result = self._result(job, names)
        checker = StatementChecker(
            names, findings, {key: each.name for key, each in self._callable(owner).items()}
        )
        checker.this, checker.maker = owner.this, job.maker or owner.this
        checker.texts_are_addresses = job.file.texts_are_addresses
        line = findings.line(job.unit)
        statements = checker.statements(job.nodes)
        body = typed.CheckedBody(job.name, job.kind, job.file.path, line, statements, owner.block)
        body.result = result
        if job.kind != "action":
            body.parameters, body.locals = self._variables(owner.scope)
            for symbol in body.locals:
                symbol.has_address |= bool(owner.actions)  # VAR_TEMP, which they know as well
        body.locals = [*body.locals, *checker.temporaries]
        into.append(body)
        called = [self._action_of(owner, name) for name in sorted(checker.called_actions)]
        job.body, job.calls = body, checker.called_bodies | {action.label for action in called}
        found = [action for action in called if not action.is_needed]
        for action in found:
            action.is_needed = True
        found += self._called_open(checker.called_open)
        return [*found, *self._called_methods(checker.called_methods)]

    def _called_open(
        self, called: Mapping[str, tuple[OpenFunction, DeclaredFunction | DeclaredFunctionBlock]]
    ) -> Iterator[BodyJob]:
        """Yield what is called for the first time with arrays of such bounds."""
        for label, (made_of, made) in called.items():
            if label not in self._methods:
                self._methods.add(label)
                unit, file = made_of.unit, made_of.file
                if isinstance(made, DeclaredFunction):
                    self.symbols.storages[made.scope] = "frame"
                    owner = BodyOwner(made.scope)
                    job = BodyJob(label, "function", unit, unit.body, file, owner, made)
                else:
                    self.symbols.storages[made.scope] = "instance"
                    owner = BodyOwner(made.scope, made.data_type)
                    job = BodyJob(label, "block", unit, unit.body, file, owner)
                self._jobs.append(job)
                yield job

    def _called_methods(self, methods: Mapping[str, ClassMethod]) -> Iterator[BodyJob]:
        """Yield the methods that are called for the first time."""
        for label, method in methods.items():
            if label in self._methods:
                continue
            self._methods.add(label)
            around = self._owners[method.owner]
            scope = method.function.scope
            self.symbols.storages[scope] = "frame"
            owner = BodyOwner(scope, around.block, around.actions, method.owner)
            unit, file = method.unit, method.maker.file
            job = BodyJob(label, "method", unit, unit.body, file, owner, method.function)
            job.maker = method.maker
            self._jobs.append(job)
            yield job

    def _callable(self, owner: BodyOwner) -> Mapping[str, BodyJob]:
        """Return the actions that bodies can call.

        In a library those of a function block may stand in a file of their own: they belong to
        each block that calls them.
        """
        if owner.block is None or any(job.kind == "unit" for job in self._jobs):
            return owner.actions
        return {**self._program.actions, **owner.actions}

    def _action_of(self, owner: BodyOwner, name: str) -> BodyJob:
        """Return an action of an owner, which becomes its own if it stands in another file."""
        if name not in owner.actions:
            job = self._program.actions[name]
            job.is_needed = True
            owner.actions[name] = replace(job, owner=owner, is_needed=False, calls=set())
        return owner.actions[name]

    @staticmethod
    def _result(job: BodyJob, names: ScopeNames) -> typed.Symbol | None:
        if job.function is None or job.function.result is None:
            return None
        data_type = plain(job.function.result)
        name = job.function.node.name
        result = typed.Symbol(name, data_type, "frame", names.scope, used=True)
        names.values[name] = named(result)
        return result

    def _variables(self, scope: Scope) -> tuple[list[typed.Symbol], list[typed.Symbol]]:
        """Return the parameters and the other variables that live for one call."""
        parameters: list[typed.Symbol] = []
        others: list[typed.Symbol] = []
        for entry in scope.index.variables:
            symbol = self.symbols.of(entry)
            if symbol is not None and symbol.storage == "frame":
                is_parameter = entry.block.section in _PARAMETERS
                (parameters if is_parameter else others).append(symbol)
        return parameters, others


_OWN = frozenset(["VAR", "VAR_TEMP", "VAR_STAT"])
"""Sections whose variables are there for the bodies alone."""

_PARAMETERS = frozenset(["VAR_INPUT", "VAR_IN_OUT", "VAR_OUTPUT"])
