"""Tables read as settings, and key by key."""

from collections.abc import Mapping
from dataclasses import field
from enum import Enum
from pathlib import Path
from typing import Annotated, Any, Literal

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.settings import Duration, Key, PathTo, Whole, settings
from plcsim.settings.table import Table

FILE = Path("plc.toml")


class Policy(Enum):
    LOG = "log"
    STOP = "stop"


@settings
class Inner:
    certificate: str
    depth: Annotated[int, Whole(1, 9)] = 3


@settings
class Outer:
    name: str = "main"
    on: bool = False
    gain: float = 1.0
    port: Annotated[int, Whole(0, 65535)] = 502
    idle_ns: Annotated[int, Duration(minimum_ns=1)] = 60
    size: Annotated[int, Key("memory"), Whole(1, 4)] = 1
    order: Literal["ABCD", "CDAB"] = "ABCD"
    policy: Policy = Policy.LOG
    units: tuple[Annotated[int, Whole(0, 255)], ...] = ()
    hosts: Mapping[str, str] = field(default_factory=dict)
    points: Mapping[str, Inner] = field(default_factory=dict)
    limit: Annotated[int | None, Whole(1, 9)] = None
    tls: Inner | None = None
    audit: Path = Path()
    folder: Annotated[Path | None, PathTo("folder")] = None
    free: Any = None


def read(**values: object) -> Outer:
    return Table(FILE, "modbus", values).read(Outer)


def test_what_is_missing_gets_the_default_beside_its_declaration() -> None:
    assert read() == Outer()
    assert Outer().idle_ns == 60


def test_every_type_is_read() -> None:
    found = read(
        name="x", on=True, gain=2, port=0, idle="1ms", memory=4, order="CDAB", policy="stop",
        units=[0, 255], hosts={"a": "b"}, points={"p": {"certificate": "c"}}, limit=9,
        tls={"certificate": "d", "depth": 1}, audit="log/a", free=[1, {}],
    )  # fmt: skip
    assert found == Outer(
        name="x", on=True, gain=2.0, port=0, idle_ns=1_000_000, size=4, order="CDAB",
        policy=Policy.STOP, units=(0, 255), hosts={"a": "b"}, points={"p": Inner(certificate="c")},
        limit=9, tls=Inner(certificate="d", depth=1), audit=Path("log/a"), free=[1, {}],
    )  # fmt: skip
    assert type(found.gain) is float


def test_a_relative_path_begins_at_the_folder_of_the_file(tmp_path: Path) -> None:
    (tmp_path / "lib").mkdir()
    given = {"folder": "lib", "audit": "/var/log/a"}
    found = Table(tmp_path / "plc.toml", "", given).read(Outer)
    assert (found.folder, found.audit) == (tmp_path / "lib", Path("/var/log/a"))


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"name": 3}, "name: 3 is not a string"),
        ({"on": 1}, "on: 1 is not true or false"),
        ({"gain": "1"}, "gain: '1' is not a number"),
        ({"gain": True}, "gain: True is not a number"),
        ({"port": True}, "port: True is not a whole number"),
        ({"port": 1.0}, "port: 1.0 is not a whole number"),
        ({"port": -1}, "port: -1 is outside 0..65535"),
        ({"idle": "0s"}, "idle: must be above 0"),
        ({"idle": 5}, 'idle: 5 is not a string such as "10ms"'),
        ({"idle_ns": 5}, "idle_ns: unknown key; did you mean idle?"),
        ({"Port": 5}, "Port: unknown key; did you mean port?"),
        ({"order": "BADC"}, 'order: \'BADC\' is not "ABCD" or "CDAB"'),
        ({"policy": "LOG"}, 'policy: \'LOG\' is not "log" or "stop"'),
        ({"units": 3}, "units: 3 is not a list"),
        ({"units": [1, 256]}, "units: 256 is outside 0..255"),
        ({"hosts": 3}, "hosts: 3 is not a table"),
        ({"hosts": {"a": 3}}, "hosts.a: 3 is not a string"),
        ({"limit": 0}, "limit: 0 is outside 1..9"),
        ({"tls": 3}, "tls: 3 is not a table"),
        ({"tls": {}}, "tls.certificate: is missing"),
        ({"tls": {"certificate": "x", "dept": 1}}, "tls.dept: unknown key; did you mean depth?"),
        ({"points": {"p": {}}}, "points.p.certificate: is missing"),
        ({"folder": "nowhere"}, "folder: there is no such folder, 'nowhere'"),
        ({"folder": "\0"}, "folder: there is no such folder, '\\x00'"),
    ],
)
def test_what_is_wrong_is_named_with_file_and_key(values: dict[str, object], text: str) -> None:
    with pytest.raises(ConfigurationError) as raised:
        read(**values)
    assert str(raised.value) == f"plc.toml: modbus.{text}"


def test_everything_wrong_is_told_in_one_go() -> None:
    with pytest.raises(ConfigurationError) as raised:
        read(prot=1, on=1, tls={"depth": 0}, hosts={"a": 1, "b": 2})
    assert raised.value.findings == (
        "plc.toml: modbus.prot: unknown key; did you mean port?",
        "plc.toml: modbus.on: 1 is not true or false",
        "plc.toml: modbus.hosts.a: 1 is not a string",
        "plc.toml: modbus.hosts.b: 2 is not a string",
        "plc.toml: modbus.tls.certificate: is missing",
        "plc.toml: modbus.tls.depth: 0 is outside 1..9",
    )


def test_the_tables_inside_a_table() -> None:
    outer = Table(FILE, "library", {"a": {"x": 1}, "b": {}})
    assert list(outer.tables()) == ["a", "b"]
    assert str(outer.tables()["a"].error("x", "is wrong")) == "plc.toml: library.a.x: is wrong"
    with pytest.raises(ConfigurationError, match=r"library\.c: 3 is not a table"):
        Table(FILE, "library", {"a": {}, "c": 3}).tables()


def test_what_is_no_table_is_refused() -> None:
    with pytest.raises(ConfigurationError, match="modbus: 7 is not a table"):
        Table(FILE, "modbus", 7)
