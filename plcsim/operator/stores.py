"""Values for tags, checked and encoded before the controller starts."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.errors import ConfigurationError, Findings, TagError
from plcsim.core.tag import encode_tag
from st_types.types.values import decode

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag


class GivenValue(NamedTuple):
    """A tag and a value of it.

    Attributes:
        tag: of any type.
        data: the bytes of the value.
        value: as reading the tag gives it.
    """

    tag: Tag
    data: bytes
    value: object


def tag_of(controller: Controller, path: str, field: str) -> Tag:
    """Return a tag.

    Raises:
        ConfigurationError: there is none; the field of plc.toml is named.
    """
    try:
        return controller.tags.find(path)
    except TagError as err:
        raise ConfigurationError(f"plc.toml: {field}: {err}") from None


def tag_values(
    controller: Controller, values: Mapping[str, object], field: str
) -> tuple[GivenValue, ...]:
    """Return tags and their values.

    Raises:
        ConfigurationError: a tag is not there, or cannot take its value; all of them are told.
    """
    findings = Findings()
    found = []
    for path, value in values.items():
        with findings.gathered():
            found.append(_tag_value(tag_of(controller, path, field), value, field))
    findings.check()
    return tuple(found)


def _tag_value(tag: Tag, value: object, field: str) -> GivenValue:
    try:
        data = encode_tag(tag, value)
    except TagError as err:
        raise ConfigurationError(f"plc.toml: {field}: {err}") from None
    return GivenValue(tag, data, decode(tag.data_type, data))
