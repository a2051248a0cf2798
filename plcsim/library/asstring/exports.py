"""The functions of the C library that are the bodies of this library's."""

from __future__ import annotations

from typing import Final

EXPORTS: Final = {
    **{name: name for name in ("memset", "memcpy", "memmove", "memcmp")},
    **{name: name for name in ("strcpy", "strcat", "strcmp", "atoi")},
    "strlen": "plc_strlen",
    "itoa": "brsitoa",
    "ftoa": "brsftoa",
    "atof": "brsatof",
}
