"""Bodies of this library in the C library: the start of the cycle."""

from __future__ import annotations

from typing import Final

EXPORTS: Final = {
    "AsIOTimeCyclicStart": "plc_cyclic_start",
}
