"""Finding .msg and .srv files by the name of a ROS type."""

from __future__ import annotations

import os
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.core.errors import PlcError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

MAX_BYTES = 1 << 20
"""Bytes of a definition that are read."""


def common_folders() -> list[Path]:
    """Return the folders of ROS_PACKAGE_PATH, then the definitions that come with crosnode.

    The latter are found as files of the same distribution; nothing of crosnode is imported.
    """
    folders = [
        Path(text) for text in os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if text
    ]
    spec = find_spec("crosnode")
    for place in spec.submodule_search_locations or () if spec is not None else ():
        folders.append(Path(place, "messages", "share"))
    return folders


class MessageFiles:
    """Definitions in folders of packages; the first that is found counts."""

    def __init__(self, folders: Iterable[Path]) -> None:
        self._folders = list(folders)

    def read(self, name: str, kind: str) -> str | None:
        """Return the text of ``pkg/Type``, None if there is no such file.

        Args:
            name: ``pkg/Type``.
            kind: ``msg`` or ``srv``.

        Raises:
            PlcError: the file cannot be read.
        """
        package, _, base = name.partition("/")
        for folder in self._packages(package):
            for file in (folder / kind / f"{base}.{kind}", folder / f"{base}.{kind}"):
                if file.is_file():
                    return _read(file)
        return None

    def _packages(self, package: str) -> Iterator[Path]:
        for folder in self._folders:
            if folder.name == package:
                yield folder
            yield folder / package
            yield from sorted(folder.glob(f"*/{package}"))


def _read(file: Path) -> str:
    try:
        with file.open("rb") as stream:
            return stream.read(MAX_BYTES).decode("utf-8", "replace")
    except OSError as err:
        raise PlcError(f"{file}: {err.strerror or err}.") from err
