"""The embedded master beside the scan; `plcsim.process.service_main` calls `serve`.

A port that cannot be opened is tried again once a second.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from crosnode.master.process import MasterProcess

if TYPE_CHECKING:
    from plcsim.process.service_main import Service

FIELDS = {"port": "ros.master_port", "bind": "ros.bind"}
"""Of plc.toml, by `crosnode.master.process.Refusal.field`."""


def serve(service: Service) -> None:
    """Serve until asked to stop."""
    given = service.given
    process = MasterProcess(
        given["host"], given["port"], given["bind_ip"], given["hosts"], ipv6=given["ipv6"]
    )

    def tell() -> bool:
        if process.server.is_open:
            service.serving(f"master at {process.server.uri}")
        elif (refusal := process.refusal) is not None:
            field = FIELDS[refusal.field]
            service.failing(f"{given['file']}: {field}: {refusal.text}; trying on")
        return not service.is_stopping

    process.run(tell)
