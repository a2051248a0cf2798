"""Bodies of this library in the C library: the ticks of the clock."""

from __future__ import annotations

from typing import Final

EXPORTS: Final = {
    "TIM_ticks": "plc_ticks",
    "TIM_musec": "plc_musec",
}
