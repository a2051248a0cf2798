"""The embedded master beside the scan: ``python -m crosnode.plc.master_service ORDER``.

ORDER is a `plcsim.project.extension.ServiceOrder` as JSON. A port that cannot be opened is tried
again once a second. The process ends when it is asked to or when its supervisor ends; where it ends
otherwise, the supervisor starts it again.
"""

from __future__ import annotations

import json
import signal
import sys
from typing import Any

from crosnode.master.process import MasterProcess
from plcsim.core.errors import PlcError
from plcsim.host import realtime
from plcsim.project.extension import ServiceOrder
from plcsim.shared_image import ImageReader

FIELDS = {"port": "ros.master_port", "bind": "ros.bind"}
"""Of plc.toml, by `crosnode.master.process.Refusal.field`."""


def main() -> int:
    """Serve until asked to stop; return the exit code."""
    order = ServiceOrder(**json.loads(sys.argv[1]))
    realtime.die_with_parent(signal.SIGTERM)
    try:
        given: dict[str, Any] = ImageReader(order.image_fd, order.table).directory.services[
            order.table
        ]
    except PlcError as err:
        sys.stderr.write(f"plcsim: {err}\n")
        return 1
    process = MasterProcess(given["host"], given["port"], given["bind_ip"], given["hosts"])
    process.run(look=_News(process, given["file"], quiet=order.quiet))
    return 0


class _News:
    """Tells once that the port is not open, and once that it is.

    Args:
        process: that serves.
        file: plc.toml.
        quiet: tell errors only.
    """

    def __init__(self, process: MasterProcess, file: str, *, quiet: bool) -> None:
        self._process = process
        self._file = file
        self._quiet = quiet
        self._was_open: bool | None = None

    def __call__(self) -> None:
        is_open = self._process.server.is_open
        if is_open is self._was_open:
            return
        self._was_open = is_open
        if (refusal := self._process.refusal) is not None:
            field = FIELDS[refusal.field]
            sys.stderr.write(f"plcsim: {self._file}: {field}: {refusal.text}; trying on\n")
        elif not self._quiet:
            sys.stderr.write(f"ros: master at {self._process.server.uri}\n")


if __name__ == "__main__":
    sys.exit(main())
