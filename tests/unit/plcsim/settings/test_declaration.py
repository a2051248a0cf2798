"""What a class of settings declares."""

import dataclasses
from typing import Annotated

import pytest

from plcsim.settings import Duration, Key, settings
from plcsim.settings.declaration import declared


@settings
class Example:
    needed: str
    idle_ns: Annotated[int, Duration()] = 1
    plain_ns: int = 2
    host_policy: Annotated[str, Key("on_host")] = ""


def test_each_attribute_is_a_key() -> None:
    assert [(s.key, s.attribute, s.required) for s in declared(Example)] == [
        ("needed", "needed", True),
        ("idle", "idle_ns", False),
        ("plain_ns", "plain_ns", False),
        ("on_host", "host_policy", False),
    ]


def test_settings_do_not_change() -> None:
    example = Example(needed="x")
    with pytest.raises(dataclasses.FrozenInstanceError):
        example.needed = "y"  # type: ignore[misc]  # it is the test
