from __future__ import annotations

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.library.astcp.settings import Settings


def test_defaults() -> None:
    assert Settings.read({}) == Settings(128, 0, 32600)


def test_all_keys() -> None:
    options = {"idents": 3, "connect_timeout": "1.5s", "closed_while_busy": 32609}
    assert Settings.read(options) == Settings(3, 1_500_000_000, 32609)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("idents", 0),
        ("idents", 65_536),
        ("idents", "128"),
        ("idents", True),
        ("connect_timeout", "soon"),
        ("connect_timeout", 5),
        ("connect_timeout", "61min"),
        ("closed_while_busy", 0),
        ("closed_while_busy", "32600"),
        ("closed_while_busy", True),
        ("ident", 5),
    ],
)
def test_wrong_values_name_the_field(key: str, value: object) -> None:
    with pytest.raises(ConfigurationError, match=rf"^library\.AsTCP\.{key}: "):
        Settings.read({key: value})
