import json
from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.modbus.settings import ModbusSettings, read_settings, settings_from
from plcsim.settings.table import Table


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("tags.csv", "server.pem", "ca.pem"):
        (tmp_path / name).touch()
    return tmp_path


def settings(folder: Path, **values: object) -> ModbusSettings:
    return read_settings(Table(folder / "plc.toml", "modbus", values))


def test_defaults_listen_on_this_host_only(folder: Path) -> None:
    made = settings(folder)
    assert (made.host, made.port, made.read_only, made.tls) == ("127.0.0.1", 502, False, None)
    assert made.tags == str(folder / "tags.csv")
    assert made.audit == str(folder / ".plcsim" / "modbus-audit.jsonl")
    assert settings(folder, audit="").audit == ""


TLS = {
    "certificate": "server.pem",
    "key": "server.pem",
    "clients": "ca.pem",
    "roles": {"operator": "rw", "guest": "ro"},
}


def test_settings_survive_json(folder: Path) -> None:
    made = settings(
        folder, host="::1", auto=True, order="CDAB", unit_ids=[1, 255], allow=["10.0.0.0/8"],
        idle="5s", write_timeout="100ms", tls=TLS, strict_holes=True, connections=3,
    )  # fmt: skip
    assert made.port == 802
    assert settings_from(json.loads(json.dumps(made.to_json()))) == made


@pytest.mark.parametrize(
    ("values", "error"),
    [
        ({"prot": 502}, r"plc.toml: modbus.prot: unknown key; did you mean port\?"),
        ({"automatic": True}, r"modbus.automatic: unknown key; did you mean auto\?"),
        ({"port": 65536}, "modbus.port: 65536 is outside 0..65535"),
        ({"host": "localhost"}, "modbus.host: 'localhost' is not an IP address"),
        ({"order": "abcd"}, "modbus.order: 'abcd' is not \"ABCD\""),
        ({"tags": "none.csv"}, "modbus.tags: there is no file .*none.csv"),
        ({"unit_ids": [256]}, r"modbus.unit_ids: 256 is outside 0\.\.255"),
        ({"unit_ids": [True]}, "modbus.unit_ids: True is not a whole number"),
        ({"allow": ["10.0.0.1/8"]}, "modbus.allow: 10.0.0.1/8 has host bits set"),
        ({"connections": 0}, "modbus.connections: 0 is outside"),
        ({"idle": "0s"}, "modbus.idle: must be above 0"),
        ({"write_timeout": "soon"}, "modbus.write_timeout: "),
        ({"tls": {}}, "modbus.tls.certificate: is missing"),
        ({"tls": TLS | {"key": "x"}}, "modbus.tls.key: there is no such file, .*x"),
        ({"tls": TLS | {"roles": {"a": "x"}}}, "modbus.tls.roles.a: 'x' is not \"rw\""),
        ({"tls": TLS | {"cert": "x"}}, "modbus.tls.cert: unknown key"),
    ],
)
def test_what_is_wrong_is_named(folder: Path, values: dict[str, object], error: str) -> None:
    with pytest.raises(ConfigurationError, match=error):
        settings(folder, **values)


def test_without_a_file_there_must_be_automatic_addresses(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="auto = true"):
        settings(tmp_path)
    assert settings(tmp_path, auto=True).tags == ""


def test_a_key_that_is_not_there_is_told_before_the_file_that_it_would_make_needless(
    tmp_path: Path,
) -> None:
    with pytest.raises(ConfigurationError) as caught:
        settings(tmp_path, automatic=True)
    assert str(caught.value) == (
        f"{tmp_path / 'plc.toml'}: modbus.automatic: unknown key; did you mean auto?"
    )
