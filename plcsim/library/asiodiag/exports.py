"""Bodies of this library in the C library: that the controller is simulated."""

from __future__ import annotations

from typing import Final

EXPORTS: Final = {
    "DiagCpuIsSimulated": "plc_is_simulated",
    "DiagCpuIsARsim": "plc_is_simulated",
}
