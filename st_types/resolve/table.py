"""From declarations to data types, constants and variables.

Names are resolved over all given files, so declarations may stand in any order and in any file.
What cannot be is an error in the ``diagnostics`` of its file, at its exact place. A name that no
given file declares is only a warning, for it may come from a library that is not here; types that
need it have no layout then. With ``strict`` it is an error.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.resolve.file_resolver import FileResolver
from st_types.resolve.name_index import Entry, NameIndex, SourceFile, nearest, report_duplicates
from st_types.syntax.collector import collector_paused
from st_types.syntax.tree import FunctionDeclaration

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from st_types.resolve.variables import Function, Variable
    from st_types.syntax.tree import Declaration, DeclarationFile, TypeSpecification
    from st_types.types.derived import ReferenceType
    from st_types.types.elementary import DataType


class TypeTable:
    """Data types, constants, functions and variables of a set of files.

    Attributes:
        strict: an unknown name is an error.
        variables: of the VAR blocks outside functions and function blocks, in order.
        functions: by name in capitals; of equal names the first.
        open: the declarations that are being resolved, the outermost first.
    """

    def __init__(
        self,
        files: Sequence[DeclarationFile],
        library: Sequence[DeclarationFile] = (),
        *,
        strict: bool = False,
    ) -> None:
        self.strict = strict
        self.variables: list[Variable] = []
        self.functions: dict[str, Function] = {}
        self.open: list[Entry] = []
        self._index = NameIndex(files)
        self._library = NameIndex(library)
        self._resolvers: dict[SourceFile, FileResolver] = {}
        self._references: list[tuple[ReferenceType, FileResolver, TypeSpecification]] = []
        self._resolving_references = False

    def find_type(self, name: str) -> DataType[object] | None:
        """Return the type or the function block's data block ``name``, None if there is none.

        Case does not matter; of several declarations the first is taken.
        """
        entry = self.find("types", name, None)
        return None if entry is None else self.resolved(entry).data_type

    def types(self) -> Iterator[tuple[Entry, DataType[object]]]:
        """Yield all declared types that have a layout, with their declarations, in order."""
        for entry in self._index.all_types():
            data_type = self.resolved(entry).data_type
            if data_type is not None:
                yield entry, data_type

    def find(self, kind: str, name: str, user: SourceFile | None) -> Entry | None:
        """Return what ``name`` means in the file ``user``.

        Args:
            kind: ``types``, ``constants``, ``enumeration_values`` or ``functions``.
            name: in any case.
            user: the file that names it; None takes the first of several.
        """
        for index in (self._index, self._library):
            candidates = getattr(index, kind).get(name.upper())
            if candidates:
                return nearest(candidates, user) if user else candidates[0]
        return None

    def constant_entry(self, node: Declaration) -> Entry | None:
        """Return the entry of a VAR CONSTANT outside functions and function blocks, else None."""
        candidates = self._index.constants.get(node.name.upper(), ())
        return next((self.resolved(e) for e in candidates if e.node is node), None)

    def resolved(self, entry: Entry) -> Entry:
        """Resolve ``entry`` if that is not done yet, and return it.

        An entry that is being resolved comes back as it is, ``state`` 1.
        """
        if entry.state == 0:
            entry.state = 1
            self.open.append(entry)
            self._resolver(entry.owner).resolve(entry)
            self.open.pop()
            entry.state = 2
            if not self.open:
                self._resolve_references()
        return entry

    def _resolver(self, owner: SourceFile) -> FileResolver:
        if owner not in self._resolvers:
            self._resolvers[owner] = FileResolver(self, owner)
        return self._resolvers[owner]

    def resolve_later(
        self, reference: ReferenceType, resolver: FileResolver, target: TypeSpecification
    ) -> None:
        """Remember a reference: what it refers to may contain the reference itself."""
        self._references.append((reference, resolver, target))

    def _resolve_references(self) -> None:
        if self._resolving_references:
            return
        self._resolving_references = True
        while self._references:
            reference, resolver, target = self._references.pop()
            reference.target = resolver.data_type(target, "")
        self._resolving_references = False

    def resolve_all(self) -> None:
        """Resolve all declarations of the files, constants first."""
        for kind in ("types", "functions"):
            report_duplicates(self._index, kind)
        for entries in (self._index.constants, self._index.types):
            for entry in [entry for named in entries.values() for entry in named]:
                self.resolved(entry)
        for owner in self._index.files:
            self._resolve_blocks(owner)
        self._resolve_references()

    def _resolve_blocks(self, owner: SourceFile) -> None:
        resolver = self._resolver(owner)
        self.variables += resolver.file_variables()
        for item in owner.file.items:
            if isinstance(item, FunctionDeclaration):
                function = resolver.function(item)
                self.functions.setdefault(item.name.upper(), function)


def resolve(
    files: Sequence[DeclarationFile],
    library: Sequence[DeclarationFile] = (),
    *,
    strict: bool = False,
) -> TypeTable:
    """Resolve all declarations of ``files``.

    Args:
        files: parsed files; findings go to their ``diagnostics``.
        library: further files whose names may be used; their findings are of no interest.
        strict: an unknown name is an error, not a warning.
    """
    with collector_paused():
        table = TypeTable(files, library, strict=strict)
        table.resolve_all()
    return table
