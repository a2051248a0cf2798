"""Where definition files lie: package folders as ROS, catkin, Debian and cROS lay them out.

Under each path of a search the file of ``pkg/Name`` may be

- ``pkg/msg/Name.msg`` (an installed ``share`` folder, a folder of packages),
- ``pkg/Name.msg`` (cROS' flat ``rosdb``),
- ``msg/Name.msg`` when the path is the package ``pkg`` itself,
- ``…/pkg/msg/Name.msg`` deeper down, where ``package.xml`` or ``manifest.xml`` marks the package.
"""

from __future__ import annotations

import re
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING

from crosnode.errors import DefinitionError
from crosnode.messages.definition import split_type_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

SHARE = Path(__file__).with_name("share")
"""The common packages that come with crosnode, in bare field lists."""

MAX_DEPTH = 6
"""Folders below a search path that are looked through for packages."""

MAX_FILE_SIZE = 1 << 20
"""Bytes; no definition is larger."""


class DefinitionKind(Enum):
    """Kinds of definition files; the value is folder and suffix."""

    MESSAGE = "msg"
    SERVICE = "srv"
    ACTION = "action"


class PackagePath:
    """An ordered list of folders in which definition files are looked up.

    Args:
        paths: folders, first match wins; those that do not exist are passed over, as ROS does.
    """

    def __init__(self, paths: Iterable[Path]) -> None:
        self.paths = tuple(Path(path) for path in paths)
        self._packages: dict[Path, dict[str, Path]] = {}

    def read(self, name: str, kind: DefinitionKind) -> str | None:
        """Return the text of a definition, or None where no file has it.

        Raises:
            DefinitionError: the file cannot be read.
        """
        package, base = split_type_name(name)
        for folder in self._folders(package):
            for file in (
                folder / kind.value / f"{base}.{kind.value}",
                folder / f"{base}.{kind.value}",
            ):
                if _is_file(file):
                    return _read_text(file)
        return None

    def _folders(self, package: str) -> Iterator[Path]:
        for path in self.paths:
            yield path / package
            if package in self._packages_below(path):
                yield self._packages_below(path)[package]

    def _packages_below(self, path: Path) -> dict[str, Path]:
        if path not in self._packages:
            self._packages[path] = dict(_find_packages(path, MAX_DEPTH))
        return self._packages[path]


def _read_text(file: Path) -> str:
    try:
        if file.stat().st_size > MAX_FILE_SIZE:
            raise DefinitionError(f"{file}: larger than {MAX_FILE_SIZE} bytes.")
        return file.read_text(encoding="utf-8-sig", errors="replace")
    except OSError as error:
        raise DefinitionError(f"{file}: {error.strerror}.") from error


def _find_packages(path: Path, depth: int) -> Iterator[tuple[str, Path]]:
    """Yield name and folder of packages at ``path`` and below; no packages inside packages.

    What may not be looked into holds nothing for us, as for ROS.
    """
    if name := _package_name(path):
        yield name, path
    elif depth:
        for folder in sorted(_subfolders(path)):
            yield from _find_packages(folder, depth - 1)


def _subfolders(path: Path) -> list[Path]:
    try:
        return [p for p in path.iterdir() if not p.name.startswith(".") and _is_folder(p)]
    except OSError:
        return []


def _package_name(folder: Path) -> str | None:
    for manifest in ("package.xml", "manifest.xml"):
        file = folder / manifest
        if _is_file(file):
            return _name_in(file) or folder.name
    holds = any(_is_folder(folder / kind.value) for kind in DefinitionKind)
    return folder.name if holds or _has_flat_files(folder) else None


def _name_in(manifest: Path) -> str | None:
    try:
        match = re.search(r"<name>\s*([A-Za-z]\w*)\s*</name>", _read_text(manifest), re.A)
    except DefinitionError:
        return None
    return match[1] if match else None


def _has_flat_files(folder: Path) -> bool:
    try:
        return any(any(folder.glob(f"*.{kind.value}")) for kind in DefinitionKind)
    except OSError:
        return False


def _is_file(path: Path) -> bool:
    """Whether a file is there; one behind a folder that may not be searched is not, for us."""
    try:
        return path.is_file()
    except OSError:
        return False


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError:
        return False
