"""The names of bags: their endings, and how they are called while they are written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

SUFFIXES: Final = (".bag", ".mcap", ".db3")

ACTIVE: Final = ".active"


def active(path: Path) -> Path:
    """Return the name of a bag while it is being written."""
    return path.with_name(path.name + ACTIVE)
