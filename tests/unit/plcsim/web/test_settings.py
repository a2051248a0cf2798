import json

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.settings import Table
from plcsim.web.settings import WebSettings, read_settings, settings_from


def read(folder, **values):
    return read_settings(Table(folder / "plc.toml", "web", values)).settings


def test_defaults_are_for_this_machine(tmp_path):
    made = read(tmp_path)
    assert made == WebSettings()
    assert made.url == "http://127.0.0.1:8080"


def test_settings_go_to_the_service_as_json(tmp_path):
    for name in ("cert.pem", "key.pem"):
        (tmp_path / name).write_text("")
    made = read(
        tmp_path,
        host="::",
        port=8443,
        names=["press.local"],
        connections=5,
        tls={"certificate": "cert.pem", "key": "key.pem"},
    )
    assert settings_from(json.loads(json.dumps(made.to_json()))) == made
    assert made.url == "https://[::]:8443"


@pytest.mark.parametrize(
    ("values", "why"),
    [
        ({"port": 70000}, "web.port"),
        ({"host": "localhost"}, "web.host: 'localhost' is not an IP address"),
        ({"hots": "::1"}, "did you mean host"),
        ({"tls": {"certificate": "cert.pem"}}, "web.tls.key: is missing"),
        ({"tls": {"certificate": "cert.pem", "key": "no.pem"}}, "web.tls"),
    ],
)
def test_what_is_wrong_is_told_by_field(tmp_path, values, why):
    with pytest.raises(ConfigurationError, match=why):
        read(tmp_path, **values)
