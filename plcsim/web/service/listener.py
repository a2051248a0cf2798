"""Where the pages are served: the bound socket, TLS, and whether anybody could log in."""

from __future__ import annotations

import socket
import ssl
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from plcsim.settings import is_loopback

if TYPE_CHECKING:
    from plcsim.access import Users
    from plcsim.web.settings import WebSettings, WebTlsSettings


def check_users(settings: WebSettings, users: Users) -> None:
    """Check that pages that other machines reach are for users only.

    Raises:
        ConfigurationError: nobody could log in.
    """
    if not (is_loopback(settings.host) or users):
        raise ConfigurationError(
            f"web.host: {settings.host} is reached from other machines, and there are no users; "
            "plcsim users add NAME --role engineer"
        )


def tls_context(settings: WebTlsSettings) -> ssl.SSLContext:
    """Return the context of the server.

    Raises:
        ConfigurationError: a file holds no certificate or key.
    """
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    try:
        # without a password OpenSSL would ask for one on the terminal, and wait
        context.load_cert_chain(settings.certificate, settings.key, _no_password)
    except (OSError, ssl.SSLError) as err:
        files = f"certificate {settings.certificate}, key {settings.key}"
        reason = (err.reason or "not PEM") if isinstance(err, ssl.SSLError) else err.strerror
        raise ConfigurationError(
            f"web.tls: {files}: {str(reason).replace('_', ' ').lower()}"
        ) from None
    return context


def _no_password() -> str:
    raise ConfigurationError("web.tls.key: has a password; take it off (openssl pkey -in ...)")


def bound_socket(settings: WebSettings) -> socket.socket:
    """Return a socket at the address of the pages.

    Raises:
        ConfigurationError: the address is in use, or is none of this host.
    """
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listening = socket.socket(family, socket.SOCK_STREAM)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((settings.host, settings.port))
    except OSError as err:
        listening.close()
        raise ConfigurationError(
            f"web.port: {settings.host} port {settings.port}: {err.strerror}"
        ) from None
    return listening
