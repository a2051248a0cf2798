"""The functions of the C library that are the bodies of this library's."""

from __future__ import annotations

from typing import Final

_NAMES: Final = ("conv", "ncpy", "ncat", "cat", "cmp", "len", "set", "ncmp", "cpy", "rchr", "chr")

EXPORTS: Final = {f"brwcs{name}": f"brwcs{name}" for name in _NAMES}
