"""The functions of the C library that are the bodies of this library's: those of strings."""

from __future__ import annotations

from typing import Final

_NAMES: Final = (
    *("LEN", "LEFT", "RIGHT", "MID", "CONCAT", "INSERT", "DELETE", "REPLACE"),
    "FIND",
)

EXPORTS: Final = {name: f"iec_{name.lower()}" for name in _NAMES}
