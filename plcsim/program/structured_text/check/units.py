"""The units of a program's files, before their bodies are checked: who owns what."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import PurePath
from typing import TYPE_CHECKING

from plcsim.program.structured_text.check.classes import (
    BODY,
    GET,
    SET,
    Class,
    ClassInterface,
    action_as_method,
    body_as_method,
    key_of_method,
)
from plcsim.program.structured_text.check.declared import is_open_block, unit_scope
from plcsim.program.structured_text.check.findings import FileFindings
from plcsim.program.structured_text.check.names import Symbols
from plcsim.program.structured_text.check.open_arrays import OpenFunction, takes_any_bounds
from plcsim.program.structured_text.check.programs import (
    MeantProgram,
    as_block,
    call_of,
    is_shared,
)
from plcsim.program.structured_text.check.recursion import block_label
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.program_uses import NO_USES, UNITS
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
)
from st_types.syntax.tree import TypeBlock, VariableBlock
from st_types.types.derived import StructType

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence

    from plcsim.program.structured_text.check import typed
    from plcsim.program.structured_text.check.typed import BodyKind, Storage, Value
    from plcsim.program.structured_text.syntax.tree import (
        Part,
        ProgramConfiguration,
        Statement,
        StructuredTextFile,
        Unit,
    )
    from st_types.resolve.declared import DeclaredFunction, DeclaredFunctionBlock
    from st_types.resolve.scope import Scope
    from st_types.types.derived import DataBlockType


@dataclass(slots=True, eq=False)
class BodyOwner:
    """What actions belong to: a program, or a function block with its data block."""

    scope: Scope
    block: DataBlockType[object] | None = None
    actions: dict[str, BodyJob] = field(default_factory=dict)
    this: Class | None = None


@dataclass(slots=True, eq=False)
class BodyJob:
    """A body that is to be checked."""

    name: str
    kind: BodyKind
    unit: Unit
    nodes: Sequence[Statement]
    file: StructuredTextFile
    owner: BodyOwner
    function: DeclaredFunction | None = None
    is_needed: bool = True
    maker: Class | None = None
    calls: set[str] = field(default_factory=set)
    body: typed.CheckedBody | None = None

    @property
    def label(self) -> str:
        """Return its name among those of all bodies; functions and methods have their own."""
        if self.kind in ("function", "method"):
            return self.name
        if self.kind == "block":
            return block_label(self.name)
        block = self.owner.block
        return f"{self.kind} {'' if block is None else block.name}.{self.name}"


class UnitCollector:
    """Takes the units of files: bodies become jobs, function blocks and interfaces are noted.

    Args:
        scope: of the program.
        hidden: codes of warnings that are not wanted.
        storage: of the variables of the scope.
        meant: of several PROGRAMs the one that is compiled.

    Attributes:
        uses: which PROGRAMs others name.
        connected: what a CONFIGURATION says of the PROGRAM, with its file.
        symbols: the variables and what else bodies name.
    """

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
        self._jobs: list[BodyJob] = []
        self._program = self._owner = BodyOwner(scope)
        self._taken: set[tuple[str, str]] = set()
        self._owners: dict[Class, BodyOwner] = {}
        self._methods: set[str] = set()
        self._programs: dict[str, BodyOwner] = {}
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
                self._jobs.append(BodyJob(name, "unit", unit, [call], self._file, self._program))
            return
        if not self._meant.includes(unit):
            return
        self._owner = owner = self._program
        scope = unit_scope(unit, self._file, self._scope, self.uses)
        if scope is not None:
            scope.check()
            self.symbols.storages[scope] = "program"
            self._owner = owner = BodyOwner(scope, actions=owner.actions)
        self._programs[self._scope.dialect.key(unit.name)] = owner
        self._parts(unit.parts, owner)
        if self._is_new(unit, "unit", name):
            self._jobs.append(BodyJob(name, "unit", unit, unit.body, self._file, owner))

    def _parts(self, parts: Sequence[Part], owner: BodyOwner) -> None:
        for part in parts:
            if isinstance(part, ActionUnit):
                self._add_action(part, owner)
            elif isinstance(part, MethodUnit):
                self._add_method(part, owner)

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

    def _add_action(self, unit: ActionUnit, owner: BodyOwner) -> None:
        block = "" if owner.block is None else f"{owner.block.name}."
        if self._is_new(unit, "action", block + unit.name):
            key = self._scope.dialect.key(unit.name)
            job = BodyJob(unit.name, "action", unit, unit.body, self._file, owner, is_needed=False)
            owner.actions[key] = job
            self._jobs.append(job)
            if owner.this is not None:
                owner.this.methods.setdefault(key, action_as_method(unit))

    def _function(self, unit: FunctionUnit) -> None:
        name = unit.declaration.name
        self.symbols.own_functions.add(self._scope.dialect.key(name))
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
            owner = BodyOwner(function.scope)
            job = BodyJob(name, "function", unit, unit.body, self._file, owner, function)
            self._jobs.append(job)

    def _function_block(self, unit: FunctionBlockUnit) -> None:
        name = unit.declaration.name
        block = self._scope.find_function_block(name)
        if block is None or block.data_type is None:
            self._undeclared(unit, "FUNCTION_BLOCK", name)
        elif self._is_new(unit, "block", name):
            self._refuse_sections(unit.declaration.blocks)
            if is_open_block(unit):
                found = OpenFunction(unit, self._file, self._scope)
                self.symbols.open_blocks[block.data_type] = found
                return
            self.symbols.storages[block.scope] = "instance"
            own = self._class(unit, block, block.data_type)
            self._owner = owner = BodyOwner(block.scope, block.data_type, this=own)
            self._owners[own] = owner
            self._parts(unit.parts, owner)
            if "ABSTRACT" not in unit.words:
                self._jobs.append(BodyJob(name, "block", unit, unit.body, self._file, owner))

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

    def _add_method(self, unit: MethodUnit, owner: BodyOwner) -> None:
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

    def _refused(self, unit: MethodUnit) -> None:
        word = "PROPERTY" if "PROPERTY" in unit.words else "METHOD"
        message = f"{word} {unit.declaration.name} is not supported"
        self._findings.error(unit, FindingCode.NOT_SUPPORTED, message)

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


_REFUSED = frozenset(["VAR_INST", "VAR_GENERIC"])
"""Sections of CODESYS that are read and not supported."""

_RULES: Mapping[type, Callable[..., None]] = {
    ProgramUnit: UnitCollector._program_unit,
    ActionUnit: UnitCollector._action,
    FunctionUnit: UnitCollector._function,
    FunctionBlockUnit: UnitCollector._function_block,
    MethodUnit: UnitCollector._refused,
    InterfaceUnit: UnitCollector._interface,
    NamespaceUnit: UnitCollector._namespace,
    Include: UnitCollector._include,
    TypeBlock: UnitCollector._declarations,
    VariableBlock: UnitCollector._declarations,
    Configuration: UnitCollector._declarations,
}
