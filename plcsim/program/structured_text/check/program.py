"""Checking all files of a program, or of a library in Structured Text."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import PurePath
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.check.classes import (
    BODY,
    GET,
    SET,
    Class,
    ClassInterface,
    action_as_method,
    body_as_method,
    interface_type,
    key_of_method,
)
from plcsim.program.structured_text.check.findings import FileFindings
from plcsim.program.structured_text.check.initialisers import Initialisers
from plcsim.program.structured_text.check.kinds import plain
from plcsim.program.structured_text.check.names import ScopeNames, Symbols, named
from plcsim.program.structured_text.check.open_arrays import OpenFunction, takes_any_bounds
from plcsim.program.structured_text.check.programs import (
    ALL_PROGRAMS,
    MeantProgram,
    as_block,
    call_of,
    instance_of,
    is_shared,
)
from plcsim.program.structured_text.check.recursion import needs_memory, reaches
from plcsim.program.structured_text.check.statements import StatementChecker
from plcsim.program.structured_text.check.surroundings import Surroundings
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.program_uses import NO_USES, UNITS, program_uses
from plcsim.program.structured_text.syntax.tree import (
    ActionUnit,
    Configuration,
    FunctionBlockUnit,
    FunctionUnit,
    Include,
    InterfaceUnit,
    MethodUnit,
    NamespaceUnit,
    ProgramUnit,
    UnsupportedUnit,
)
from st_types.resolve.scope import Scope
from st_types.syntax.collector import collector_paused
from st_types.syntax.tree import (
    DeclarationFile,
    FunctionDeclaration,
    TypeBlock,
    VariableBlock,
)
from st_types.types.derived import StructType

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

    from plcsim.program.structured_text.check.classes import ClassMethod
    from plcsim.program.structured_text.check.typed import BodyKind, Storage, Value
    from plcsim.program.structured_text.program_uses import ProgramUses
    from plcsim.program.structured_text.syntax.tree import (
        Part,
        ProgramConfiguration,
        Statement,
        StructuredTextFile,
        Unit,
    )
    from st_types.resolve.declared import DeclaredFunction, DeclaredFunctionBlock
    from st_types.syntax.tree import Item
    from st_types.types.derived import DataBlockType

QUIET: Final = frozenset([FindingCode.UNUSED_VARIABLE, FindingCode.NARROWED])
"""Warnings that are told on demand only: sound programs are full of what they mean."""


def declarations_of(file: StructuredTextFile, uses: ProgramUses = NO_USES) -> DeclarationFile:
    """Return what a file of Structured Text declares, for a `Scope`.

    Functions and function blocks without VAR blocks of their own are declared in a .fun file.

    Args:
        file: parsed.
        uses: which PROGRAMs others name.
    """
    items: list[Item] = []
    for unit in file.units:
        if isinstance(unit, TypeBlock | VariableBlock):
            items.append(unit)
        elif isinstance(unit, FunctionUnit | FunctionBlockUnit) and _is_declared(unit):
            items.append(unit.declaration)
        elif isinstance(unit, ProgramUnit) and is_shared(unit, uses):
            items += [as_block(unit).declaration, instance_of(unit)]
        elif isinstance(unit, InterfaceUnit):
            items.append(interface_type(unit))
        elif isinstance(unit, Configuration):
            items += unit.blocks
            items += [block for resource in unit.resources for block in resource.blocks]
    return DeclarationFile(items, "", file.tokens, file.diagnostics)


def unit_scope(
    unit: ProgramUnit, file: StructuredTextFile, outer: Scope, uses: ProgramUses
) -> Scope | None:
    """Return the scope of the variables that a PROGRAM has for each task, None for none."""
    if not unit.blocks or is_shared(unit, uses):
        return None
    declared = DeclarationFile(unit.blocks, "", file.tokens, file.diagnostics)
    return Scope(unit.name, [declared], (outer,), dialect=outer.dialect, strict=outer.strict)


def _is_declared(unit: FunctionUnit | FunctionBlockUnit) -> bool:
    """Return True for a function (block) that has its parameters or its result beside its body.

    What takes arrays of any bounds is declared for each call.
    """
    declaration = unit.declaration
    if isinstance(declaration, FunctionDeclaration) and takes_any_bounds(declaration):
        return False
    if isinstance(unit, FunctionBlockUnit) and (unit.bases or unit.words or unit.parts):
        return True
    has_result = isinstance(declaration, FunctionDeclaration) and declaration.result is not None
    return has_result or bool(declaration.blocks)


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


@dataclass(slots=True, eq=False)
class _Owner:
    """What actions belong to: a program, or a function block with its data block."""

    scope: Scope
    block: DataBlockType[object] | None = None
    actions: dict[str, _Job] = field(default_factory=dict)
    this: Class | None = None


@dataclass(slots=True, eq=False)
class _Job:
    """A body that is to be checked."""

    name: str
    kind: BodyKind
    unit: Unit
    nodes: Sequence[Statement]
    file: StructuredTextFile
    owner: _Owner
    function: DeclaredFunction | None = None
    is_needed: bool = True
    maker: Class | None = None
    calls: set[str] = field(default_factory=set)
    body: typed.CheckedBody | None = None


class _ProgramChecker:
    def __init__(
        self, scope: Scope, hidden: Collection[FindingCode], storage: Storage, meant: MeantProgram
    ) -> None:
        self._meant = meant
        self.uses = NO_USES
        self.connected: tuple[StructuredTextFile, ProgramConfiguration] | None = None
        self.symbols = Symbols({scope: storage})
        self._scope = scope
        self._hidden = hidden
        self._values: dict[Scope, dict[str, Value | None]] = {}
        self._jobs: list[_Job] = []
        self._program = self._owner = _Owner(scope)
        self._taken: set[tuple[str, str]] = set()
        self._owners: dict[Class, _Owner] = {}
        self._methods: set[str] = set()
        self._programs: dict[str, _Owner] = {}
        self._named_actions: list[tuple[ActionUnit, StructuredTextFile]] = []

    def add(self, file: StructuredTextFile) -> None:
        """Take the units of a file."""
        self._file = file
        self._findings = FileFindings(file.tokens, file.diagnostics, self._hidden)
        self._owner = self._program
        self.symbols.namespaces.add(PurePath(file.path).stem.upper())
        for unit in file.units:
            _RULES[type(unit)](self, unit)

    def _is_new(self, unit: Unit, kind: str, name: str) -> bool:
        key = (kind, self._scope.dialect.key(name))
        if key in self._taken:
            self._findings.error(unit, FindingCode.DECLARED_TWICE, f"{name} is there twice")
            return False
        self._taken.add(key)
        return True

    # Units

    def _program_unit(self, unit: ProgramUnit) -> None:
        name = UNITS.get(unit.name.upper(), "cyclic")
        if is_shared(unit, self.uses):
            self._function_block(as_block(unit))
            is_called = not self._meant.name and unit.name.upper() in self.uses.called
            if self._meant.includes(unit) and not is_called and self._is_new(unit, "unit", name):
                connected = None if self.connected is None else self.connected[1]
                call = call_of(unit, connected)
                self._jobs.append(_Job(name, "unit", unit, [call], self._file, self._program))
            return
        if not self._meant.includes(unit):
            return
        self._owner = owner = self._program
        scope = unit_scope(unit, self._file, self._scope, self.uses)
        if scope is not None:
            scope.check()
            self.symbols.storages[scope] = "program"
            self._owner = owner = _Owner(scope, actions=owner.actions)
        self._programs[self._scope.dialect.key(unit.name)] = owner
        self._parts(unit.parts, owner)
        if self._is_new(unit, "unit", name):
            self._jobs.append(_Job(name, "unit", unit, unit.body, self._file, owner))

    def _parts(self, parts: Sequence[Part], owner: _Owner) -> None:
        for part in parts:
            if isinstance(part, ActionUnit):
                self._add_action(part, owner)
            elif isinstance(part, MethodUnit):
                self._add_method(part, owner)
            else:
                self._refused(part)

    def _action(self, unit: ActionUnit) -> None:
        """Take an action: behind a unit with variables of its own it belongs to that."""
        if "." in unit.name:
            self._named_actions.append((unit, self._file))
        else:
            self._add_action(unit, self._owner)

    def _take_named_actions(self) -> None:
        """Take the actions whose names begin with that of their owner."""
        key_of = self._scope.dialect.key
        owners = {key_of(each.block.name): each for each in self._owners.values() if each.block}
        owners |= self._programs
        for unit, file in self._named_actions:
            self._file = file
            self._findings = FileFindings(file.tokens, file.diagnostics, self._hidden)
            owner_name, _, name = unit.name.rpartition(".")
            owner = owners.get(key_of(owner_name))
            if owner is not None:
                self._add_action(replace(unit, name=name), owner)
            elif not self._meant.name:
                message = f"no PROGRAM or FUNCTION_BLOCK is called {owner_name}"
                self._findings.error(unit, FindingCode.UNKNOWN_NAME, message)

    def _add_action(self, unit: ActionUnit, owner: _Owner) -> None:
        block = "" if owner.block is None else f"{owner.block.name}."
        if self._is_new(unit, "action", block + unit.name):
            key = self._scope.dialect.key(unit.name)
            job = _Job(unit.name, "action", unit, unit.body, self._file, owner, is_needed=False)
            owner.actions[key] = job
            self._jobs.append(job)
            if owner.this is not None:
                owner.this.methods.setdefault(key, action_as_method(unit))

    def _function(self, unit: FunctionUnit) -> None:
        name = unit.declaration.name
        if takes_any_bounds(unit.declaration):
            if self._is_new(unit, "function", name):
                key = self._scope.dialect.key(name)
                found = OpenFunction(unit, self._file, self._scope)
                self.symbols.open_functions[key] = found
            return
        function = self._scope.find_function(name)
        if function is None:
            self._undeclared(unit, "FUNCTION", name)
        elif self._is_new(unit, "function", name):
            self.symbols.storages[function.scope] = "frame"
            owner = _Owner(function.scope)
            job = _Job(name, "function", unit, unit.body, self._file, owner, function)
            self._jobs.append(job)

    def _function_block(self, unit: FunctionBlockUnit) -> None:
        name = unit.declaration.name
        block = self._scope.find_function_block(name)
        if block is None or block.data_type is None:
            self._undeclared(unit, "FUNCTION_BLOCK", name)
        elif self._is_new(unit, "block", name):
            self.symbols.storages[block.scope] = "instance"
            self._refuse_sections(unit.declaration.blocks)
            own = self._class(unit, block, block.data_type)
            self._owner = owner = _Owner(block.scope, block.data_type, this=own)
            self._owners[own] = owner
            self._parts(unit.parts, owner)
            if "ABSTRACT" not in unit.words:
                self._jobs.append(_Job(name, "block", unit, unit.body, self._file, owner))

    def _class(
        self,
        unit: FunctionBlockUnit,
        block: DeclaredFunctionBlock,
        data_type: DataBlockType[object],
    ) -> Class:
        """Note a function block with its methods; its base is looked up when all are known."""
        found = self.symbols.classes[data_type] = Class(block, data_type, unit, self._file)
        found.methods[BODY] = body_as_method(unit)
        return found

    def _add_method(self, unit: MethodUnit, owner: _Owner) -> None:
        """Take a method, or an accessor of a property."""
        this, declaration = owner.this, unit.declaration
        if this is None:
            self._refused(unit)
            return
        self._refuse_sections(declaration.blocks)
        key = key_of_method(unit, self._scope.dialect.key(declaration.name))
        if "PROPERTY" in unit.words and not key.endswith((GET, SET)):
            return  # its accessors follow
        if key in this.methods:
            message = f"{this.block.name} has two methods {declaration.name}"
            self._findings.error(unit, FindingCode.DECLARED_TWICE, message)
        this.methods[key] = unit

    def _refuse_sections(self, blocks: Sequence[VariableBlock]) -> None:
        for block in blocks:
            if block.section in _REFUSED:
                message = f"{block.section} is not supported"
                self._findings.error(block, FindingCode.NOT_SUPPORTED, message)

    def _undeclared(self, unit: FunctionUnit | FunctionBlockUnit, word: str, name: str) -> None:
        if self._scope.lookup("types" if word == "FUNCTION_BLOCK" else "functions", name):
            message = f"the declaration of {name} has an error"
        else:
            message = f"nothing declares the {word} {name}"
        hint = "write its VAR blocks here, or declare it in a .fun file"
        self._findings.error(unit, FindingCode.NO_DECLARATION, message, hint)

    def _refused(self, unit: MethodUnit | UnsupportedUnit) -> None:
        if isinstance(unit, MethodUnit):
            word = "PROPERTY" if "PROPERTY" in unit.words else "METHOD"
            name = unit.declaration.name
        else:
            word, name = unit.keyword, unit.name
        message = f"{word} {name}".rstrip()
        self._findings.error(unit, FindingCode.NOT_SUPPORTED, f"{message} is not supported")

    def _namespace(self, unit: NamespaceUnit) -> None:
        self.symbols.namespaces.add(unit.name.upper())

    def _interface(self, unit: InterfaceUnit) -> None:
        """Note an interface with the methods that it asks for."""
        data_type = self._scope.find_type(unit.name)
        if not isinstance(data_type, StructType):
            return  # what is wrong was told
        methods = [part for part in unit.parts if isinstance(part, MethodUnit)]
        key_of = self._scope.dialect.key
        keys = {key_of_method(each, key_of(each.declaration.name)) for each in methods}
        self.symbols.interfaces[data_type] = ClassInterface(unit.name, unit.bases, keys)

    def _include(self, unit: Include) -> None:
        self._findings.error(
            unit, FindingCode.NOT_SUPPORTED, f"#include {unit.path} is not supported"
        )

    def _declarations(self, _unit: Unit) -> None:
        """Blocks of declarations are checked with their scope."""

    # Bodies

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
        self._check_recursion()
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

    def _surrounded(self, job: _Job, body: typed.CheckedBody) -> list[typed.CheckedBody]:
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

    def _checker(self, owner: _Owner, findings: FileFindings) -> StatementChecker:
        """Return what checks statements that stand elsewhere than the bodies of an owner."""
        return StatementChecker(ScopeNames(owner.scope, self.symbols, findings), findings, {})

    def _is_called_outside(self, job: _Job) -> bool:
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

    def _check_recursion(self) -> None:
        """Refuse functions that call themselves and need memory for what lives in one call."""
        functions = {job.name: job for job in self._jobs if job.function is not None}
        calls = {name: job.calls for name, job in functions.items()}
        for job in functions.values():
            body = job.body
            is_large = body is not None and (needs_memory(body) or self._copies_inputs(body))
            if body is None or not is_large or not reaches(job.name, calls):
                continue
            message = f"{job.name} calls itself, and has variables that are no single values"
            hint = "such variables of a FUNCTION exist once"
            findings = FileFindings(job.file.tokens, job.file.diagnostics, self._hidden)
            findings.error(job.unit, FindingCode.NOT_SUPPORTED, f"{message}: not supported", hint)

    def _copies_inputs(self, body: typed.CheckedBody) -> bool:
        """Return whether a function of a standard file has copies of what it is given."""
        inputs = (each for each in body.parameters if each.by_address and each.is_input)
        return not self._scope.dialect.case_sensitive and any(each.written for each in inputs)

    def _check(self, job: _Job, into: list[typed.CheckedBody]) -> list[_Job]:
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
        line = findings.line(job.unit)
        statements = checker.statements(job.nodes)
        body = typed.CheckedBody(job.name, job.kind, job.file.path, line, statements, owner.block)
        body.result = result
        if job.kind in ("function", "block", "method"):
            body.parameters, body.locals = self._variables(owner.scope)
        into.append(body)
        job.body, job.calls = body, checker.called_functions
        called = [self._action_of(owner, name) for name in sorted(checker.called_actions)]
        found = [action for action in called if not action.is_needed]
        for action in found:
            action.is_needed = True
        found += self._called_open(checker.called_open)
        return [*found, *self._called_methods(checker.called_methods)]

    def _called_open(
        self, functions: Mapping[str, tuple[OpenFunction, DeclaredFunction]]
    ) -> Iterator[_Job]:
        """Yield the functions that are called for the first time with arrays of such bounds."""
        for label, (made_of, function) in functions.items():
            if label not in self._methods:
                self._methods.add(label)
                self.symbols.storages[function.scope] = "frame"
                owner, unit = _Owner(function.scope), made_of.unit
                job = _Job(label, "function", unit, unit.body, made_of.file, owner, function)
                self._jobs.append(job)
                yield job

    def _called_methods(self, methods: Mapping[str, ClassMethod]) -> Iterator[_Job]:
        """Yield the methods that are called for the first time."""
        for label, method in methods.items():
            if label in self._methods:
                continue
            self._methods.add(label)
            around = self._owners[method.owner]
            scope = method.function.scope
            self.symbols.storages[scope] = "frame"
            owner = _Owner(scope, around.block, around.actions, method.owner)
            unit, file = method.unit, method.maker.file
            job = _Job(label, "method", unit, unit.body, file, owner, method.function)
            job.maker = method.maker
            yield job

    def _callable(self, owner: _Owner) -> Mapping[str, _Job]:
        """Return the actions that bodies can call.

        In a library those of a function block may stand in a file of their own: they belong to
        each block that calls them.
        """
        if owner.block is None or any(job.kind == "unit" for job in self._jobs):
            return owner.actions
        return {**self._program.actions, **owner.actions}

    def _action_of(self, owner: _Owner, name: str) -> _Job:
        """Return an action of an owner, which becomes its own if it stands in another file."""
        if name not in owner.actions:
            job = self._program.actions[name]
            job.is_needed = True
            owner.actions[name] = replace(job, owner=owner, is_needed=False, calls=set())
        return owner.actions[name]

    @staticmethod
    def _result(job: _Job, names: ScopeNames) -> typed.Symbol | None:
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


_REFUSED = frozenset(["VAR_INST", "VAR_GENERIC"])
"""Sections of CODESYS that are read and not supported."""

_OWN = frozenset(["VAR", "VAR_TEMP", "VAR_STAT"])
"""Sections whose variables are there for the bodies alone."""

_PARAMETERS = frozenset(["VAR_INPUT", "VAR_IN_OUT", "VAR_OUTPUT"])
_RULES: Mapping[type, Callable[..., None]] = {
    ProgramUnit: _ProgramChecker._program_unit,
    ActionUnit: _ProgramChecker._action,
    FunctionUnit: _ProgramChecker._function,
    FunctionBlockUnit: _ProgramChecker._function_block,
    MethodUnit: _ProgramChecker._refused,
    InterfaceUnit: _ProgramChecker._interface,
    NamespaceUnit: _ProgramChecker._namespace,
    UnsupportedUnit: _ProgramChecker._refused,
    Include: _ProgramChecker._include,
    TypeBlock: _ProgramChecker._declarations,
    VariableBlock: _ProgramChecker._declarations,
    Configuration: _ProgramChecker._declarations,
}
