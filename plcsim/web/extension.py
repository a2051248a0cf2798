"""The extension of the table [web]: what the pages are told of the controller."""

from __future__ import annotations

import os
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Final

from plcsim.access.users import Users, users_file
from plcsim.core.errors import ConfigurationError
from plcsim.project.extension import Attachment, Extension
from plcsim.web.border import BorderReport
from plcsim.web.pointers import pointers_of
from plcsim.web.settings import read_settings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.controller import Controller
    from plcsim.settings.table import Table
    from plcsim.web.settings import WebProject

STREAM_SIZE: Final = 8 * 1024 * 1024
"""Bytes between the scan and the pages: 8 tags in every cycle of 1 ms fill it in a minute."""

NEEDED: Final = ("starlette", "uvicorn", "websockets", "argon2")


class WebExtension(Extension):
    """The controller in a browser."""

    def read(self, table: Table) -> WebProject:
        """Return the settings."""
        return read_settings(table)

    def service(self, _settings: WebProject) -> str:
        """Return the module that serves the pages."""
        return "plcsim.web.service.process"

    def endpoint(self, settings: WebProject) -> str:
        """Return the address of the pages."""
        return settings.settings.url

    def attach(self, settings: WebProject, controller: Controller) -> Attachment:
        """Return what does not change while the controller runs."""
        _require_packages()
        given = {
            "settings": settings.settings.to_json(),
            "folder": str(settings.folder),
            **_facts(controller),
        }
        return Attachment(given, (), STREAM_SIZE, BorderReport(controller).connect)

    def check(self, settings: WebProject, controller: Controller) -> Sequence[str]:
        """Check that the pages can be served, and that somebody could log in."""
        _require_packages()
        # not at the top: the scan process has no use for ssl
        from plcsim.web.service.listener import check_users, tls_context  # noqa: PLC0415

        check_users(settings.settings, Users(users_file(settings.folder)))
        if settings.settings.tls is not None:
            tls_context(settings.settings.tls)
        return ()


def _require_packages() -> None:
    missing = [name for name in NEEDED if find_spec(name) is None]
    if missing:
        raise ConfigurationError(
            f"[web]: needs {', '.join(missing)}; python3 -m pip install 'plcsim[web]'"
        )


def _facts(controller: Controller) -> dict[str, Any]:
    """Return what does not change while the controller runs."""
    return {
        "scan_pid": os.getpid(),
        "memory_size": controller.memory.size,
        "is_virtual": controller.clock.is_virtual,
        "pointers": pointers_of(controller.areas),
        "tasks": [task.name for task in controller.tasks],
        "classes": [
            {
                "number": c.number,
                "cycle_ns": c.cycle_ns,
                "tolerance_ns": c.tolerance_ns,
                "policy": c.policy.value,
                "tasks": [task.name for task in c.tasks],
            }
            for c in controller.classes
        ],
    }


EXTENSION = WebExtension()
