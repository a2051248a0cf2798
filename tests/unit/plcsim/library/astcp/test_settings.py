from __future__ import annotations

from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.library.astcp.settings import AsTcpSettings
from plcsim.settings import Table


def read(**values: object) -> AsTcpSettings:
    return Table(Path("plc.toml"), "library.AsTCP", values).read(AsTcpSettings)


def test_defaults() -> None:
    found = read()
    assert (found.idents, found.connect_timeout_ns, found.closed_while_busy) == (128, 0, 32600)


def test_all_keys() -> None:
    found = read(idents=3, connect_timeout="1.5s", closed_while_busy=32609)
    assert found == AsTcpSettings(
        idents=3, connect_timeout_ns=1_500_000_000, closed_while_busy=32609
    )


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
    with pytest.raises(ConfigurationError, match=rf"^plc\.toml: library\.AsTCP\.{key}: "):
        read(**{key: value})
