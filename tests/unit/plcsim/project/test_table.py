from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.project.table import Table

FILE = Path("plc.toml")


def table(**values: object) -> Table:
    return Table(FILE, "modbus", values)


def test_keys_are_taken_with_their_kind() -> None:
    given = table(
        port=1502, host="::1", auto=True, allow=["10.0.0.0/8"], idle="60s", tls={"a": "b"}
    )
    assert given.number("port", 502, 0, 65535) == 1502
    assert given.take("host", str, "") == "::1"
    assert given.take("auto", bool, False) is True
    assert given.strings("allow") == ("10.0.0.0/8",)
    assert given.duration_ns("idle", 0) == 60_000_000_000
    inner = given.table("tls")
    assert "a" in inner
    assert inner.take("a", str, "") == "b"
    assert "a" not in inner
    inner.finish()
    given.finish()


def test_what_is_missing_gets_its_default() -> None:
    empty = table()
    assert empty.number("port", 502, 0, 65535) == 502
    assert empty.strings("allow", ("127.0.0.0/8",)) == ("127.0.0.0/8",)
    assert empty.duration_ns("idle", 7) == 7
    empty.table("tls").finish()
    empty.finish()


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"port": "x"}, "plc.toml: modbus.port: 'x' is not a whole number"),
        ({"port": True}, "modbus.port: True is not a whole number"),
        ({"port": 70000}, "modbus.port: 70000 is outside 0..65535"),
    ],
)
def test_a_wrong_number_is_named(values: dict[str, object], text: str) -> None:
    with pytest.raises(ConfigurationError, match=text):
        table(**values).number("port", 502, 0, 65535)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (10, r'modbus\.idle: 10 is not a string such as "10ms"$'),
        ("10", r"modbus\.idle: '10' is not a duration such as \"10ms\""),
    ],
)
def test_a_wrong_time_is_told_what_one_looks_like(value: object, text: str) -> None:
    with pytest.raises(ConfigurationError, match=text):
        table(idle=value).duration_ns("idle", 0)


def test_a_wrong_kind_is_named_in_english() -> None:
    with pytest.raises(ConfigurationError, match=r"modbus\.auto: 10 is not true or false$"):
        table(auto=10).take("auto", bool, default=False)
    with pytest.raises(ConfigurationError, match=r"modbus\.tls: 10 is not a table$"):
        table(tls=10).take("tls", dict, {})


def test_a_list_holds_strings_only() -> None:
    with pytest.raises(ConfigurationError, match=r"modbus\.allow: 7 is not a string"):
        table(allow=["a", 7]).strings("allow")


def test_an_unknown_key_gets_a_suggestion() -> None:
    given = table(prot=502)
    given.number("port", 502, 0, 65535)
    with pytest.raises(ConfigurationError, match=r"modbus\.prot: unknown key; did you mean port\?"):
        given.finish()


def test_an_unknown_key_that_is_near_none_gets_them_all() -> None:
    given = table(x=1)
    given.number("port", 502, 0, 65535)
    with pytest.raises(ConfigurationError, match=r"x: unknown key; known are port$"):
        given.finish()


def test_a_table_inside_is_named_in_full() -> None:
    inner = table(tls={"x": 1}).table("tls")
    with pytest.raises(ConfigurationError, match=r"modbus\.tls\.x: unknown key"):
        inner.finish()


def test_what_is_no_table_is_refused() -> None:
    with pytest.raises(ConfigurationError, match="modbus: a table is expected"):
        Table(FILE, "modbus", 7)
