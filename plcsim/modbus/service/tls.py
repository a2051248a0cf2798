"""Modbus/TCP Security: TLS on both sides, and the role in the client's certificate.

Source: MODBUS/TCP Security Protocol Specification, MB-TCP-Security-v36: TLS 1.2 or later, client
certificates required, the role as a UTF8String in the extension 1.3.6.1.4.1.50316.802.1.
"""

from __future__ import annotations

import ssl
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError
from plcsim.modbus.service.handler import AccessRights

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.modbus.settings import TlsSettings

ROLE_OID: Final = "1.3.6.1.4.1.50316.802.1"
_UTF8_STRING: Final = 0x0C

RIGHTS: Final[Mapping[str, AccessRights]] = {
    "rw": AccessRights(),
    "ro": AccessRights(may_write=False),
    "none": AccessRights(may_read=False, may_write=False),
}


def server_context(settings: TlsSettings) -> ssl.SSLContext:
    """Return the context of a server that asks every client for a certificate.

    Raises:
        ConfigurationError: a file holds no certificate or key, or `cryptography` is not installed.
    """
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    context.verify_mode = ssl.CERT_REQUIRED
    try:
        # without a password OpenSSL would ask for one on the terminal, and wait
        context.load_cert_chain(settings.certificate, settings.key, _no_password)
    except (OSError, ssl.SSLError) as err:
        files = f"certificate {settings.certificate}, key {settings.key}"
        raise ConfigurationError(f"modbus.tls: {files}: {_reason(err)}") from None
    try:
        context.load_verify_locations(settings.clients)
    except (OSError, ssl.SSLError) as err:
        raise ConfigurationError(
            f"modbus.tls.clients: {settings.clients}: {_reason(err)}"
        ) from None
    if settings.roles:
        _require_cryptography()
    return context


def _no_password() -> str:
    raise ConfigurationError("modbus.tls.key: has a password; take it off (openssl pkey -in ...)")


def _reason(err: OSError) -> str:
    """Return what is wrong in words; OpenSSL has none for a file without anything in PEM."""
    if isinstance(err, ssl.SSLError):
        return (err.reason or "not PEM").replace("_", " ").lower()
    return err.strerror or str(err)


def _require_cryptography() -> None:
    try:
        import cryptography.x509  # noqa: F401, PLC0415  # an optional dependency
    except ImportError:
        raise ConfigurationError(
            "modbus.tls.roles: needs the package cryptography; pip install plcsim[tls]"
        ) from None


def role_of(certificate: bytes | None) -> str:
    """Return the role in a certificate, "" where it has none.

    Args:
        certificate: DER, as checked by TLS.
    """
    if not certificate:
        return ""
    from cryptography import x509  # noqa: PLC0415  # an optional dependency

    try:
        extensions = list(x509.load_der_x509_certificate(certificate).extensions)
    except ValueError:  # TLS takes what the stricter reader does not: a role of none
        return ""
    for extension in extensions:
        if extension.oid.dotted_string == ROLE_OID:
            return _utf8(getattr(extension.value, "value", b""))
    return ""


def _utf8(der: bytes) -> str:
    """Return the text of a DER UTF8String of less than 128 bytes, "" for anything else."""
    if len(der) < 2 or der[0] != _UTF8_STRING or der[1] != len(der) - 2 or der[1] > 127:
        return ""
    return der[2:].decode("utf-8", "replace")


def rights_of(role: str, roles: Mapping[str, str]) -> AccessRights:
    """Return what a role may do: everything where no roles are configured, nothing if unknown."""
    if not roles:
        return RIGHTS["rw"]
    return RIGHTS[roles.get(role, "none")]
