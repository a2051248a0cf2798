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

AXIS: Final = "McAxisType"
AXES_GROUP: Final = "McAxesGroupType"
COMPONENT: Final = "MpComIdentType"

_TYPES: Final = {
    ".axis": AXIS,
    ".axesgroup": AXES_GROUP,
    ".assembly": "McAssemblyType",
    ".assembly6d": "Mc6DAssemblyType",
    ".sector": "McSectorType",
    ".processpoint": "McProcessPointType",
    ".visioncomponent": "ViComponentType",
}
"""Types of the variables by the suffix of the file; there is a variable where a library has the
type."""


class MappVariable(NamedTuple):
    """A variable that a configuration makes: its name, its type, and where it comes from."""

    name: str
    data_type: str
    file: Path
    line: int


def read_mapp_variables(folder: Path) -> tuple[list[MappVariable], list[Finding]]:
    """Read the configuration files of mapp below a folder; one name counts once."""
    variables: dict[str, MappVariable] = {}
    findings: list[Finding] = []
    for file, data_type in _files(folder):
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


def _files(folder: Path) -> Iterator[tuple[Path, str]]:
    """Yield the configuration files in folders of mapp, and the type of their variables."""
    for place, folders, names in os.walk(folder):
        folders.sort()
        inside = Path(place).relative_to(folder).parts
        if not any(part.lower().startswith("mapp") for part in inside):
            continue
        for name in sorted(names):
            suffix = Path(name).suffix.lower()
            data_type = _TYPES.get(suffix, COMPONENT if suffix.startswith(".mp") else "")
            if data_type:
                yield Path(place, name), data_type
