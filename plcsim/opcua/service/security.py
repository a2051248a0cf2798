"""The server's certificate, and which security policies are offered."""

from __future__ import annotations

import platform
from typing import TYPE_CHECKING, Final

from asyncua import ua
from asyncua.crypto.cert_gen import setup_self_signed_certificate
from cryptography.x509.oid import ExtendedKeyUsageOID

if TYPE_CHECKING:
    from pathlib import Path

    from asyncua import Server

_TYPE: Final = ua.SecurityPolicyType
_ENCRYPT: Final = [
    _TYPE.Aes256Sha256RsaPss_SignAndEncrypt,
    _TYPE.Aes128Sha256RsaOaep_SignAndEncrypt,
    _TYPE.Basic256Sha256_SignAndEncrypt,
]
_SIGN: Final = [
    _TYPE.Aes256Sha256RsaPss_Sign,
    _TYPE.Aes128Sha256RsaOaep_Sign,
    _TYPE.Basic256Sha256_Sign,
]


def policies(least: str) -> list[ua.SecurityPolicyType]:
    """Return the policies that are offered.

    Args:
        least: "none", "sign" or "encrypt", what a client must use.
    """
    offered = list(_ENCRYPT)
    if least != "encrypt":
        offered += _SIGN
    if least == "none":
        offered.append(_TYPE.NoSecurity)
    return offered


async def set_certificate(server: Server, folder: Path) -> None:
    """Give the server its certificate and key; they are made where there are none.

    The key is readable for its owner only.
    """
    folder.mkdir(parents=True, exist_ok=True)
    folder.chmod(0o700)
    key, certificate = folder / "key.pem", folder / "certificate.der"
    await setup_self_signed_certificate(
        key,
        certificate,
        server.get_application_uri(),
        platform.node(),
        [ExtendedKeyUsageOID.SERVER_AUTH, ExtendedKeyUsageOID.CLIENT_AUTH],
        {"commonName": server.name[:64], "organizationName": "plcsim"},
    )
    key.chmod(0o600)
    await server.load_certificate(certificate)
    await server.load_private_key(key)
