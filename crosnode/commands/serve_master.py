"""What ``plcsim master`` does."""

from __future__ import annotations

import os
import signal
import sys
import time
from typing import TYPE_CHECKING

from crosnode.errors import InvalidNameError
from crosnode.graph.hosts import hosts_text, is_ipv6_wanted, parse_hosts
from crosnode.graph.uri import make_uri, parse_uri
from crosnode.master.process import MasterProcess
from plcsim.core.errors import ConfigurationError

if TYPE_CHECKING:
    import argparse
    from types import FrameType


class _Stop:
    """Set by SIGINT or SIGTERM."""

    def __init__(self) -> None:
        self.is_asked = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._ask)

    def _ask(self, _number: int, _frame: FrameType | None) -> None:
        self.is_asked = True


def run(arguments: argparse.Namespace) -> None:
    """Serve until asked to end.

    Raises:
        ConfigurationError: the port cannot be opened, or the host is none.
    """
    start_ns = time.monotonic_ns()
    text = hosts_text()
    ipv6 = is_ipv6_wanted(os.environ)
    host = _host(arguments.host)
    stop = _Stop()
    process = MasterProcess(
        host, arguments.port, arguments.bind, parse_hosts(text, ipv6=ipv6), ipv6=ipv6
    )
    if process.refusal:
        raise ConfigurationError(f"--{process.refusal.field}: {process.refusal.text}")
    sys.stdout.write(f"ROS_MASTER_URI={process.server.uri}\n")
    sys.stdout.flush()
    until_ns = None if arguments.for_ns is None else start_ns + arguments.for_ns
    process.run(lambda: not stop.is_asked, until_ns)


def _host(given: str | None) -> str:
    """Return the host of the URI: the argument, ROS_HOSTNAME, ROS_IP or localhost."""
    found = {"--host": given} | {key: os.environ.get(key) for key in ("ROS_HOSTNAME", "ROS_IP")}
    for name, host in found.items():
        if host:
            try:
                return parse_uri(make_uri("http", host, 1), "http").host
            except InvalidNameError:
                text = f"{name}: {host[:100]!r} is no name or number of a host"
                raise ConfigurationError(text) from None
    return "localhost"
