"""A table of a file, such as plc.toml, and how it becomes an object of settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import is_dataclass
from enum import Enum
from pathlib import Path
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    Literal,
    TypeVar,
    Union,
    cast,
    get_args,
    get_origin,
)

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.suggestion import did_you_mean
from plcsim.settings.declaration import beside, declared
from plcsim.settings.kinds import OneOf, SettingKind, of_kind

T = TypeVar("T")


class Table:
    """One table.

    Args:
        file: named in errors; relative paths begin at its folder.
        name: of the table, "" for the whole file.
        values: as read by tomllib.

    Raises:
        ConfigurationError: this is not a table.
    """

    def __init__(self, file: Path, name: str, values: object) -> None:
        self._file = file
        self._name = name
        if not isinstance(values, dict):
            raise self.error("", f"{values!r} is not a table")
        self._values = dict(values)

    @property
    def folder(self) -> Path:
        """The folder of the file."""
        return self._file.parent

    def error(self, key: str, text: str) -> ConfigurationError:
        """Return an error that names file and field, to be raised."""
        return ConfigurationError(f"{self._file}: {self._field(key)}: {text}")

    def _field(self, key: str) -> str:
        return ".".join(part for part in (self._name, key) if part)

    def table(self, key: str) -> Table:
        """Return a table inside this one, empty where there is none."""
        return Table(self._file, self._field(key), self._values.pop(key, {}))

    def values(self) -> dict[str, object]:
        """Return what is in it and nobody has taken, by key."""
        return dict(self._values)

    def only(self, *keys: str) -> Table:
        """Return the part of this table that has these keys."""
        values = {key: self._values.pop(key) for key in keys if key in self._values}
        return Table(self._file, self._name, values)

    def tables(self) -> dict[str, Table]:
        """Return all that is inside as tables, by key.

        Raises:
            ConfigurationError: something is no table.
        """
        findings = Findings()
        result = {}
        for key, value in self._values.items():
            with findings.gathered():
                result[key] = Table(self._file, self._field(key), value)
        findings.check()
        return result

    def check_keys(self, *known: str) -> None:
        """Raise a ConfigurationError for all keys that are not known; near names are offered."""
        findings = Findings()
        for key in self._values:
            if key not in known:
                hint = did_you_mean(key, known) or f"; known are {', '.join(known)}"
                findings.add(self.error(key, f"unknown key{hint}"))
        findings.check()

    def __contains__(self, key: str) -> bool:
        """Return True where ``key`` is there and nobody has taken it."""
        return key in self._values

    def read(self, cls: type[T]) -> T:
        """Return the settings of the table.

        Args:
            cls: a class made by `plcsim.settings.settings`.

        Raises:
            ConfigurationError: keys are unknown or missing, or values are wrong; all of them are
                told.
        """
        known = {setting.key: setting for setting in declared(cls)}
        findings = Findings()
        with findings.gathered():
            self.check_keys(*known)
        values: dict[str, object] = {}
        for key, setting in known.items():
            with findings.gathered():
                if key in self._values:
                    values[setting.attribute] = self._value(key, setting.hint, self._values[key])
                elif setting.required:
                    raise self.error(key, "is missing")
        findings.check()
        return cls(**values)

    def _value(self, key: str, hint: Any, value: object) -> object:
        """Return what a value of the file is in an object whose attribute has this type."""
        try:
            for kind in beside(hint):
                if isinstance(kind, SettingKind):
                    return kind.convert(value, self._file.parent)
            return self._of_type(key, hint, value)
        except ValueError as err:
            raise self.error(key, str(err)) from None

    def _of_type(self, key: str, hint: Any, value: object) -> object:
        origin, arguments = get_origin(hint), get_args(hint)
        if origin is Annotated:
            return self._of_type(key, arguments[0], value)
        if origin in (Union, UnionType):
            (given,) = (each for each in arguments if each is not NoneType)
            return self._value(key, given, value)
        if origin is tuple:
            return tuple(self._value(key, arguments[0], each) for each in of_kind(list, value))
        if origin is Mapping:
            return self._inner(key, value)._free_keys(arguments[1])
        if is_dataclass(hint):
            return self._inner(key, value).read(cast("type[object]", hint))
        return _plain(hint, value, self._file.parent)

    def _inner(self, key: str, values: object) -> Table:
        return Table(self._file, self._field(key), values)

    def _free_keys(self, hint: Any) -> dict[str, object]:
        findings = Findings()
        result: dict[str, object] = {}
        for key, value in self._values.items():
            with findings.gathered():
                result[key] = self._value(key, hint, value)
        findings.check()
        return result


def _plain(hint: Any, value: object, folder: Path) -> object:
    """Return a value of a type that has no parts."""
    if hint is Any:
        return value
    if get_origin(hint) is Literal:
        return OneOf(*get_args(hint)).convert(value, folder)
    if issubclass(hint, Enum):
        return hint(OneOf(*(each.value for each in hint)).convert(value, folder))
    if hint is Path:
        return folder / of_kind(str, value)
    if hint is float and type(value) is int:
        return float(value)
    return of_kind(hint, value)
