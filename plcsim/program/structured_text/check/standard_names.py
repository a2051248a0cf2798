"""Names of the norm for what Automation Studio's library standard calls otherwise.

IEC 61131-3 calls the inputs of counters and bistables R, LD, S1 and the like, the vendors'
libraries RESET, LOAD, SET1. Files of either kind are taken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from st_types.types.derived import DataBlockType

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from st_types.types.derived import StructType

_MEMBERS: Final[Mapping[str, Mapping[str, str]]] = {
    "CTU": {"R": "RESET"},
    "CTD": {"LD": "LOAD"},
    "CTUD": {"R": "RESET", "LD": "LOAD"},
    "SR": {"S1": "SET1", "R": "RESET"},
    "RS": {"S": "SET", "R1": "RESET1"},
}
_PARAMETERS: Final[Mapping[str, str]] = {
    "STR": "IN",
    "STR1": "IN1",
    "STR2": "IN2",
    "SIZE": "L",
    "LEN": "L",
    "POS": "P",
}
STRING_FUNCTIONS: Final = frozenset(
    ["LEN", "LEFT", "RIGHT", "MID", "CONCAT", "INSERT", "DELETE", "REPLACE", "FIND"]
)
"""Of the library standard; those of WSTRINGs in the library iec have a W before their names."""


def standard_name(data_type: StructType[Any], name: str) -> str | None:
    """Return the member of a block of the library standard that the norm calls ``name``."""
    if not isinstance(data_type, DataBlockType):
        return None
    found = _MEMBERS.get(data_type.name, {}).get(name.upper())
    return None if found is None else data_type.spelling(found)


def standard_parameter(function: str, name: str, parameters: Collection[str]) -> str | None:
    """Return the parameter of a string function that CODESYS calls ``name``."""
    known = function.removeprefix("W") in STRING_FUNCTIONS
    found = _PARAMETERS.get(name.upper()) if known else None
    return found if found in parameters else None
