"""The declarations of one scope, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, Literal

from st_types.syntax.tree import (
    Declaration,
    EnumerationSpecification,
    FunctionBlockDeclaration,
    FunctionDeclaration,
    TypeBlock,
    VariableBlock,
)
from st_types.types.spelling import Spellings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from st_types.resolve.declared import DeclaredFunction, DeclaredFunctionBlock, DeclaredVariable
    from st_types.resolve.dialect import Dialect
    from st_types.resolve.file_resolver import FileResolver
    from st_types.resolve.scope import Scope
    from st_types.syntax.expressions import Node
    from st_types.types.elementary import DataType

NameSpace = Literal["types", "functions", "variables", "constants"]
"""Names of one name space hide one another: types and function blocks; functions; variables; what
has a value before the run, which is VAR CONSTANT and the values of enumerations."""

NEW: Final = 0
OPEN: Final = 1
DONE: Final = 2


class IndexEntry:
    """One declaration and what became of it.

    Attributes:
        resolver: resolves the file it stands in.
        node: the declaration.
        state: NEW, OPEN while it is being resolved, DONE.
        user: while it is OPEN, the entry that needs it.
        data_type: None until it is resolved, and where it has no layout.
        depth: how many types lie one inside the other, this one counted.
    """

    # Most entries are resolved once and asked for by nobody: what is not set stands here.
    state = NEW
    user: IndexEntry | None = None
    data_type: DataType[object] | None = None
    depth = 0

    def __init__(self, resolver: FileResolver, node: Node) -> None:
        self.resolver = resolver
        self.node: Any = node

    @property
    def name(self) -> str:
        """The name as it is declared."""
        name: str = self.node.name
        return name


class TypeEntry(IndexEntry):
    """A type of a TYPE block; an enumeration is the entry of each of its values, too."""

    node: Declaration


class PouEntry(IndexEntry):
    """A function, whose ``data_type`` is its result, or a function block with its data block.

    Attributes:
        scope: of its variables, once it is resolved.
        made: what `Scope` makes of it for others.
    """

    node: FunctionDeclaration | FunctionBlockDeclaration
    scope: Scope | None = None
    made: DeclaredFunction | DeclaredFunctionBlock | None = None


class VariableEntry(IndexEntry):
    """A variable or a constant.

    Attributes:
        block: the VAR block it stands in.
        is_constant: that is a VAR CONSTANT.
        value: initial value; None for that of the type.
        made: what `Scope` makes of it for others.
    """

    node: Declaration
    value: object = None
    made: DeclaredVariable | None = None

    def __init__(
        self, resolver: FileResolver, node: Declaration, block: VariableBlock, *, is_constant: bool
    ) -> None:
        self.resolver = resolver
        self.node = node
        self.block = block
        self.is_constant = is_constant


class ScopeIndex:
    """All declarations of the files of a scope.

    Attributes:
        types: types and function blocks, in order, those of equal names too.
        functions: likewise.
        variables: of the VAR blocks outside functions and function blocks.
    """

    def __init__(self, resolvers: Sequence[FileResolver]) -> None:
        self.types: list[TypeEntry | PouEntry] = []
        self.functions: list[PouEntry] = []
        self.variables: list[VariableEntry] = []
        self._inline: list[TypeEntry] = []
        self._names: dict[NameSpace, dict[str, IndexEntry]] = {}
        self._spellings: dict[NameSpace, Spellings] = {}
        for resolver in resolvers:
            self._add_file(resolver)

    def _add_file(self, resolver: FileResolver) -> None:
        for item in resolver.file.items:
            match item:
                case TypeBlock():
                    self.types += [TypeEntry(resolver, node) for node in item.declarations]
                case VariableBlock():
                    self._add_variables(resolver, item)
                case FunctionBlockDeclaration():
                    self.types.append(PouEntry(resolver, item))
                case FunctionDeclaration():
                    self.functions.append(PouEntry(resolver, item))

    def _add_variables(self, resolver: FileResolver, block: VariableBlock) -> None:
        is_constant = "CONSTANT" in block.qualifiers
        self.variables += [
            VariableEntry(resolver, node, block, is_constant=is_constant)
            for node in block.declarations
        ]
        self._inline += [
            TypeEntry(resolver, Declaration(node.at, node.name, node.specification))
            for node in block.declarations
            if type(node.specification) is EnumerationSpecification
        ]

    def names(self, space: NameSpace) -> dict[str, IndexEntry]:
        """Return the entries of a name space by name; of equal names the first."""
        found = self._names.get(space)
        if found is None:
            found = self._names[space] = self._named(space)
        return found

    def spellings(self, space: NameSpace) -> Spellings:
        """Return the names of a name space, to be asked without regard to case."""
        found = self._spellings.get(space)
        if found is None:
            found = self._spellings[space] = Spellings(self.names(space))
        return found

    def _named(self, space: NameSpace) -> dict[str, IndexEntry]:
        found: dict[str, IndexEntry] = {}
        if space == "constants":
            self._add_constants(found)
            return found
        for entry in getattr(self, space):
            found.setdefault(entry.node.name, entry)
        return found

    def _add_constants(self, found: dict[str, IndexEntry]) -> None:
        for entry in self.variables:
            if entry.is_constant:
                found.setdefault(entry.node.name, entry)
        for each in (*self.types, *self._inline):
            if type(each) is TypeEntry:
                specification = each.node.specification
                if type(specification) is EnumerationSpecification:
                    for value in specification.values:
                        found.setdefault(value.name, each)

    def report_duplicates(self, dialect: Dialect) -> bool:
        """Record what is declared twice: True if that is an error.

        It is one in one file, except for constants that say the same, and a warning in two files.
        """
        has_errors = False
        lists: tuple[Sequence[IndexEntry], ...] = (self.types, self.functions, self.variables)
        for entries in lists:
            names = [entry.node.name for entry in entries]
            if not dialect.case_sensitive:
                names = [name.upper() for name in names]
            if len(set(names)) == len(names):
                continue
            first_of_name: dict[str, IndexEntry] = {}
            for name, entry in zip(names, entries, strict=True):
                first = first_of_name.setdefault(name, entry)
                if first is not entry:
                    has_errors |= _report_duplicate(first, entry)
        return has_errors


def _report_duplicate(first: IndexEntry, entry: IndexEntry) -> bool:
    file, other = entry.resolver.file, first.resolver.file
    message = f"{entry.node.name} is declared twice; first at {other.location(first.node)}"
    is_error = file is other and not _say_the_same(first, entry)
    (file.error if is_error else file.warning)(entry.node, message)
    return is_error


def _say_the_same(one: IndexEntry, other: IndexEntry) -> bool:
    entries = (one, other)
    are_constants = all(isinstance(e, VariableEntry) and e.is_constant for e in entries)
    return are_constants and one.node == other.node
