"""Writes ``interface.py`` of a library: its face for editors and type checkers.

What the file says of members is said for them alone: at run time the members come from the
declarations. A test shows that the files of this package are fresh. What a project or a program
declares has the same face, as the stub of a package: ``__init__.pyi``.
"""

from __future__ import annotations

import keyword
import re
from typing import TYPE_CHECKING, Final, NamedTuple, Protocol

from plcsim.library.installed import installed
from st_types.syntax.trivia import comments_behind
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    StringType,
    StructType,
    SubrangeType,
    UnionType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import ElementaryType, Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from st_types.resolve.scope import Scope
    from st_types.types.elementary import DataType

_BUILTINS: Final = frozenset(["bool", "int", "float", "str"])
LONGEST_LINE: Final = 100

_FACE: Final = "plcsim.library.face"


class FaceSource(Protocol):
    """Declarations and the package that Python finds them in: a library, a project, a program."""

    @property
    def name(self) -> str:
        """Of the library, or of the folder."""

    @property
    def package(self) -> str:
        """What Python imports them from."""

    @property
    def scope(self) -> Scope:
        """What is declared."""


class FolderFace(NamedTuple):
    """The package of a project or a program; see `FaceSource`."""

    name: str
    package: str
    scope: Scope


class _Line(NamedTuple):
    """A name, what it is, and the comment of its declaration."""

    name: str
    data_type: DataType[object]
    comment: str


def interface_source(library: FaceSource, others: Iterable[FaceSource] = ()) -> str:
    """Return the text of a library's ``interface.py``, or of the stub of another package.

    Args:
        library: whose face it is.
        others: that it sees, beside the libraries that are installed.
    """
    return _Writer(library, others).text()


class _Writer:
    """Writes the classes and remembers what they import."""

    def __init__(self, library: FaceSource, others: Iterable[FaceSource]) -> None:
        self._library = library
        self._others = [*others, *installed().values()]
        self._scope = library.scope
        self._imports: set[tuple[str, str]] = set()
        self._for_types: set[tuple[str, str]] = set()
        self._public: list[str] = []

    def text(self) -> str:
        """Return the module."""
        body = "".join((*self._constants(), *self._types()))
        public = sorted(self._public, key=_export_order)
        body += "".join(self._blocks())
        head = (
            f'"""{_kind_of(self._library)} {self._library.name} as Python sees it.\n\n'
            "Written from its declarations by ``plcsim types library``; not to be edited.\n"
            '"""\n\nfrom __future__ import annotations\n'
        )
        declared = "\n_DECLARED = declared_beside(__name__)\n"
        head += self._import_lines() + _all(public)
        return head + (declared if "_DECLARED" in body else "") + body

    def _use(self, module: str, name: str) -> str:
        self._imports.add((module, name))
        return name

    def _import_lines(self) -> str:
        if self._for_types:
            self._use("typing", "TYPE_CHECKING")
        groups = {True: "", False: ""}
        for line, is_ours in _imports(self._imports):
            groups[is_ours] += line
        text = "".join(f"\n{groups[ours]}" for ours in (False, True) if groups[ours])
        for_types = "".join(f"    {line}" for line, _ in _imports(self._for_types))
        return text + (f"\nif TYPE_CHECKING:\n{for_types}" if for_types else "")

    def _constants(self) -> Iterator[str]:
        for variable in self._scope.variables:
            if variable.is_constant and isinstance(variable.initial, bool | int | float | str):
                final = self._use("typing", "Final")
                self._public.append(variable.name)
                yield f"\n{variable.name}: {final} = {variable.initial!r}\n"
                yield _doc(_comment(variable.node.behind), "")

    def _types(self) -> Iterator[str]:
        for name, data_type, node, _ in self._scope.types:
            if isinstance(data_type, EnumerationType | StructType):
                self._public.append(name)
            comment = _comment(node.behind) or _comment(getattr(node.specification, "behind", ""))
            if isinstance(data_type, EnumerationType):
                yield from self._enumeration(name, data_type.values, comment)
            elif isinstance(data_type, StructType):
                behind = [_comment(m.behind) for m in getattr(node.specification, "members", ())]
                behind += [""] * (len(data_type.members) - len(behind))
                pairs = zip(data_type.members, behind, strict=True)
                lines = [_Line(m.name, m.data_type, text) for m, text in pairs]
                base = "Union" if isinstance(data_type, UnionType) else "Struct"
                yield from self._class(name, self._use("st_types", base), comment, lines)

    def _enumeration(self, name: str, values: Mapping[str, int], comment: str) -> Iterator[str]:
        self._use(_FACE, "declared_beside")
        yield f"\n\nclass {name}({self._use('enum', 'IntEnum')}):\n"
        yield _doc(comment or f"Enumeration {name}", "    ") + "\n"
        yield from (f"    {key} = {value}\n" for key, value in values.items())
        yield f"\n\n_DECLARED.enumeration({name})\n"

    def _blocks(self) -> Iterator[str]:
        for block in self._scope.function_blocks:
            if block.data_type is None:
                continue
            comments = {v.name: _comment(v.node.behind) for v in block.variables}
            lines = [
                _Line(m.name, m.data_type, comments.get(m.name, ""))
                for m in block.data_type.members
            ]
            base = self._use("plcsim.core.function_block", "FunctionBlock")
            yield from self._class(block.name, base, _comment(block.node.behind), lines)

    def _class(self, name: str, base: str, comment: str, members: Iterable[_Line]) -> Iterator[str]:
        self._use(_FACE, "declared_beside")
        yield f"\n\nclass {name}({base}):\n"
        yield _doc(comment or name, "    ")
        yield f'\n    _plc_type = _DECLARED["{name}"]\n'
        hidden = {member.name for member in members} & _BUILTINS
        for member in members:
            if keyword.iskeyword(member.name):
                continue  # read it with getattr()
            kind = self._annotation(member.data_type)
            if kind in hidden:
                kind = f"builtins.{kind}"
                self._for_types.add(("", "builtins"))
            yield f"\n    {member.name}: {kind}\n"
            yield _doc(member.comment, "    ")

    def _annotation(self, data_type: DataType[object]) -> str:
        """Return what a member of a type is in Python."""
        match resolve_alias(data_type):
            case ElementaryType(kind=Kind.BOOL):
                return "bool"
            case ElementaryType(kind=Kind.REAL):
                return "float"
            case StringType() | WStringType():
                return "str"
            case ArrayType(element=element):
                self._for_types.add(("st_types", "Array"))
                return f"Array[{self._annotation(element)}]"
            case StructType(name=name) | EnumerationType(name=name):
                return self._named(name)
            case ElementaryType() | SubrangeType() | _:
                return "int"

    def _named(self, name: str) -> str:
        owner = self._scope.owner_of(name)
        if owner is self._scope:
            return name
        for library in self._others:
            if library.scope is owner:
                self._for_types.add((_module(library.package, self._library.package), name))
                return name
        return "int"


