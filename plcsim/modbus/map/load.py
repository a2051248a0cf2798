"""The map of a project: tags.csv, automatic addresses, or both."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from plcsim.modbus.map.automatic import LOCK_FILE, all_tags, give_addresses, locked_rows
from plcsim.modbus.map.csv_file import read_file
from plcsim.modbus.map.errors import TagMapError
from plcsim.modbus.map.resolve import resolve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.tag import Tag, TagTable
    from plcsim.modbus.map.point import MapRow, Point
    from plcsim.modbus.settings import ModbusSettings


class TagMap(NamedTuple):
    """The map of a project.

    Attributes:
        rows: as written or given, in order.
        points: one for each row.
        lock: rows of the lock file as it should be.
        is_locked: False where the lock file has to be written first.
    """

    rows: Sequence[MapRow]
    points: Sequence[Point]
    lock: Sequence[MapRow]
    is_locked: bool


def load_map(
    settings: ModbusSettings, folder: Path, tags: TagTable, areas: Sequence[Tag]
) -> TagMap:
    """Return the map of a project; nothing is written.

    Raises:
        TagMapError: a file is wrong; file and line are named.
    """
    rows = _file_rows(settings)
    file = Path(settings.tags or folder / LOCK_FILE)
    points = resolve(rows, tags.find, file, settings.order)
    if not settings.auto:
        return TagMap(rows, points, (), is_locked=True)
    locked = locked_rows(folder)
    given, lock = give_addresses(all_tags(areas), points, locked)
    rows = [*rows, *given]
    points = resolve(rows, tags.find, file, settings.order)
    return TagMap(rows, points, lock, is_locked=len(lock) == len(locked))


def _file_rows(settings: ModbusSettings) -> list[MapRow]:
    if not settings.tags:
        return []
    file = Path(settings.tags)
    try:
        return read_file(file)
    except FileNotFoundError as err:
        raise TagMapError(f"{file}: cannot be read: {err}") from None
