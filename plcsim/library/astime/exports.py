"""Bodies of this library in the C library: what reads the clock and compares."""

from __future__ import annotations

from typing import Final

EXPORTS: Final = {
    "clock_ms": "plc_clock_ms",
    "DTGetTime": "plc_dt_get_time",
    "DiffT": "plc_diff_t",
    "DiffDT": "plc_diff_dt",
}
