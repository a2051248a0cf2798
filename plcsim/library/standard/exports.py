"""The functions of the C library that are the bodies of this library's: blocks and strings."""

from __future__ import annotations

from typing import Final

_NAMES: Final = (
    *("TON", "TOF", "TP", "TON_10ms", "TOF_10ms", "TP_10ms"),
    *("CTU", "CTD", "CTUD"),
    *("R_TRIG", "F_TRIG", "RF_TRIG"),
    *("SR", "RS", "SEMA"),
    *("LEN", "LEFT", "RIGHT", "MID", "CONCAT", "INSERT", "DELETE", "REPLACE"),
    "FIND",
)

EXPORTS: Final = {name: f"iec_{name.lower()}" for name in _NAMES}
