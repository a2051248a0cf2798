"""What ``plcsim master`` runs: the master on a controller without programs.

The process owns the master, so it steps as fast as there is something to do and rests a
millisecond where there is not.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final

from crosnode.budget import UNPACED
from crosnode.hosts import parse_hosts
from crosnode.master_server import MasterOptions, MasterServer
from plcsim.context import Context
from plcsim.memory import Memory
from plcsim.network import OsNetwork

if TYPE_CHECKING:
    import argparse
    from types import FrameType

REST_S: Final = 0.001
IDENTS: Final = 4096
HOSTS: Final = Path("/etc/hosts")


def run(arguments: argparse.Namespace) -> int:
    """Run until SIGINT or SIGTERM, or the time is over; return the exit status."""
    options = {"AsTCP": {"idents": IDENTS}}
    context = Context(Memory(), OsNetwork(), options)
    context.release_ns = start_ns = time.monotonic_ns()
    server = MasterServer(context, _options(arguments))
    server.step()
    if not server.is_open:
        sys.stderr.write(f"error: port {arguments.port}: AsTCP status {server.status}\n")
        return 1
    sys.stdout.write(f"ROS_MASTER_URI={server.uri}\n")
    sys.stdout.flush()
    stop = _Stop()
    end_ns = None if arguments.for_s is None else start_ns + int(arguments.for_s * 1e9)
    while not stop.is_asked and not server.master.is_shut_down:
        context.release_ns = time.monotonic_ns()
        if end_ns is not None and context.release_ns >= end_ns:
            break
        server.step()
        time.sleep(REST_S)
    server.close()
    return 0


def _options(arguments: argparse.Namespace) -> MasterOptions:
    host = arguments.host or os.environ.get("ROS_HOSTNAME") or os.environ.get("ROS_IP")
    text = HOSTS.read_text(errors="replace") if HOSTS.is_file() else ""
    return MasterOptions(
        host=host or "localhost",
        port=arguments.port,
        bind_ip=arguments.bind,
        pid=os.getpid(),
        parameters={
            "/run_id": f"plcsim-{os.getpid()}-{time.time_ns()}",
            "/rosdistro": "noetic\n",
            "/rosversion": "1.15.15\n",
        },
        hosts=parse_hosts(text),
        step=UNPACED,
    )


class _Stop:
    """Set by SIGINT or SIGTERM."""

    def __init__(self) -> None:
        self.is_asked = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._ask)

    def _ask(self, _number: int, _frame: FrameType | None) -> None:
        self.is_asked = True
