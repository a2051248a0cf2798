"""Resolving the declarations of one file: specifications to data types, blocks to variables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from st_types.errors import DeclarationError
from st_types.resolve.constant_resolver import MAX_NESTING, ConstantResolver, constant_of
from st_types.resolve.constants import ScopeError
from st_types.resolve.variables import Function, Variable
from st_types.syntax.printer import print_specification
from st_types.syntax.tree import (
    ArraySpecification,
    Declaration,
    EnumerationSpecification,
    FunctionBlockDeclaration,
    NamedType,
    ReferenceSpecification,
    StringSpecification,
    StructSpecification,
    SubrangeSpecification,
    VariableBlock,
)
from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import DINT, ELEMENTARY, DataType, ElementaryType

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from st_types.resolve.name_index import Entry, SourceFile
    from st_types.resolve.table import TypeTable
    from st_types.syntax.expressions import Expression, Node
    from st_types.syntax.literals import Constant
    from st_types.syntax.tree import FunctionDeclaration, TypeSpecification

DEFAULT_STRING_LENGTH = 80
"""Characters of STRING and WSTRING without a length (IEC 61131-3 leaves it to the vendor)."""

GENERIC_TYPES = frozenset(
    [
        *("ANY", "ANY_NUM", "ANY_INT", "ANY_REAL", "ANY_BIT", "ANY_STRING", "ANY_DATE"),
        *("ANY_ELEMENTARY", "ANY_DERIVED", "ANY_MAGNITUDE", "ANY_SIGNED", "ANY_UNSIGNED"),
        *("ANY_DURATION", "ANY_CHAR", "ANY_CHARS"),
    ]
)
"""Types of parameters that take several types; they have no layout."""

_SECTIONS = {
    "VAR_INPUT": Section.INPUT,
    "VAR_OUTPUT": Section.OUTPUT,
    "VAR_IN_OUT": Section.IN_OUT,
    "VAR": Section.INTERNAL,
}
"""Sections of a data block; VAR_TEMP and VAR_EXTERNAL take no place in it."""

T = TypeVar("T")

_SIMPLE: dict[str, DataType[Any]] = {
    **{spelling(name): t for name, t in ELEMENTARY.items() for spelling in (str, str.lower)},
    "STRING": StringType(DEFAULT_STRING_LENGTH),
    "WSTRING": WStringType(DEFAULT_STRING_LENGTH),
}
"""Types that every file knows, in the usual spellings."""


class FileResolver(ConstantResolver):
    """Resolves what one file declares."""

    def __init__(self, table: TypeTable, owner: SourceFile) -> None:
        super().__init__(table, owner)
        self._entries: dict[str, Entry | None] = {}
        self._depth = 0

    def resolve(self, entry: Entry) -> None:
        """Give ``entry`` its data type, and its value if it is a constant."""
        outer, self._depth = self._depth, 0
        node = entry.node
        if isinstance(node, FunctionBlockDeclaration):
            entry.data_type = self._function_block(node)
        elif isinstance(node, Declaration) and entry.is_constant:
            entry.data_type = self.data_type(node.specification, node.name)
            entry.value = self.initial(node, entry.data_type)
        elif isinstance(node, Declaration):
            entry.data_type = self._declared_type(node)
        entry.depth = self._depth + 1
        self._depth = outer
        if entry.depth > MAX_NESTING:
            self.error(node, f"{node.name}: more than {MAX_NESTING} types lie one inside the other")
            entry.data_type = None

    def _declared_type(self, node: Declaration) -> DataType[object] | None:
        made = self.data_type(node.specification, node.name)
        initial = self.initial(node, made)
        if made is None or (made.name == node.name and initial is None):
            return made
        return AliasType(node.name, made, initial)

    def data_type(self, node: TypeSpecification, name: str) -> DataType[object] | None:
        """Return the type of a specification, None (after a finding) if it has no layout.

        Args:
            node: the specification.
            name: of the declaration, for types without a name of their own.
        """
        if type(node) is NamedType and node.name in _SIMPLE:
            return _SIMPLE[node.name]
        return _BUILDERS[type(node)](self, node, name)

    def _named_type(self, node: NamedType, _name: str = "") -> DataType[object] | None:
        if node.name in self._entries:
            entry = self._entries[node.name]
        elif (spelling := node.name.upper()) in _SIMPLE:
            return _SIMPLE[spelling]
        else:
            entry = self._entries[node.name] = self._find_type(node)
        if entry is None:
            return None
        if entry.state != 2 and not self._may_resolve(node, entry):
            return None
        self._depth = max(self._depth, entry.depth)
        return entry.data_type

    def _find_type(self, node: NamedType) -> Entry | None:
        entry = self.table.find("types", node.name, self.owner)
        if entry is None and node.name.upper() not in GENERIC_TYPES:
            self.missing(node.at, f"no type is called {node.name} in the checked files")
        return entry

    def _may_resolve(self, node: NamedType, entry: Entry) -> bool:
        """Resolve the type of another declaration; False after an error."""
        names = [e.node.name for e in self.table.open]
        if entry.state == 1:
            path = [*names[self.table.open.index(entry) :], entry.node.name]
            hint = "a REFERENCE TO it is possible"
            self.error(node, f"{entry.node.name} contains itself: {' -> '.join(path)}", hint)
            return False
        try:
            self.check_open(entry)
        except ScopeError as err:
            self.error(node, err.message)
            return False
        self.table.resolved(entry)
        return True

    def _string(self, node: StringSpecification, _name: str) -> DataType[object] | None:
        length = self.integer(node.length)
        made = StringType if node.name == "STRING" else WStringType
        return None if length is None else self._made(node.length, lambda: made(length))

    def _array(self, node: ArraySpecification, name: str) -> DataType[object] | None:
        bounds = [self._bounds(low, high) for low, high in node.bounds]
        outer, self._depth = self._depth, 0
        element = self.data_type(node.element, name)
        self._depth = max(outer, self._depth + 1)
        known = [pair for pair in bounds if pair is not None]
        if element is None or len(known) < len(bounds):
            return None
        return self._made(node, lambda: ArrayType(element, known))

    def _bounds(self, low: Expression, high: Expression) -> tuple[int, int] | None:
        first, last = self.integer(low), self.integer(high)
        if first is None or last is None:
            return None
        if first > last:
            self.error(high, f"the upper bound {last} is below the lower bound {first}")
            return None
        return first, last

    def _reference(self, node: ReferenceSpecification, _name: str) -> ReferenceType:
        return self._reference_to(node.target)

    def _reference_to(self, target: TypeSpecification) -> ReferenceType:
        reference = ReferenceType(None, f"REFERENCE TO {print_specification(target)}")
        self.table.resolve_later(reference, self, target)
        return reference

    def _subrange(self, node: SubrangeSpecification, name: str) -> DataType[object] | None:
        base = self._named_type(NamedType(node.at, node.base))
        bounds = self._bounds(node.low, node.high)
        if base is None or bounds is None:
            return None
        base = resolve_alias(base)
        if not isinstance(base, ElementaryType):
            self.error(node, f"{base} cannot have a subrange; an integer type was expected")
            return None
        return self._made(node, lambda: SubrangeType(name or node.base, base, *bounds))

    def _enumeration(self, node: EnumerationSpecification, name: str) -> DataType[object] | None:
        values: dict[str, int] = {}
        outer, self.values = self.values, values
        number = -1
        for item in node.values:
            if item.name in values:
                self.error(item, f"{name} declares {item.name} twice")
            following = DINT.wrap(number + 1)
            number = following if item.value is None else self._value(item.value, following)
            values[item.name] = number
        self.values = outer
        if not values:
            self.warning(node, "the enumeration has no values")
            return AliasType(name, DINT)
        return EnumerationType(name, values)

    def _struct(self, node: StructSpecification, name: str) -> DataType[object] | None:
        members = self._members(node.members, Section.INTERNAL, name)
        if members is None:
            return None
        return self._made(node, lambda: StructType(name, members))

    def _value(self, node: Expression, following: int) -> int:
        number = self.integer(node)
        if number is None:
            return following
        if not DINT.minimum <= number < 2**32:
            self.error(node, f"{number} is outside {DINT.minimum}..{DINT.maximum} of DINT")
        return DINT.wrap(number)

    def _made(self, node: Node, make: Callable[[], T]) -> T | None:
        try:
            return make()
        except DeclarationError as err:
            self.error(node, str(err).rstrip("."))
            return None

    # Lists of declarations

    def _members(
        self, declarations: Sequence[Declaration], section: Section, name: str
    ) -> list[Member] | None:
        members: list[Member] = []
        for declaration in declarations:
            data_type = self.data_type(declaration.specification, f"{name}_{declaration.name}")
            if data_type is not None:
                initial = self.initial(declaration, data_type)
                members.append(Member(declaration.name, data_type, initial, section))
        if self._report_duplicates(declarations, name):
            return None
        return members if len(members) == len(declarations) else None

    def _report_duplicates(self, declarations: Sequence[Declaration], name: str) -> bool:
        """Report names that are declared twice; False if there are none."""
        if len({declaration.name.upper() for declaration in declarations}) == len(declarations):
            return False
        seen: set[str] = set()
        for declaration in declarations:
            if declaration.name.upper() in seen:
                self.error(declaration, f"{name} declares {declaration.name} twice")
            seen.add(declaration.name.upper())
        return True

    def _function_block(self, node: FunctionBlockDeclaration) -> DataType[object] | None:
        outer, self.local = self.local, self._local_constants(node.blocks)
        parts = [self._block_members(block, node.name) for block in node.blocks]
        self.local = outer
        every = [declaration for block in node.blocks for declaration in block.declarations]
        self._report_duplicates(every, node.name)
        members = [member for part in parts for member in part or ()]
        if None in parts or len({m.name.upper() for m in members}) < len(members):
            return None
        return self._made(node, lambda: DataBlockType(node.name, members))

    def _block_members(self, block: VariableBlock, name: str) -> list[Member] | None:
        """Return the members that a block of variables adds to a data block, None after an error.

        A VAR_IN_OUT is a reference there. Constants take no place.
        """
        section = _SECTIONS.get(block.section)
        if section is Section.IN_OUT:
            return [
                Member(d.name, self._reference_to(d.specification), None, section)
                for d in block.declarations
            ]
        members = self._members(block.declarations, section or Section.INTERNAL, name)
        return [] if section is None or "CONSTANT" in block.qualifiers else members

    def _local_constants(self, blocks: Sequence[VariableBlock]) -> dict[str, Constant | None]:
        outer = self.local
        self.local = dict(outer)
        for block in blocks:
            if "CONSTANT" in block.qualifiers:
                for node in block.declarations:
                    data_type = self.data_type(node.specification, node.name)
                    value = self.initial(node, data_type)
                    self.local[node.name.upper()] = constant_of(node, data_type, value)
        found, self.local = self.local, outer
        return found

    def function(self, node: FunctionDeclaration) -> Function:
        """Return the parameters, the other variables and the result of a FUNCTION."""
        outer, self.local = self.local, self._local_constants(node.blocks)
        result = self.data_type(node.result, node.name) if node.result is not None else None
        variables = [variable for block in node.blocks for variable in self.variables(block)]
        self.local = outer
        every = [declaration for block in node.blocks for declaration in block.declarations]
        self._report_duplicates(every, node.name)
        return Function(node.name, result, tuple(variables), node, self.owner.file)

    def file_variables(self) -> list[Variable]:
        """Return the variables of the VAR blocks outside functions and function blocks."""
        blocks = [item for item in self.owner.file.items if isinstance(item, VariableBlock)]
        self._report_duplicates(
            [node for block in blocks for node in block.declarations], "the file"
        )
        return [variable for block in blocks for variable in self.variables(block)]

    def variables(self, block: VariableBlock) -> list[Variable]:
        """Return the variables of a VAR block."""
        return [self._variable(node, block) for node in block.declarations]

    def _variable(self, node: Declaration, block: VariableBlock) -> Variable:
        entry = self.table.constant_entry(node) if "CONSTANT" in block.qualifiers else None
        if entry is not None:
            data_type, initial = entry.data_type, entry.value
        else:
            data_type = self.data_type(node.specification, node.name)
            initial = self.initial(node, data_type)
        return Variable(node.name, data_type, initial, block, node, self.owner.file)


_BUILDERS: dict[type, Callable[[FileResolver, Any, str], DataType[object] | None]] = {
    NamedType: FileResolver._named_type,
    StringSpecification: FileResolver._string,
    ArraySpecification: FileResolver._array,
    ReferenceSpecification: FileResolver._reference,
    SubrangeSpecification: FileResolver._subrange,
    EnumerationSpecification: FileResolver._enumeration,
    StructSpecification: FileResolver._struct,
}
