"""The functions of the C library that are the bodies of this library's."""

from __future__ import annotations

from typing import Final

TYPES: Final = (
    *("BOOL", "BYTE", "WORD", "DWORD", "SINT", "INT", "DINT", "USINT", "UINT", "UDINT"),
    *("TIME", "DT", "DATE", "TOD", "REAL", "LREAL", "STRING", "WSTRING"),
)

_SWAPS: Final = {
    **dict.fromkeys(("DT", "TIME", "DATE", "TOD", "UDINT", "DINT", "DWORD"), "plc_swap32"),
    **dict.fromkeys(("UINT", "WORD"), "plc_swap16"),
    "INT": "plc_swap16s",
    "REAL": "plc_swap_real",
    "LREAL": "plc_swap_lreal",
}

_FORMS: Final = ("swap", "N_TO_H", "H_TO_N")

EXPORTS: Final = {
    **{f"{a}_TO_{b}": f"iec_{a}_to_{b}" for a in TYPES for b in TYPES if a != b},
    **{
        f"{form}{name}": body
        for name, body in _SWAPS.items()
        for form in ("swap", "N_TO_H", "H_TO_N")
    },
}
