"""Dialects: what Automation Studio and the standard do differently in declarations."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from st_types.types.derived import StringType, WStringType
from st_types.types.elementary import ALL_ELEMENTARY, ELEMENTARY

if TYPE_CHECKING:
    from collections.abc import Mapping

    from st_types.types.elementary import DataType


@dataclass(frozen=True, eq=False)
class Dialect:
    """The rules of one kind of source files.

    Keywords and the names of elementary types are case-blind in every dialect.

    Attributes:
        name: as it is shown.
        case_sensitive: identifiers that differ in case are two names; one that is declared in
            another case only is found, with a warning.
        string_length: characters of STRING and WSTRING without a length, which IEC 61131-3 leaves
            to the vendor.
    """

    name: str
    case_sensitive: bool
    string_length: int = 80

    def key(self, name: str) -> str:
        """Return what two spellings of one name have in common."""
        return name if self.case_sensitive else name.upper()

    @cached_property
    def simple_types(self) -> Mapping[str, DataType[Any]]:
        """The types that are keywords, in capitals and in small letters."""
        types: dict[str, DataType[Any]] = {
            **(ELEMENTARY if self.case_sensitive else ALL_ELEMENTARY),
            "STRING": StringType(self.string_length),
            "WSTRING": WStringType(self.string_length),
        }
        return {spelling(name): t for name, t in types.items() for spelling in (str, str.lower)}


AUTOMATION_STUDIO = Dialect("Automation Studio", case_sensitive=True)
IEC = Dialect("IEC 61131-3", case_sensitive=False)
