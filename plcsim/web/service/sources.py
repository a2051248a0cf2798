"""The sources of the programs, and which variables stand on which line."""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.errors import PlcError
from plcsim.core.tag import locate
from st_types.types.derived import ArrayType, StructType

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from plcsim.core.tag import Tag
    from plcsim.shared_image import Directory

LARGEST: Final = 1 << 20
"""Bytes of a file that is shown."""

PER_LINE: Final = 8
"""VariableTree of one line that are named."""

SUFFIXES: Final = frozenset((".py", ".st", ".c", ".cpp", ".h", ".hpp", ".var", ".typ", ".fun"))

_NAME: Final = re.compile(r"[A-Za-z_]\w*(?:\s*\.\s*[A-Za-z_]\w*|\[\s*-?\d+(?:\s*,\s*-?\d+)*\s*\])*")
_QUIET: Final = {
    ".py": re.compile(r"#.*|'[^'\n]*'|\"[^\"\n]*\""),
    ".c": re.compile(r"//.*|/\*.*?\*/|'[^'\n]*'|\"[^\"\n]*\""),
    "": re.compile(r"//.*|\(\*.*?\*\)|'[^'\n]*'|\"[^\"\n]*\""),
}


class ProgramFiles(NamedTuple):
    """A program in a task class.

    Attributes:
        name: the first part of its tags.
        folder: that its files are named from.
        files: by the name under which they are shown.
    """

    name: str
    folder: Path
    files: Mapping[str, Path]


class Sources:
    """The sources of a project.

    Args:
        folder: of the project.
        directory: of its variables.
    """

    def __init__(self, folder: Path, directory: Directory) -> None:
        self._folder = folder
        self._directory = directory
        self._programs: dict[str, ProgramFiles] | None = None

    def programs(self) -> list[dict[str, Any]]:
        """Return the programs, each with its files.

        Raises:
            ConfigurationError: the project cannot be read any more.
        """
        if self._programs is None:
            self._programs = _programs(self._folder)
        return [{"name": p.name, "files": list(p.files)} for p in self._programs.values()]

    def read(self, name: str, file: str) -> dict[str, Any]:
        """Return the lines of a file of a program, each with the paths of variables on it.

        Raises:
            PlcError: there is no such file, or it is too long.
        """
        self.programs()
        program = (self._programs or {}).get(name)
        path = None if program is None else program.files.get(file)
        if path is None:
            raise PlcError(f"there is no file {file[:80]!r} of a program {name[:80]!r}")
        try:
            data = path.read_bytes()
        except OSError as err:
            raise PlcError(f"{file}: {err.strerror}") from None
        if len(data) > LARGEST:
            raise PlcError(f"{file}: has more than {LARGEST} bytes")
        lines = data.decode("utf-8-sig", "replace").splitlines()
        found = cache(lambda text: self._tag(name, text))
        return {"lines": [[line, self._on(line, path.suffix.lower(), found)] for line in lines]}

    def _on(self, line: str, suffix: str, found: Any) -> list[list[str]]:
        """Return [as it stands there, path] of the variables on a line."""
        quiet = _QUIET.get(".c" if suffix in (".cpp", ".h", ".hpp") else suffix, _QUIET[""])
        names: dict[str, str] = {}
        for match in _NAME.finditer(quiet.sub(" ", line)):
            text = re.sub(r"\s+", "", match[0])
            bare = text.removeprefix("self.")
            path = found(bare)
            if path:
                names.setdefault(path, bare)
        return [[name, path] for path, name in list(names.items())[:PER_LINE]]

    def _tag(self, program: str, text: str) -> str:
        """Return the path of the longest part of a name that is a variable, "" for none."""
        parts = re.findall(r"\w+|\[[^]]*\]", text)
        for length in range(len(parts), 0, -1):
            inner = "".join(p if p[0] == "[" else f".{p}" for p in parts[:length])
            for path in (f"{program}{inner}", inner[1:]):
                tag = _located(path, self._directory.areas)
                if tag is not None and not isinstance(tag.data_type, StructType | ArrayType):
                    return path
        return ""


def _located(path: str, areas: Sequence[Tag]) -> Tag | None:
    try:
        return locate(path, areas)
    except KeyError:
        return None


def _programs(folder: Path) -> dict[str, ProgramFiles]:
    # not at the top: half of the time that the service takes to start
    from plcsim.project.plc_toml import read_project  # noqa: PLC0415

    project = read_project(folder)
    found = {}
    for entry in project.programs:
        place = project.layout.programs.get(entry.source)
        if place is None:
            continue
        files = [file for file in place.own.files if file.suffix.lower() in SUFFIXES]
        named = {_shown(file, folder): file for file in files}
        found[entry.name] = ProgramFiles(entry.name, folder, named)
    return found


def _shown(file: Path, folder: Path) -> str:
    return file.relative_to(folder).as_posix() if file.is_relative_to(folder) else file.name
