"""The functions of the C library that are the bodies of this library's: those for float."""

from __future__ import annotations

from typing import Final

NAMES: Final = (
    *("atan2", "ceil", "cosh", "floor", "fmod", "frexp"),
    *("ldexp", "modf", "pow", "sinh", "tanh"),
)

EXPORTS: Final = {name: f"{name}f" for name in NAMES}
