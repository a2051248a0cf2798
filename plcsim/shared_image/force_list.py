"""The list of forced tags as services see it: text that the scan writes anew when it changes."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, NamedTuple

from plcsim.shared_image.errors import ImageError
from plcsim.shared_image.layout import FORCE_CELLS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from plcsim.core.forces import Force

ATTEMPTS = 1000
"""To copy the list; a copy fails only where the scan has changed it meanwhile."""


class ForcedTag(NamedTuple):
    """A forced tag.

    Attributes:
        path: as it was named when it was forced.
        address: PLC address.
        data: its bytes while it is forced.
        source: who forced it.
    """

    path: str
    address: int
    data: bytes
    source: str


def encode_forces(forces: Iterable[Force]) -> bytes:
    """Return the list as text."""
    rows = [[f.tag.path, f.tag.address, f.data.hex(), f.source] for f in forces]
    return json.dumps(rows, separators=(",", ":")).encode()


def write_forces(cells: memoryview[int], region: memoryview[int], text: bytes) -> None:
    """Write the next version of the list, which must not be longer than its region."""
    number = cells[FORCE_CELLS.begin] + 1
    cells[FORCE_CELLS.begin] = number
    region[: len(text)] = text
    cells[FORCE_CELLS.size] = len(text)
    cells[FORCE_CELLS.end] = number


def read_forces(cells: memoryview[int], region: memoryview[int]) -> list[ForcedTag]:
    """Return the present list, in the order in which the tags were forced.

    Raises:
        ImageError: the scan process has died while it wrote the list.
    """
    for _ in range(ATTEMPTS):
        number = cells[FORCE_CELLS.end]
        text = bytes(region[: cells[FORCE_CELLS.size]])
        if cells[FORCE_CELLS.begin] == number:
            rows = json.loads(text or b"[]")
            return [ForcedTag(path, at, bytes.fromhex(data), by) for path, at, data, by in rows]
    raise ImageError("the list of forced tags is not complete")