def _kind_of(declared: FaceSource) -> str:
    return "What is declared in" if isinstance(declared, FolderFace) else "Library"


def _imports(names: Iterable[tuple[str, str]]) -> Iterator[tuple[str, bool]]:
    """Iterate over import lines, and whether what they import is of this family of packages."""
    for module in sorted({module for module, _ in names}):
        inside = [name for each, name in names if each == module]
        found = ", ".join(sorted(inside, key=lambda name: (not name.isupper(), name)))
        line = f"from {module} import {found}\n" if module else f"import {found}\n"
        yield line, module.startswith(("plcsim", "st_types", "."))


def _module(other: str, own: str) -> str:
    """Return how a module in one package names another: relative, where they have one root."""
    theirs, ours = other.split("."), own.split(".")
    if theirs[0] != ours[0] or theirs[0] == "plcsim":
        return other
    while ours and theirs and ours[0] == theirs[0]:
        del ours[0], theirs[0]
    return "." * (len(ours) + 1) + ".".join(theirs)


def _export_order(name: str) -> tuple[int, list[tuple[int, int, str]]]:
    """Constants, then classes, then the rest, numbers in names by their value, as ruff wants it."""
    kind = 0 if name.isupper() else 1 if name[0].isupper() else 2
    parts = re.split(r"(\d+)", name)
    return kind, [(0, int(p), p) if p.isdecimal() else (1, 0, p) for p in parts if p]


def _all(names: Sequence[str]) -> str:
    """Return what a star import takes: all but the faces of blocks, which are no bodies."""
    line = "[" + ", ".join(f'"{name}"' for name in names) + "]"
    if len(line) > LONGEST_LINE - len("__all__ = "):
        line = "[\n" + "".join(f'    "{name}",\n' for name in names) + "]"
    return f"\n__all__ = {line}\n"


def _comment(trivia: str) -> str:
    """Return what is written behind a declaration, in one line."""
    text = " ".join(comments_behind(trivia))
    for mark in ("(*", "*)", "/*", "*/", "//"):
        text = text.replace(mark, " ")
    return " ".join(text.split())


def _doc(comment: str, indent: str) -> str:
    """Return a docstring of one line, or more where it is long; "" for no comment."""
    if not comment:
        return ""
    text = comment.replace("\\", "\\\\").replace('"', "'")
    text = f"{text[0].upper()}{text[1:].rstrip('.')}."
    return f'{indent}"""{text}"""\n'
