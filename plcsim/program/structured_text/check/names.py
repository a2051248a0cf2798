"""What names of variables and constants mean in a body."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text.check.kinds import VOID, TypeKind, kind_of, plain
from plcsim.program.structured_text.check.located import DirectAddresses, direct_place, place_of
from plcsim.program.structured_text.check.typed import (
    Bit,
    Constant,
    Element,
    Member,
    Symbol,
    Target,
    Variable,
)
from plcsim.program.structured_text.codes import FindingCode
from st_types.resolve.absent import absent_type
from st_types.resolve.constants import UnknownValueError
from st_types.resolve.index import VariableEntry
from st_types.resolve.scope import Hit
from st_types.syntax.expressions import Name
from st_types.types.derived import ReferenceType

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from plcsim.program.structured_text.check.classes import Classes, ClassInterface
    from plcsim.program.structured_text.check.findings import FileFindings
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.open_arrays import OpenFunction
    from plcsim.program.structured_text.check.typed import Storage, Value
    from st_types.resolve.index import IndexEntry, NameSpace
    from st_types.resolve.scope import Scope
    from st_types.syntax.expressions import DirectAddress

BY_ADDRESS: Final = frozenset([TypeKind.STRING, TypeKind.WSTRING, TypeKind.STRUCT, TypeKind.ARRAY])
"""Kinds of parameters of a FUNCTION that go over by their address: what the function does to them
is done to the caller's variable, as in the C of Automation Studio."""

_REFERENCE_SECTIONS = frozenset(["VAR_IN_OUT"])
_ADDRESS_SECTIONS = frozenset(["VAR_IN_OUT", "VAR_OUTPUT"])
_SPACES: Final[tuple[NameSpace, ...]] = ("variables", "constants")
NOTHING: Final = Constant(VOID, 0)
"""The value of what was reported already."""


class Symbols:
    """The variables that the bodies of a program name, each once.

    Args:
        storages: where the variables of a scope lie; those of others are global.

    Attributes:
        classes: the function blocks whose text is at hand.
        interfaces: by the types of their variables.
        open_functions: functions that take arrays of any bounds, by how names are compared.
        namespaces: names in capitals that may stand before a name: of namespaces and of files.
    """

    def __init__(self, storages: Mapping[Scope, Storage]) -> None:
        self.storages = dict(storages)
        self.classes: Classes = {}
        self.interfaces: dict[Type, ClassInterface] = {}
        self.open_functions: dict[str, OpenFunction] = {}
        self.open_blocks: dict[Type, OpenFunction] = {}
        self.own_functions: set[str] = set()
        self.namespaces: set[str] = set()
        self._symbols: dict[VariableEntry, Symbol] = {}
        self._addresses: DirectAddresses | None = None

    def addresses(self, around: Sequence[Scope]) -> DirectAddresses:
        """Return the direct addresses as the program sees them.

        Args:
            around: scopes that a body sees.
        """
        if self._addresses is None:
            self._addresses = DirectAddresses(dict.fromkeys([*self.storages, *around]))
        return self._addresses

    def name_addresses(self) -> bool:
        """Return whether a body names a direct address, or a variable AT one."""
        return self._addresses is not None and self._addresses.used

    def of(self, entry: VariableEntry) -> Symbol | None:
        """Return the variable of a declaration, None if its type has no layout."""
        found = self._symbols.get(entry)
        if found is None:
            entry.resolver.complete(entry)
            if entry.data_type is None:
                return None
            found = self._symbols[entry] = self._made(entry, plain(entry.data_type))
        return found

    def is_used(self, entry: VariableEntry) -> bool:
        """Return whether a body names a variable, or an edge needs it."""
        found = self._symbols.get(entry)
        return (found is not None and found.used) or entry.name.startswith("zzEdge")

    def _made(self, entry: VariableEntry, data_type: Type) -> Symbol:
        scope, section = entry.resolver.scope, entry.block.section
        storage = self.storages.get(scope, "global")
        symbol = Symbol(entry.name, data_type, storage, scope, initial=entry.value)
        if entry.is_constant or section == "VAR_STAT":
            symbol.is_constant = entry.is_constant
            symbol.storage = "hidden"
        elif section == "VAR_TEMP":
            symbol.storage = "frame"
        elif storage == "frame":
            symbol.by_address = section in _ADDRESS_SECTIONS or (
                section == "VAR_INPUT" and kind_of(data_type) in BY_ADDRESS
            )
        else:
            symbol.by_address = section in _REFERENCE_SECTIONS
        symbol.has_address = symbol.by_address
        symbol.is_input = section == "VAR_INPUT"
        return symbol


def named(symbol: Symbol) -> Value:
    """Return what the name of a variable means: of a reference, what it refers to."""
    data_type = symbol.type
    variable = Variable(data_type, symbol)
    return followed(variable)


def followed(place: Value) -> Value:
    """Return what a place means: of a reference, what it refers to."""
    data_type = place.type
    if not isinstance(data_type, ReferenceType) or data_type.is_pointer:
        return place
    target = data_type.target
    return Target(VOID if target is None else plain(target), place)


