"""Which declarations a name may stand for, and which of them is meant.

Controllers know scopes: a program's own folder, the packages around it, libraries, all of the
project. A name used in a file means the declaration in that file, else the one in the nearest
folder: the one whose path shares most with the file's own. So two programs may each have a type
``Parameters``, and a tree of many projects can be checked in one go.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import PurePath
from typing import TYPE_CHECKING

from st_types.syntax.tree import (
    Declaration,
    DeclarationFile,
    EnumerationSpecification,
    FunctionBlockDeclaration,
    FunctionDeclaration,
    TypeBlock,
    VariableBlock,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from st_types.types.elementary import DataType

Declared = Declaration | FunctionBlockDeclaration | FunctionDeclaration


@dataclass(slots=True, eq=False)
class Entry:
    """One declaration and what became of it.

    Attributes:
        owner: the file it stands in.
        node: the declaration; of a constant its variable, of an enumeration value its type.
        is_constant: it is a VAR CONSTANT.
        state: 0 not yet resolved, 1 being resolved, 2 done.
        data_type: None until it is resolved, and where it has no layout.
        value: value of a VAR CONSTANT, likewise.
        depth: how many types lie one inside the other, this one counted.
    """

    owner: SourceFile
    node: Declared
    is_constant: bool = False
    state: int = 0
    data_type: DataType[object] | None = None
    value: object = None
    depth: int = 0


class SourceFile:
    """A parsed file and the parts of the path of its folder."""

    __slots__ = ("file", "folder")

    def __init__(self, file: DeclarationFile) -> None:
        self.file = file
        self.folder = PurePath(file.path).parent.parts


def report_duplicates(index: NameIndex, kind: str) -> None:
    """Record what is declared twice: an error in one file, a warning in two files of a folder."""
    for entries in getattr(index, kind).values():
        first_of_folder: dict[tuple[str, ...], Entry] = {}
        for entry in entries:
            first = first_of_folder.setdefault(entry.owner.folder, entry)
            if first is not entry:
                _report_duplicate(first, entry)


def _report_duplicate(first: Entry, entry: Entry) -> None:
    file = entry.owner.file
    message = (
        f"{entry.node.name} is declared twice; first at {first.owner.file.location(first.node)}"
    )
    if first.owner is entry.owner:
        file.error(entry.node, message)
    else:
        file.warning(entry.node, message)


class NameIndex:
    """Types, constants, enumeration values and functions of a set of files, by name in capitals."""

    def __init__(self, files: Sequence[DeclarationFile]) -> None:
        self.files = [SourceFile(file) for file in files]
        self.types: dict[str, list[Entry]] = {}
        self.constants: dict[str, list[Entry]] = {}
        self.enumeration_values: dict[str, list[Entry]] = {}
        self.functions: dict[str, list[Entry]] = {}
        for owner in self.files:
            self._add_file(owner)

    def _add_file(self, owner: SourceFile) -> None:
        for item in owner.file.items:
            match item:
                case TypeBlock():
                    for declaration in item.declarations:
                        self._add_type(owner, declaration)
                case FunctionBlockDeclaration():
                    _add(self.types, Entry(owner, item))
                case FunctionDeclaration():
                    _add(self.functions, Entry(owner, item))
                case VariableBlock() if "CONSTANT" in item.qualifiers:
                    for declaration in item.declarations:
                        _add(self.constants, Entry(owner, declaration, is_constant=True))

    def _add_type(self, owner: SourceFile, declaration: Declaration) -> None:
        entry = Entry(owner, declaration)
        _add(self.types, entry)
        if isinstance(declaration.specification, EnumerationSpecification):
            for value in declaration.specification.values:
                self.enumeration_values.setdefault(value.name.upper(), []).append(entry)

    def all_types(self) -> Iterator[Entry]:
        """Yield the entries of all types, also of those that are hidden by nearer ones."""
        for entries in self.types.values():
            yield from entries


def _add(names: dict[str, list[Entry]], entry: Entry) -> None:
    names.setdefault(entry.node.name.upper(), []).append(entry)


def nearest(candidates: Sequence[Entry], user: SourceFile) -> Entry:
    """Return the declaration that is meant where ``user`` names it; the first of equals."""
    if len(candidates) == 1:
        return candidates[0]
    return max(candidates, key=lambda entry: _nearness(entry.owner, user))


def _nearness(owner: SourceFile, user: SourceFile) -> tuple[bool, int, int]:
    if owner is user:
        return True, 0, 0
    shared = 0
    for a, b in zip(owner.folder, user.folder, strict=False):
        if a != b:
            break
        shared += 1
    return False, shared, -len(owner.folder)
