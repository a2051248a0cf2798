"""Global variables that the configuration of mapp makes.

Each ``<Element ID="gAxis">`` of a configuration file under Physical is a variable ``gAxis`` for the
programs, which hand its address to function blocks of mapp.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.library.document import DocumentError, read_document
from plcsim.project.automation_studio.finding import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.project.automation_studio.names import FileNames

AXIS: Final = "McAxisType"
AXES_GROUP: Final = "McAxesGroupType"
COMPONENT: Final = "MpComIdentType"

_TYPES: Final = {
    ".axesgroup": AXES_GROUP,
    ".assembly": "McAssemblyType",
    ".assembly6d": "Mc6DAssemblyType",
    ".sector": "McSectorType",
    ".processpoint": "McProcessPointType",
    ".visioncomponent": "ViComponentType",
}
"""Types of the variables by the suffix of the file; there is a variable where a library has the
type. What ends in ``axis`` (``.axis``, ``.purevaxis``, ``.stpaxis`` ...) is an axis."""

_LISTS: Final = frozenset(["package.pkg", "config.pkg", "cpu.pkg", "plc.pkg"])
"""Lists of files, in small letters."""


class MappVariable(NamedTuple):
    """A variable that a configuration makes: its name, its type, and where it comes from."""

    name: str
    data_type: str
    file: Path
    line: int


def read_mapp_variables(folder: Path, names: FileNames) -> tuple[list[MappVariable], list[Finding]]:
    """Read the configuration files of mapp below a folder; one name counts once.

    Args:
        folder: of the configuration.
        names: of the project's files, for lists that refer to files of another configuration.
    """
    variables: dict[str, MappVariable] = {}
    findings: list[Finding] = []
    for file in dict.fromkeys(_files(folder, folder, names, set())):
        data_type = _type_of(file)
        if not data_type:
            continue
        try:
            root = read_document(file)
        except DocumentError as err:
            findings.append(Finding(file, err.line, str(err)))
            continue
        for element in root.all("Element"):
            name = element.get("ID").strip()
            if name:
                variables.setdefault(name, MappVariable(name, data_type, file, element.line))
    return list(variables.values()), findings


def _type_of(file: Path) -> str:
    """Return the type of the variables that a file makes, "" for a file that makes none."""
    suffix = file.suffix.lower()
    if suffix.endswith("axis"):
        return AXIS
    return _TYPES.get(suffix, COMPONENT if suffix.startswith(".mp") else "")


def _files(folder: Path, top: Path, names: FileNames, seen: set[Path]) -> Iterator[Path]:
    """Yield the files in folders of mapp below ``top``, and those that lists refer to."""
    for place, folders, inside in os.walk(folder):
        folders.sort()
        parts = Path(place).relative_to(top).parts
        is_mapp = any(part.lower().startswith("mapp") for part in parts)
        for name in sorted(inside):
            if name.lower() in _LISTS:
                yield from _referred(Path(place, name), names, seen)
            if is_mapp:
                yield Path(place, name)


def _referred(file: Path, names: FileNames, seen: set[Path]) -> Iterator[Path]:
    """Yield the files of mapp that a list refers to, or the files of packages of mapp."""
    try:
        objects = read_document(file).all("Object")
    except DocumentError:  # the configuration tells of it
        return
    for element in objects:
        if not element.is_true("Reference"):
            continue
        found = names.referenced(file.parent, element.text.strip())
        if found is None or found in seen:
            continue
        seen.add(found)
        folder = found if found.is_dir() else found.parent
        if element.get("Type") == "File":
            yield found
        elif not file.is_relative_to(folder):
            yield from _files(folder, folder.parent, names, seen)