class ScopeNames:
    """Names as one scope knows them.

    Args:
        scope: of the body.
        symbols: of the program.
        findings: take what is wrong.
    """

    def __init__(self, scope: Scope, symbols: Symbols, findings: FileFindings) -> None:
        self.scope = scope
        self.symbols = symbols
        self.findings = findings
        self.values: dict[str, Value | None] = {}

    def value(self, node: Name) -> Value | None:
        """Return the variable or constant that a name means, None if there is none."""
        name = node.name
        if name not in self.values:
            self.values[name] = self._found(node)
        return self.values[name]

    def _found(self, node: Name) -> Value | None:
        hit = self._hit(node.name)
        if hit is None:
            return None
        self.check_case(node, hit)
        entry = hit.entry
        if not isinstance(entry, VariableEntry):
            return self._enumeration_value(hit.name, entry)
        if entry.block.section == "VAR_EXTERNAL":
            return self._external(node, entry)
        return self._variable(node, entry)

    def _hit(self, name: str) -> Hit | None:
        """Look a name up among variables and values of enumerations, in its own case first.

        The nearest scope has it: an enumeration of a program hides a variable of the project.
        """
        for scope in self.scope.chain:
            for space in _SPACES:
                entry = scope.index.names(space).get(name)
                if entry is not None:
                    return Hit(name, entry)
        found = (self.scope.lookup(space, name) for space in _SPACES)
        return next((hit for hit in found if hit is not None), None)

    def check_case(self, node: Name, hit: Hit) -> None:
        """Warn where a name is declared in another case, if case matters."""
        if hit.name != node.name and self.scope.dialect.case_sensitive:
            message = f"{node.name} is declared as {hit.name}"
            self.findings.warning(node, FindingCode.OTHER_CASE, message)

    def _external(self, node: Name, entry: VariableEntry) -> Value | None:
        for scope in self.scope.chain:
            if scope is not entry.resolver.scope:
                hit = scope.index.names("variables").get(entry.name)
                if isinstance(hit, VariableEntry) and hit.block.section != "VAR_EXTERNAL":
                    return self._variable(node, hit)
        message = f"{entry.name} is declared as VAR_EXTERNAL, and nowhere as VAR_GLOBAL"
        self.findings.error(node, FindingCode.UNKNOWN_NAME, message)
        return NOTHING

    def _variable(self, node: Name, entry: VariableEntry) -> Value:
        symbol = self.symbols.of(entry)
        if symbol is None:
            type_name = getattr(entry.node.specification, "name", "").upper()
            if type_name == "ANY" or type_name.startswith("ANY_"):
                message = f"{entry.name} is of type {type_name}, which is not supported"
                self.findings.error(node, FindingCode.NOT_SUPPORTED, message)
            else:
                message = f"the type of {entry.name} is not known{absent_type(entry)}"
                self.findings.error(node, FindingCode.UNKNOWN_TYPE, message)
            return NOTHING
        symbol.used = True
        direct = self.direct(entry)
        if direct is not None:
            return direct
        if entry.is_constant and kind_of(symbol.type) < TypeKind.STRING:
            return self._constant(node, entry, symbol)
        return named(symbol)

    def _constant(self, node: Name, entry: VariableEntry, symbol: Symbol) -> Value:
        try:
            value = entry.resolver.scope.constant(entry.name)
        except UnknownValueError as err:
            message = f"the value of {entry.name} is not known"
            self.findings.error(node, FindingCode.NO_VALUE, message, err.message)
            return NOTHING
        if value is None:
            return named(symbol)
        return Constant(symbol.type, value.value)

    def direct(self, entry: VariableEntry) -> Value | None:
        """Return the place that a variable of a standard file is AT, None where it is at none."""
        if not entry.node.address or self.scope.dialect.case_sensitive:
            return None
        place, symbol = place_of(entry), self.symbols.of(entry)
        if place is None or symbol is None:
            return None
        return self.symbols.addresses(self.scope.chain).value(place, symbol.type)

    def located(self, node: DirectAddress) -> Value | None:
        """Return what an address means, None where it means nothing here.

        That is the variable which is declared AT it; in a standard file, without one, the place.
        """
        text = node.text.upper()
        for scope in self.scope.chain:
            for entry in scope.index.variables:
                if entry.node.address.upper() == text:
                    return self._variable(Name(node.at, entry.name), entry)
        place = direct_place(text)
        if place is None or self.scope.dialect.case_sensitive:
            return None
        return self.symbols.addresses(self.scope.chain).value(place)

    def is_namespace(self, name: str) -> bool:
        """Return whether a name is that of a namespace, of a library or of a list of variables."""
        if self.scope.dialect.case_sensitive:
            return False
        upper = name.upper()
        known = (scope.name.upper() for scope in self.scope.chain)
        return upper in self.symbols.namespaces or upper in known

    def constant(self, node: Name) -> Value | None:
        """Return the place of a VAR CONSTANT, None for any other name."""
        hit = self.scope.lookup("variables", node.name)
        if hit is None or not isinstance(hit.entry, VariableEntry) or not hit.entry.is_constant:
            return None
        symbol = self.symbols.of(hit.entry)
        return None if symbol is None else named(symbol)

    def _enumeration_value(self, name: str, entry: IndexEntry) -> Value:
        value = entry.resolver.scope.constant(name)
        data_type = entry.data_type
        assert value is not None
        assert data_type is not None
        return Constant(plain(data_type), value.value)


def root_of(value: Value) -> Any:
    """Return the variable that a place is in, None if it is reached by an address."""
    while isinstance(value, Member | Element | Bit):
        value = value.base
    return value.symbol if isinstance(value, Variable) else None


def keep_address(value: Value) -> None:
    """Note that the address of a place is known from now on."""
    symbol = root_of(value)
    if symbol is not None:
        symbol.has_address = symbol.written = True
