"""The functions of the C library that are the bodies of this library's."""

from __future__ import annotations

from typing import Final

_OF_C: Final = ("memset", "memcpy", "memmove", "memcmp", "strlen", "strcmp", "atoi")
_OWN: Final = ("brsstrcpy", "brsstrcat", "brsitoa", "brsftoa", "brsatof", "brsatod")

EXPORTS: Final = {**{f"brs{name}": name for name in _OF_C}, **{name: name for name in _OWN}}
