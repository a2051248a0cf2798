"""The extension of the table [opcua]: checks what is to be served, hands it to the service."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Final

from plcsim.access import Users
from plcsim.access.users import users_file
from plcsim.core.errors import ConfigurationError
from plcsim.opcua.model import ModelMaker
from plcsim.opcua.notes import notes_of
from plcsim.opcua.settings import OpcuaProject, read_settings
from plcsim.project.extension import Attachment, Extension
from plcsim.settings import is_loopback

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.controller import Controller
    from plcsim.opcua.model import Branch
    from plcsim.settings.table import Table

NEEDED: Final = ("asyncua", "argon2")


class OpcuaExtension(Extension):
    """Tags over OPC UA."""

    def read(self, table: Table) -> OpcuaProject:
        """Return the settings."""
        return read_settings(table)

    def service(self, _settings: OpcuaProject) -> str:
        """Return the module that serves."""
        return "plcsim.opcua.service.process"

    def endpoint(self, settings: OpcuaProject) -> str:
        """Return the address of the server."""
        return settings.settings.endpoint

    def attach(self, settings: OpcuaProject, controller: Controller) -> Attachment:
        """Return what the service needs; what it serves is in every snapshot."""
        branches = branches_of(settings, controller.areas)
        given: dict[str, Any] = {
            "settings": settings.settings.to_json(),
            "folder": str(settings.folder),
        }
        return Attachment(given, [leaf.tag for branch in branches for leaf in branch.leaves()])

    def check(self, settings: OpcuaProject, controller: Controller) -> Sequence[str]:
        """Check that what is named is there, and that this host can serve it."""
        branches_of(settings, controller.areas)
        missing = [name for name in NEEDED if find_spec(name) is None]
        if missing:
            return [f"opcua: needs {', '.join(missing)}; python3 -m pip install 'plcsim[opcua]'"]
        if not is_loopback(settings.settings.host) and not Users(users_file(settings.folder)):
            return ["opcua.host: nobody is let in before there are users; plcsim users add NAME"]
        return []


def branches_of(project: OpcuaProject, areas: Sequence[Any]) -> list[Branch]:
    """Return what is served.

    Raises:
        ConfigurationError: a tag is named that is not there, there are too many variables, or the
            tag map is wrong.
    """
    settings = project.settings
    maker = ModelMaker(
        settings.tags,
        notes_of(project.folder),
        most=settings.nodes,
        read_only=settings.read_only,
    )
    branches = maker.make(areas)
    if not branches:
        raise ConfigurationError("opcua: there is no variable to serve")
    return branches


EXTENSION = OpcuaExtension()
