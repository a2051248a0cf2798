"""Resolving the declarations of one file: specifications to data types, blocks to variables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from st_types.errors import DeclarationError
from st_types.resolve.constant_lookup import MAX_LEVEL
from st_types.resolve.constant_resolver import ConstantResolver
from st_types.resolve.constants import UnknownValueError
from st_types.resolve.index import DONE, NEW, OPEN, IndexEntry, PouEntry, TypeEntry, VariableEntry
from st_types.syntax.printer import print_specification
from st_types.syntax.tree import (
    ArraySpecification,
    Declaration,
    DeclarationFile,
    EnumerationSpecification,
    FunctionBlockDeclaration,
    FunctionDeclaration,
    NamedType,
    OpenArraySpecification,
    ReferenceSpecification,
    StringSpecification,
    StructSpecification,
    SubrangeSpecification,
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
    UnionType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import DINT, DataType, ElementaryType

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from st_types.resolve.scope import Scope
    from st_types.syntax.expressions import Expression, Node
    from st_types.syntax.tree import TypeSpecification

MAX_NESTING = 50
"""Most types that lie one inside the other."""

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


class FileResolver(ConstantResolver):
    """Resolves what one file declares in a scope.

    Args:
        scope: where its names are looked up.
        file: the file.
        known: types by the names that the file uses, None for those that are not declared; the
            scopes inside a file share it.
    """

    def __init__(
        self, scope: Scope, file: DeclarationFile, known: dict[str, IndexEntry | None] | None = None
    ) -> None:
        super().__init__(scope, file)
        self._known = {} if known is None else known
        self._simple = scope.dialect.simple_types
        self._depth = 0
        self._references: list[ReferenceType] = []

    def resolve(self, entry: IndexEntry, level: int) -> None:
        """Give ``entry`` its data type, and its value if it is a variable; ``level`` are open."""
        outer = self.entry, self.level, self._depth
        self.entry, self.level, self._depth = entry, level, 0
        match entry:
            case VariableEntry():
                self.resolve_variable(entry)
            case TypeEntry(node=node):
                entry.data_type = self._declared_type(node)
            case PouEntry(node=FunctionDeclaration() as node):
                entry.data_type = self._function(entry, node)
            case PouEntry(node=FunctionBlockDeclaration() as node):
                entry.data_type = self._function_block(entry, node)
        entry.depth = self._depth + 1
        self.entry, self.level, self._depth = outer
        if entry.depth > MAX_NESTING:
            message = f"{entry.name}: more than {MAX_NESTING} types lie one inside the other"
            self.error(entry.node, message)
            entry.data_type = None

    def resolve_variable(self, entry: VariableEntry) -> None:
        """Give a variable its type and its value."""
        node = entry.node
        entry.data_type = self.data_type(node.specification, node.name)
        if node.initial is not None:
            entry.value = self.initial(node, entry.data_type)

    def complete(self, entry: VariableEntry) -> None:
        """Resolve a variable if that is not done yet.

        Nothing needs a variable that is no constant, so there is no loop to be found.
        """
        if entry.is_constant:
            self.resolved(entry)
        elif entry.state == NEW:
            entry.state = DONE
            self.resolve_variable(entry)

    def resolve_references(self) -> None:
        """Look up what references refer to, so that all findings are recorded."""
        while self._references:
            _ = self._references.pop().target

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
        if type(node) is NamedType and node.name in self._simple:
            return self._simple[node.name]
        return _BUILDERS[type(node)](self, node, name)

    def _named_type(self, node: NamedType, _name: str = "") -> DataType[object] | None:
        if node.name in self._known:
            entry = self._known[node.name]
        elif (spelling := node.name.upper()) in self._simple:
            return self._simple[spelling]
        else:
            entry = self._known[node.name] = self._find_type(node)
        if entry is None:
            return None
        if entry.state != DONE and not self._may_resolve(node, entry):
            return None
        self._depth = max(self._depth, entry.depth)
        found = entry.data_type
        if node.given and found is not None and not isinstance(resolve_alias(found), DataBlockType):
            self.error(node, f"{node.name} is no function block, so it has no FB_init to be given")
        return found

    def _find_type(self, node: NamedType) -> IndexEntry | None:
        entry = self.find("types", node.name, node.at)
        if entry is None and node.name.upper() not in GENERIC_TYPES:
            hint = self.scope.hint("types", node.name)
            self.missing(node.at, f"no type is called {node.name}", hint)
        return entry

    def _may_resolve(self, node: NamedType, entry: IndexEntry) -> bool:
        """Resolve the type of another declaration; False after an error."""
        if entry.state == OPEN:
            hint = "a REFERENCE TO it is possible"
            path = " -> ".join(self._path_from(entry))
            self.error(node, f"{entry.name} contains itself: {path}", hint)
            return False
        try:
            self.check_open(entry)
        except UnknownValueError as err:
            self.error(node, err.message)
            return False
        self.resolved(entry)
        return True

    def _path_from(self, entry: IndexEntry) -> list[str]:
        """Return the names of the types from ``entry``, which is OPEN, back to itself."""
        path = [entry.name]
        user = self.entry
        while user is not None and user is not entry:
            if not isinstance(user, VariableEntry):
                path.append(user.name)
            user = user.user
        return [entry.name, *reversed(path)]

    def _string(self, node: StringSpecification, _name: str) -> DataType[object] | None:
        length = self.integer(node.length)
        made = StringType if node.name == "STRING" else WStringType
        return None if length is None else self._made(node.length, lambda: made(length))

    def _array(self, node: ArraySpecification, name: str) -> DataType[object] | None:
        bounds = [self._bounds(low, high) for low, high in node.bounds]
        outer, self._depth = self._depth, 0
        element = self.data_type(node.element, name) if self._enter(node) else None
        self.level -= 1
        self._depth = max(outer, self._depth + 1)
        known = [pair for pair in bounds if pair is not None]
        if element is None or len(known) < len(bounds):
            return None
        return self._made(node, lambda: ArrayType(element, known))

    def _open_array(self, node: OpenArraySpecification, _name: str) -> None:
        message = "ARRAY[*] is known as a parameter of a FUNCTION or a METHOD, and as a VAR_IN_OUT"
        self.error(node, f"{message} of a FUNCTION_BLOCK without actions and methods")

    def _enter(self, node: Node) -> bool:
        """Count one level of nesting; False, after an error, if it is one too many."""
        self.level += 1
        if self.level > MAX_LEVEL:
            self.error(node, "the types here are nested too deep")
            return False
        return True

    def _bounds(self, low: Expression, high: Expression) -> tuple[int, int] | None:
        first, last = self.integer(low), self.integer(high)
        if first is None or last is None:
            return None
        if first > last:
            self.error(high, f"the upper bound {last} is below the lower bound {first}")
            return None
        return first, last

    def _reference(self, node: ReferenceSpecification, _name: str) -> ReferenceType:
        return self._reference_to(node, lambda: self.data_type(node.target, ""))

    def _reference_to(
        self, node: ReferenceSpecification, find: Callable[[], DataType[object] | None]
    ) -> ReferenceType:
        """Return a reference whose target is found later, for that may hold the reference."""
        is_pointer = node.keyword != "REFERENCE"
        reference = ReferenceType(find, print_specification(node), is_pointer=is_pointer)
        self._references.append(reference)
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
        key = self.scope.dialect.key
        base = self._enumeration_base(node)
        values: dict[str, int] = {}
        known: dict[str, int] = {}
        outer, self.values = self.values, known
        number = -1
        for item in node.values:
            if key(item.name) in known:
                self.error(item, f"{name} declares {item.name} twice")
            following = base.wrap(number + 1)
            number = following if item.value is None else self._value(item.value, following, base)
            values[item.name] = number
            known[key(item.name)] = number
        self.values = outer
        if not values:
            self.warning(node, "the enumeration has no values")
            return AliasType(name, base)
        return EnumerationType(name, values, base=base)

    def _enumeration_base(self, node: EnumerationSpecification) -> ElementaryType[int]:
        """Return the type that holds the values of an enumeration."""
        if not node.base:
            return DINT
        base = self._named_type(NamedType(node.at, node.base))
        found = None if base is None else resolve_alias(base)
        if isinstance(found, ElementaryType) and found.is_integer:
            return found
        if found is not None:
            self.error(node, f"an enumeration is an integer, {node.base} is none")
        return DINT

    def _struct(self, node: StructSpecification, name: str) -> DataType[object] | None:
        base = self._base_of(node)
        members = self._members(node.members, name) if self._enter(node) else None
        self.level -= 1
        if members is None or base is None:
            return None
        made = UnionType if node.keyword == "UNION" else StructType
        return self._made(node, lambda: made(name, [*base, *members]))

    def _base_of(self, node: StructSpecification) -> Sequence[Member] | None:
        """Return the members of what a STRUCT extends, None after an error."""
        if not node.base:
            return ()
        base = self._named_type(NamedType(node.at, node.base))
        found = None if base is None else resolve_alias(base)
        if type(found) is StructType:
            return found.members
        if found is not None:
            self.error(node, f"{node.base} is no STRUCT, so none can extend it")
        return None

    def _value(self, node: Expression, following: int, base: ElementaryType[int]) -> int:
        number = self.integer(node)
        if number is None:
            return following
        if not base.minimum <= number < 1 << 8 * base.size:
            self.error(node, f"{number} is outside {base.minimum}..{base.maximum} of {base}")
        return base.wrap(number)

    def _made(self, node: Node, make: Callable[[], T]) -> T | None:
        try:
            return make()
        except DeclarationError as err:
            self.error(node, str(err).rstrip("."))
            return None

    # Lists of declarations

    def _members(self, declarations: Sequence[Declaration], name: str) -> list[Member] | None:
        members: list[Member] = []
        for declaration in declarations:
            data_type = self.data_type(declaration.specification, f"{name}_{declaration.name}")
            if data_type is not None:
                initial = self.initial(declaration, data_type)
                members.append(Member(declaration.name, data_type, initial))
        if self._report_duplicates(declarations, name):
            return None
        return members if len(members) == len(declarations) else None

    def _report_duplicates(self, declarations: Sequence[Declaration], name: str) -> bool:
        """Report names that are declared twice; False if there are none."""
        key = self.scope.dialect.key
        if len({key(declaration.name) for declaration in declarations}) == len(declarations):
            return False
        seen: set[str] = set()
        for declaration in declarations:
            if key(declaration.name) in seen:
                self.error(declaration, f"{name} declares {declaration.name} twice")
            seen.add(key(declaration.name))
        return True

    # Functions and function blocks

    def _local(self, node: FunctionDeclaration | FunctionBlockDeclaration) -> Scope:
        """Return the scope of the variables of a function or a function block."""
        file = DeclarationFile(node.blocks, "", self.file.tokens, self.file.diagnostics)
        return self.scope.inner(node.name, file, self._known)

    def _function(self, entry: PouEntry, node: FunctionDeclaration) -> DataType[object] | None:
        """Return the type of the result, None if there is none."""
        entry.scope = local = self._local(node)
        local.index.report_duplicates(local.dialect)
        (resolver,) = local.resolvers
        return resolver.data_type(node.result, node.name) if node.result is not None else None

    def _function_block(
        self, entry: PouEntry, node: FunctionBlockDeclaration
    ) -> DataType[object] | None:
        """Return the data block, None if it has no layout."""
        entry.scope = local = self._local(node)
        inherited = self._inherited(node, local)
        (resolver,) = local.resolvers
        resolver.entry, resolver.level = entry, self.level
        lasting = [variable for variable in local.index.variables if _has_place(variable)]
        members = [*inherited, *(resolver._member(variable) for variable in lasting)]
        resolver.entry, resolver.level = None, 0
        self._depth = resolver._depth
        known = [member for member in members if member is not None]
        if local.index.report_duplicates(local.dialect) or len(known) < len(members):
            return None
        return self._made(node, lambda: DataBlockType(node.name, known))

    def _inherited(self, node: FunctionBlockDeclaration, local: Scope) -> Sequence[Member | None]:
        """Return the members of what a function block EXTENDS; ``local`` sees its variables."""
        if not node.base:
            return ()
        base = self._named_type(NamedType(node.at, node.base))
        hit = self.scope.lookup("types", node.base)
        entry = None if hit is None else hit.entry
        if not isinstance(base, DataBlockType) or not isinstance(entry, PouEntry):
            if base is not None:
                self.error(node, f"{node.base} is no function block, so none can extend it")
            return (None,)
        assert entry.scope is not None
        local.outer = (entry.scope, self.scope)
        return base.members

    def _member(self, entry: VariableEntry) -> Member | None:
        """Return a member of a data block; a VAR_IN_OUT is a reference there."""
        node = entry.node
        section = _SECTIONS[entry.block.section]
        if section is Section.IN_OUT:
            specification = ReferenceSpecification(node.at, node.specification)
            reference = self._reference_to(specification, lambda: _completed(entry))
            return Member(node.name, reference, None, section)
        self.complete(entry)
        data_type = entry.data_type
        if data_type is None:
            return None
        is_retained = "RETAIN" in entry.block.qualifiers
        return Member(node.name, data_type, entry.value, section, is_retained)


def _completed(entry: VariableEntry) -> DataType[object] | None:
    entry.resolver.complete(entry)
    return entry.data_type


def _has_place(entry: VariableEntry) -> bool:
    """Whether a variable takes a place in its data block."""
    return entry.block.section in _SECTIONS and not entry.is_constant


_BUILDERS: dict[type, Callable[[FileResolver, Any, str], DataType[object] | None]] = {
    NamedType: FileResolver._named_type,
    StringSpecification: FileResolver._string,
    ArraySpecification: FileResolver._array,
    OpenArraySpecification: FileResolver._open_array,
    ReferenceSpecification: FileResolver._reference,
    SubrangeSpecification: FileResolver._subrange,
    EnumerationSpecification: FileResolver._enumeration,
    StructSpecification: FileResolver._struct,
}
