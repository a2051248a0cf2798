"""Units, limits and descriptions of tags, from the project's tag map (tags.csv)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.modbus.map.csv_file import read_file
from plcsim.modbus.settings import TAGS_FILE
from plcsim.opcua.model import Note

if TYPE_CHECKING:
    from pathlib import Path


def notes_of(folder: Path) -> dict[str, Note]:
    """Return what the tag map of a project says, by tag; nothing where it has none.

    Limits of a row are in engineering units; those of a scaled row do not bound the variable
    itself, and are left out.

    Raises:
        TagMapError: the file is wrong.
    """
    file = folder / TAGS_FILE
    if not file.is_file():
        return {}
    notes: dict[str, Note] = {}
    for row in read_file(file):
        is_scaled = (row.scale, row.offset_eu) != (1.0, 0.0)
        limits = (None, None) if is_scaled else (row.minimum, row.maximum)
        unit = "" if is_scaled else row.unit
        notes.setdefault(row.tag, Note(unit, *limits, row.description))
    return notes
