"""The table [opcua]."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.opcua.settings import OpcuaSettings, read_settings, settings_from
from plcsim.settings.table import Table


def settings(folder, **values):
    return read_settings(Table(folder / "plc.toml", "opcua", values)).settings


def test_an_empty_table_serves_everything_on_loopback(tmp_path):
    found = settings(tmp_path)

    assert found == OpcuaSettings()
    assert (found.host, found.port, found.tags) == ("127.0.0.1", 4840, ())


def test_settings_travel_as_json(tmp_path):
    found = settings(tmp_path, host="::1", tags=["main.*"], sampling="10ms")

    assert settings_from(found.to_json()) == found
    assert found.endpoint == "opc.tcp://[::1]:4840"


@pytest.mark.parametrize(
    ("values", "complaint"),
    [
        ({"host": "nowhere"}, "opcua.host: 'nowhere' is not an IP address"),
        ({"port": 70000}, "opcua.port"),
        ({"security": "tls"}, "opcua.security"),
        ({"trusted": "clients"}, "opcua.trusted: there is no folder"),
        ({"sampling": "10us"}, "opcua.sampling"),
        ({"prot": 4840}, "prot"),
    ],
)
def test_a_wrong_value_names_its_field(tmp_path, values, complaint):
    with pytest.raises(ConfigurationError, match=complaint):
        settings(tmp_path, **values)
