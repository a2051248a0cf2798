"""A table of plc.toml whose keys are taken one by one; what is left over is an error."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from plcsim.core.duration import parse_duration_ns
from plcsim.core.errors import ConfigurationError
from plcsim.core.suggestion import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

T = TypeVar("T")

_KIND_NAMES: dict[type, str] = {
    str: "a string",
    int: "a whole number",
    bool: "true or false",
    dict: "a table",
    list: "a list",
}


class Table:
    """One table.

    Args:
        file: named in errors.
        name: of the table, "" for the whole file.
        values: as read by tomllib.

    Raises:
        ConfigurationError: this is not a table.
    """

    def __init__(self, file: Path, name: str, values: object) -> None:
        self._file = file
        self._name = name
        if not isinstance(values, dict):
            raise self.error("", "a table is expected")
        self._values = dict(values)
        self._known: list[str] = []

    def error(self, key: str, text: str) -> ConfigurationError:
        """Return an error that names file and field, to be raised."""
        place = ".".join(part for part in (self._name, key) if part)
        return ConfigurationError(f"{self._file}: {place}: {text}")

    def take(self, key: str, kind: type[T], default: T, example: str = "") -> T:
        """Return the value of ``key``, or the default where there is none.

        Args:
            key: in this table.
            kind: of the value.
            default: where there is none.
            example: of a value, as in plc.toml; named where the value is of another kind.

        Raises:
            ConfigurationError: the value is of another kind.
        """
        self._known.append(key)
        value = self._values.pop(key, default)
        if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
            such = f" such as {example}" if example else ""
            raise self.error(key, f"{value!r} is not {_KIND_NAMES[kind]}{such}")
        return value

    def number(self, key: str, default: int, minimum: int, maximum: int) -> int:
        """Return a whole number within bounds.

        Raises:
            ConfigurationError: it is not, or it is outside.
        """
        value = self.take(key, int, default)
        if not minimum <= value <= maximum:
            raise self.error(key, f"{value} is outside {minimum}..{maximum}")
        return value

    def convert(self, key: str, default: T, convert: Callable[[str], T], example: str = "") -> T:
        """Return a string converted, or the default where there is none; for the rest see `take`.

        Raises:
            ConfigurationError: ``convert`` raised ValueError.
        """
        given = key in self._values
        text = self.take(key, str, "", example)
        try:
            return convert(text) if given else default
        except ValueError as err:
            raise self.error(key, str(err)) from None

    def duration_ns(self, key: str, default_ns: int) -> int:
        """Return a time such as ``"10ms"`` in nanoseconds."""
        return self.convert(key, default_ns, parse_duration_ns, '"10ms"')

    def strings(self, key: str, default: tuple[str, ...] = ()) -> tuple[str, ...]:
        """Return a list of strings.

        Raises:
            ConfigurationError: it is not one.
        """
        values = self.take(key, list, list(default))
        for value in values:
            if not isinstance(value, str):
                raise self.error(key, f"{value!r} is not a string")
        return tuple(values)

    def table(self, key: str) -> Table:
        """Return a table inside this one, empty where there is none."""
        name = ".".join(part for part in (self._name, key) if part)
        return Table(self._file, name, self.take(key, dict, {}))

    def __contains__(self, key: str) -> bool:
        """Return True where ``key`` is there and nobody has taken it."""
        return key in self._values

    def finish(self, *more: str) -> None:
        """Raise a ConfigurationError for the first key that nobody took.

        Args:
            more: keys that could have been there.
        """
        known = [*self._known, *(key for key in more if key not in self._known)]
        for key in self._values:
            hint = did_you_mean(key, known) or f"; known are {', '.join(known)}"
            raise self.error(key, f"unknown key{hint}")
