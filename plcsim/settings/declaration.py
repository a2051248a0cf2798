"""Classes of settings: what their attributes say about the keys of a table."""

from __future__ import annotations

import dataclasses
from typing import (
    Annotated,
    Any,
    NamedTuple,
    TypeGuard,
    TypeVar,
    dataclass_transform,
    get_args,
    get_origin,
)
from typing import get_type_hints as hints_of

from plcsim.settings.kinds import Duration, Key

T = TypeVar("T")


class Setting(NamedTuple):
    """One key of a table.

    Attributes:
        key: in the file.
        attribute: of the object.
        hint: its type, with what stands beside it.
        required: it has no default.
    """

    key: str
    attribute: str
    hint: Any
    required: bool


@dataclass_transform(
    frozen_default=True, kw_only_default=True, field_specifiers=(dataclasses.field,)
)
def settings(cls: type[T]) -> type[T]:
    """Make a class of settings: a frozen dataclass whose attributes stand for keys of a table."""
    made = dataclasses.dataclass(frozen=True, kw_only=True)(cls)
    made.__plc_settings__ = True  # type: ignore[attr-defined]  # a mark on a class
    return made


def is_settings(value: object) -> TypeGuard[type]:
    """Whether this is a class of settings itself, not only derived from one."""
    return isinstance(value, type) and "__plc_settings__" in vars(value)


def declared(cls: Any) -> tuple[Setting, ...]:
    """Return the keys that a class of settings declares, in order."""
    hints = hints_of(cls, include_extras=True)
    return tuple(_setting(field, hints[field.name]) for field in dataclasses.fields(cls))


def _setting(field: dataclasses.Field[Any], hint: Any) -> Setting:
    missing = dataclasses.MISSING
    required = field.default is missing and field.default_factory is missing
    return Setting(_key(field.name, hint), field.name, hint, required)


def beside(hint: Any) -> tuple[Any, ...]:
    """Return what stands beside a type in ``Annotated``."""
    return get_args(hint)[1:] if get_origin(hint) is Annotated else ()


def _key(attribute: str, hint: Any) -> str:
    named = [each.name for each in beside(hint) if isinstance(each, Key)]
    if named:
        return str(named[0])
    is_duration = any(isinstance(each, Duration) for each in beside(hint))
    return attribute.removesuffix("_ns") if is_duration else attribute
