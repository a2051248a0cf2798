import asyncio
import ssl
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.modbus.service import listener, tls
from plcsim.modbus.service.server import Server
from plcsim.modbus.service.tls import ROLE_OID, rights_of, role_of, server_context
from plcsim.modbus.settings import ModbusSettings, TlsSettings

from ..site import World, frame, frames

x509 = pytest.importorskip("cryptography.x509")
hashes = pytest.importorskip("cryptography.hazmat.primitives.hashes")
serialization = pytest.importorskip("cryptography.hazmat.primitives.serialization")
ec = pytest.importorskip("cryptography.hazmat.primitives.asymmetric.ec")

ROLES = {"operator": "rw", "viewer": "ro"}


class Authority:
    """Issues certificates into files of a folder."""

    def __init__(self, folder: Path, name: str = "authority") -> None:
        self._folder = folder
        self._key = ec.generate_private_key(ec.SECP256R1())
        self._name = x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, name)])
        self.file = folder / f"{name}.pem"
        self.file.write_bytes(self._sign(self._name, self._key.public_key(), True, None))

    def _sign(self, name: object, key: object, authority: bool, role: bytes | None) -> bytes:
        now = datetime.now(UTC)
        builder = (
            x509.CertificateBuilder()
            .subject_name(name)
            .issuer_name(self._name)
            .public_key(key)
            .serial_number(x509.random_serial_number())
            .not_valid_before(now - timedelta(days=1))
            .not_valid_after(now + timedelta(days=1))
            .add_extension(x509.BasicConstraints(authority, None), critical=True)
            # Python 3.13 checks as RFC 5280 asks, which wants key identifiers and usages
            .add_extension(x509.SubjectKeyIdentifier.from_public_key(key), False)
            .add_extension(
                x509.AuthorityKeyIdentifier.from_issuer_public_key(self._key.public_key()), False
            )
            .add_extension(usage(authority), critical=True)
        )
        if role is not None:
            oid = x509.ObjectIdentifier(ROLE_OID)
            builder = builder.add_extension(x509.UnrecognizedExtension(oid, role), False)
        signed = builder.sign(self._key, hashes.SHA256())
        return bytes(signed.public_bytes(serialization.Encoding.PEM))

    def issue(self, name: str, role: bytes | None = None) -> Path:
        key = ec.generate_private_key(ec.SECP256R1())
        subject = x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, name)])
        file = self._folder / f"{name}.pem"
        private = key.private_bytes(
            serialization.Encoding.PEM,
            serialization.PrivateFormat.PKCS8,
            serialization.NoEncryption(),
        )
        file.write_bytes(private + self._sign(subject, key.public_key(), False, role))
        return file


def usage(authority: bool) -> object:
    return x509.KeyUsage(
        digital_signature=True,
        key_cert_sign=authority,
        crl_sign=authority,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        encipher_only=False,
        decipher_only=False,
    )


def utf8(text: str) -> bytes:
    return bytes([0x0C, len(text)]) + text.encode()


@pytest.fixture
def authority(tmp_path: Path) -> Authority:
    return Authority(tmp_path)


def settings_of(authority: Authority, roles: dict[str, str]) -> TlsSettings:
    server = str(authority.issue("server"))
    return TlsSettings(certificate=server, key=server, clients=str(authority.file), roles=roles)


def client_context(authority: Authority, own: Path | None) -> ssl.SSLContext:
    context = ssl.create_default_context(cafile=str(authority.file))
    context.check_hostname = False
    if own is not None:
        context.load_cert_chain(own)
    return context


def answers(settings: TlsSettings, context: ssl.SSLContext, *pdus: str) -> list[str]:
    """Return the answers of a TLS server, [] where it refuses the client."""
    world = World()

    async def run() -> list[str]:
        modbus = ModbusSettings(port=0, tls=settings)
        server = Server(world.device, modbus)
        await server.start()
        try:
            reader, writer = await asyncio.open_connection("127.0.0.1", server.port, ssl=context)
            found = []
            for pdu in pdus:
                writer.write(frame(bytes.fromhex(pdu)))
                header = await asyncio.wait_for(reader.readexactly(7), 100)
                body = await reader.readexactly(int.from_bytes(header[4:6], "big") - 1)
                found.append(frames(header + body)[0][2].hex())
            writer.close()
        except (ssl.SSLError, ConnectionError, asyncio.IncompleteReadError):
            return []
        else:
            return found
        finally:
            await server.stop()

    return asyncio.run(run())


