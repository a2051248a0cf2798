"""The functions of the C library that are the bodies of this library's: those for float."""

from __future__ import annotations

from typing import Final

from plcsim.library.asmath.exports import NAMES

EXPORTS: Final = {f"brm{name}": f"{name}f" for name in NAMES}
