"""The table [web] of plc.toml; docs/guide/web.md lists its keys."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any, Final, NamedTuple

from plcsim.settings import IpAddress, SettingKind, Whole, settings
from plcsim.settings.kinds import PathTo

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from plcsim.settings import Table

WEB_PORT: Final = 8080


class _PemFile(SettingKind):
    """A file that must be there, as text: settings go to the service as JSON."""

    def convert(self, value: object, folder: Path) -> str:
        """Return the path."""
        return str(PathTo("file").convert(value, folder.resolve()))


@settings
class WebTlsSettings:
    """The pages over HTTPS.

    Attributes:
        certificate: file of the server's certificate, PEM.
        key: file of its key, PEM, without a password.
    """

    certificate: Annotated[str, _PemFile()]
    key: Annotated[str, _PemFile()]


@settings
class WebSettings:
    """What [web] says.

    Attributes:
        host: address to listen on.
        port: of TCP, 0 for any free one.
        names: host names, beside the address, by which browsers may ask for the pages.
        connections: at once.
        tls: None for plain HTTP.
    """

    host: Annotated[str, IpAddress()] = "127.0.0.1"
    port: Annotated[int, Whole(0, 65535)] = WEB_PORT
    names: tuple[str, ...] = ()
    connections: Annotated[int, Whole(1, 10_000)] = 64
    tls: WebTlsSettings | None = None

    @property
    def url(self) -> str:
        """Where the pages are, as far as that is known before they are served."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"http{'s' if self.tls else ''}://{host}:{self.port or '(any free port)'}"

    def to_json(self) -> dict[str, Any]:
        """Return the settings as JSON's types."""
        return asdict(self)


class WebProject(NamedTuple):
    """The settings and the folder of the project they belong to."""

    settings: WebSettings
    folder: Path


def settings_from(values: Mapping[str, Any]) -> WebSettings:
    """Return the settings of `WebSettings.to_json`."""
    tls = WebTlsSettings(**values["tls"]) if values["tls"] else None
    return WebSettings(**{**values, "names": tuple(values["names"]), "tls": tls})


def read_settings(table: Table) -> WebProject:
    """Return the settings of the table [web] of a project.

    Raises:
        ConfigurationError: values are wrong; file and field of each are named.
    """
    return WebProject(table.read(WebSettings), table.folder.resolve())