READ, WRITE = "03 0000 0001", "06 0004 0065"  # the write is out of range, so it needs no scan


@pytest.mark.parametrize(
    ("role", "expected"),
    [
        (utf8("operator"), ["03020000", "8603"]),
        (utf8("viewer"), ["03020000", "8601"]),
        (utf8("stranger"), ["8301", "8601"]),
        (None, ["8301", "8601"]),
        (b"\x0c\x7foperator", ["8301", "8601"]),
        (b"\x16\x08operator", ["8301", "8601"]),
    ],
)
def test_the_role_in_the_certificate_says_what_its_owner_may_do(
    authority: Authority, role: bytes | None, expected: list[str]
) -> None:
    context = client_context(authority, authority.issue("client", role))
    assert answers(settings_of(authority, ROLES), context, READ, WRITE) == expected


def test_without_roles_every_known_client_may_do_everything(authority: Authority) -> None:
    context = client_context(authority, authority.issue("client"))
    assert answers(settings_of(authority, {}), context, READ, WRITE) == ["03020000", "8603"]


def test_a_client_without_a_certificate_is_refused(authority: Authority) -> None:
    assert answers(settings_of(authority, {}), client_context(authority, None), READ) == []


def test_a_client_of_another_authority_is_refused(authority: Authority, tmp_path: Path) -> None:
    other = Authority(tmp_path, "other")
    context = client_context(authority, other.issue("client"))
    assert answers(settings_of(authority, {}), context, READ) == []


def test_tls_below_1_2_is_not_spoken(authority: Authority) -> None:
    context = server_context(settings_of(authority, {}))
    assert context.minimum_version == ssl.TLSVersion.TLSv1_2
    assert context.verify_mode == ssl.CERT_REQUIRED


def test_a_file_without_a_certificate_is_a_configuration_error(tmp_path: Path) -> None:
    file = tmp_path / "empty.pem"
    file.touch()
    with pytest.raises(ConfigurationError, match=r"modbus\.tls: "):
        server_context(TlsSettings(certificate=str(file), key=str(file), clients=str(file)))


def test_no_certificate_has_no_role_and_unknown_roles_no_rights() -> None:
    assert role_of(None) == ""
    assert rights_of("", {}) == tls.RIGHTS["rw"]
    assert rights_of("", ROLES) == tls.RIGHTS["none"]


def test_a_handshake_that_never_ends_takes_a_place_for_a_while_only(
    authority: Authority, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(listener, "HANDSHAKE_S", 2)
    world, own = World(), authority.issue("client")
    modbus = ModbusSettings(port=0, tls=settings_of(authority, {}), connections=3)

    async def run() -> None:
        server = Server(world.device, modbus)
        await server.start()
        silent = [await asyncio.open_connection("127.0.0.1", server.port) for _ in range(3)]
        with pytest.raises((ssl.SSLError, ConnectionError)):  # the places are taken
            await asyncio.open_connection(
                "127.0.0.1", server.port, ssl=client_context(authority, own)
            )
        assert server.refused == 1
        for reader, writer in silent:
            assert await asyncio.wait_for(reader.read(), 100) == b""
            writer.close()
        reader, writer = await asyncio.open_connection(
            "127.0.0.1", server.port, ssl=client_context(authority, own)
        )
        writer.write(frame(bytes.fromhex("0800000001")))
        assert (await asyncio.wait_for(reader.readexactly(9), 100))[7] == 8
        writer.close()
        await server.stop()

    asyncio.run(run())


def test_a_peer_outside_the_allowed_networks_gets_no_handshake(authority: Authority) -> None:
    world = World()
    modbus = ModbusSettings(port=0, tls=settings_of(authority, {}), allow=("10.0.0.0/8",))

    async def run() -> None:
        server = Server(world.device, modbus)
        await server.start()
        reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
        assert await asyncio.wait_for(reader.read(), 100) == b""
        writer.close()
        await server.stop()
        assert server.refused == 1
        assert server.faults == 0

    asyncio.run(run())
