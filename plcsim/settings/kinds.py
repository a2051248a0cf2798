"""What stands beside a type in a class of settings: bounds, conversions, another name of the key.

A kind takes a value of the file and gives that of the attribute, or raises ValueError with a text
that follows ``FILE: TABLE.KEY:``.
"""

from __future__ import annotations

import ipaddress
import os
import re
from abc import ABC, abstractmethod
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING, Literal, TypeVar

from plcsim.core.duration import format_duration, parse_duration_ns

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

T = TypeVar("T")

_SIZE = re.compile(r"(\d+)\s*(KiB|MiB|GiB)?")
_UNITS = {None: 1, "KiB": 1 << 10, "MiB": 1 << 20, "GiB": 1 << 30}


@dataclass(frozen=True)
class Key:
    """The key in the file, where it is not the attribute's name."""

    name: str


class SettingKind(ABC):
    """Base of all kinds; a package may have its own."""

    @abstractmethod
    def convert(self, value: object, folder: Path) -> object:
        """Return the value of the attribute.

        Args:
            value: as the file has it.
            folder: of the file.

        Raises:
            ValueError: it is wrong; the text follows ``FILE: TABLE.KEY:``.
        """


@dataclass(frozen=True)
class Whole(SettingKind):
    """A whole number within bounds, both included."""

    minimum: int
    maximum: int

    def convert(self, value: object, _folder: Path) -> int:
        """Return the number."""
        number = of_kind(int, value)
        if not self.minimum <= number <= self.maximum:
            raise ValueError(f"{number} is outside {self.minimum}..{self.maximum}")
        return number


KIND_NAMES: dict[type, str] = {
    str: "a string",
    int: "a whole number",
    bool: "true or false",
    float: "a number",
    dict: "a table",
    list: "a list",
    datetime: "a date and time",
}


def of_kind(kind: type[T], value: object, example: str = "") -> T:
    """Return a value that is of a kind of the file; an example is named where it is not.

    True and False are no numbers.
    """
    if isinstance(value, kind) and not (kind is int and isinstance(value, bool)):
        return value
    such = f" such as {example}" if example else ""
    raise ValueError(f"{value!r} is not {KIND_NAMES[kind]}{such}")


@dataclass(frozen=True)
class Duration(SettingKind):
    """A time such as ``"10ms"``, in nanoseconds; the attribute ``x_ns`` has the key ``x``."""

    minimum_ns: int = 0
    maximum_ns: int | None = None

    def convert(self, value: object, _folder: Path) -> int:
        """Return the nanoseconds."""
        duration_ns = parse_duration_ns(of_kind(str, value, '"10ms"'))
        if duration_ns < self.minimum_ns:
            least = format_duration(self.minimum_ns)
            raise ValueError(
                "must be above 0" if self.minimum_ns == 1 else f"{value!r} is less than {least}"
            )
        if self.maximum_ns is not None and duration_ns > self.maximum_ns:
            raise ValueError(f"{value!r} is more than {format_duration(self.maximum_ns)}")
        return duration_ns


@dataclass(frozen=True)
class Size(SettingKind):
    """A number of bytes such as ``"16MiB"``, within bounds and a multiple of a unit."""

    minimum: int
    maximum: int
    unit: int = 1

    def convert(self, value: object, _folder: Path) -> int:
        """Return the bytes."""
        match = _SIZE.fullmatch(of_kind(str, value, '"16MiB"'))
        if match is None:
            raise ValueError(f'{value!r} is not a size such as "16MiB"')
        size = int(match[1]) * _UNITS[match[2]]
        if size % self.unit or not self.minimum <= size <= self.maximum:
            raise ValueError(
                f"{value!r} must be a multiple of {self.unit} bytes, "
                f"{self.minimum} at least and {self.maximum} at most"
            )
        return size


class OneOf(SettingKind):
    """One of some values, which are compared with their types: True is not 1.

    Args:
        choices: strings or numbers.
    """

    def __init__(self, *choices: object) -> None:
        self.choices = choices

    def convert(self, value: object, _folder: Path) -> object:
        """Return the value."""
        if any(type(value) is type(choice) and value == choice for choice in self.choices):
            return value
        *others, last = (f'"{c}"' if isinstance(c, str) else str(c) for c in self.choices)
        raise ValueError(f"{value!r} is not {', '.join(others)} or {last}")


@dataclass(frozen=True)
class Converted(SettingKind):
    """A string that ``function`` converts; it raises ValueError for one that it cannot."""

    function: Callable[[str], object]
    example: str = ""
    """Of a value, as in the file."""

    def convert(self, value: object, _folder: Path) -> object:
        """Return what the function makes of the string."""
        return self.function(of_kind(str, value, self.example))


@dataclass(frozen=True)
class IpAddress(SettingKind):
    """An address of IPv4 or IPv6, as text; settings go to services as JSON."""

    def convert(self, value: object, _folder: Path) -> str:
        """Return the address as it is commonly written."""
        text = of_kind(str, value)
        try:
            return str(ipaddress.ip_address(text))
        except ValueError:
            raise ValueError(f"{text!r} is not an IP address") from None


def is_loopback(host: str) -> bool:
    """Return whether nobody reaches an address (of `IpAddress`) but from this machine."""
    return ipaddress.ip_address(host).is_loopback


@dataclass(frozen=True)
class PathTo(SettingKind):
    """A path; a relative one begins at the folder of the file that holds the table.

    Attributes:
        what: "file" or "folder" must be there; "" for a path at which nothing need be.
    """

    what: Literal["", "file", "folder"] = ""

    def convert(self, value: object, folder: Path) -> Path:
        """Return the path, joined to the folder."""
        path = folder / of_kind(str, value)
        there = os.path.isfile(path) if self.what == "file" else os.path.isdir(path)  # noqa: PTH112, PTH113  # no error for what can be no path
        if self.what and not there:
            raise ValueError(f"there is no such {self.what}, {str(path)!r}")
        return path
