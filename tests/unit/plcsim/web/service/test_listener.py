import socket

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.web.service.listener import bound_socket, tls_context
from plcsim.web.settings import WebSettings, WebTlsSettings


def test_an_address_that_cannot_be_had_is_told():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(ConfigurationError, match=f"127.0.0.1 port {port}: Address already in"):
            bound_socket(WebSettings(port=port))
    with pytest.raises(ConfigurationError, match="Cannot assign"):
        bound_socket(WebSettings(host="192.0.2.1", port=0))


def test_any_free_port():
    with bound_socket(WebSettings(host="::1", port=0)) as bound:
        assert bound.getsockname()[1] > 0


def test_files_that_hold_no_certificate_are_told(tmp_path):
    for name in ("cert.pem", "key.pem"):
        (tmp_path / name).write_text("nothing")
    with pytest.raises(ConfigurationError, match=r"web\.tls: certificate .*cert\.pem"):
        tls_context(
            WebTlsSettings(certificate=str(tmp_path / "cert.pem"), key=str(tmp_path / "key.pem"))
        )
