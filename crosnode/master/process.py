"""A process that owns a master: ``plcsim master``, or the service of a project.

It steps as fast as there is something to do and rests a millisecond where there is not.
"""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.master.server import MasterOptions, MasterServer, first_parameters
from crosnode.transport.budget import UNPACED
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.host import descriptors
from plcsim.library.astcp import tcpERR_ALREADY_EXIST, tcpERR_INTERFACE, tcpERR_SOCKET_BIND
from plcsim.network import OsNetwork

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

REST_S: Final = 0.001
IDENTS: Final = 4096


class Refusal(NamedTuple):
    """Why a port is not open.

    Attributes:
        field: "port" or "bind".
        text: what is wrong with its value.
    """

    field: str
    text: str


class MasterProcess:
    """A master on a controller without programs; its first step is done.

    Args:
        host: name or number in its URI.
        port: to listen at.
        bind_ip: own interface to listen on, "" for all, None for that of ``host``.
        hosts: addresses of host names in the URIs of nodes.
        ipv6: whether names stand for addresses of IPv6.

    Attributes:
        server: the master.
    """

    def __init__(
        self,
        host: str,
        port: int,
        bind_ip: str | None,
        hosts: Mapping[str, str],
        *,
        ipv6: bool = False,
    ) -> None:
        descriptors.allow(IDENTS + descriptors.SPARE)
        self._context = Context(Memory(), OsNetwork(), {"AsTCP": {"idents": IDENTS}})
        pid = os.getpid()
        options = MasterOptions(
            host=host,
            port=port,
            bind_ip=bind_ip,
            ipv6=ipv6,
            pid=pid,
            parameters=first_parameters(f"plcsim-{pid}-{time.time_ns()}"),
            hosts=hosts,
            step=UNPACED,
        )
        self.server = MasterServer(self._context, options)
        self._step()

    @property
    def refusal(self) -> Refusal | None:
        """Why the port is not open, None where it is."""
        if self.server.is_open:
            return None
        port, bind_ip = self.server.options.port, self.server.bind_ip
        return {
            tcpERR_ALREADY_EXIST: Refusal("port", f"{port} is in use"),
            tcpERR_SOCKET_BIND: Refusal(
                "port", f"{port} needs root or CAP_NET_BIND_SERVICE, which are not given"
            ),
            tcpERR_INTERFACE: Refusal("bind", f"{bind_ip!r} is no address of this host"),
        }.get(
            self.server.status,
            Refusal("port", f"{port} cannot be opened: AsTCP status {self.server.status}"),
        )

    def _step(self) -> None:
        self._context.release_ns = time.monotonic_ns()
        self.server.step()

    def run(self, goes_on: Callable[[], bool], until_ns: int | None = None) -> None:
        """Serve until asked to stop, a shutdown by the API, or a time.

        Args:
            goes_on: asked after each step.
            until_ns: of the monotonic clock, None for ever.
        """
        while not self.server.master.is_shut_down:
            self._step()
            if until_ns is not None and self._context.release_ns >= until_ns:
                break
            if not goes_on():
                break
            time.sleep(REST_S)
        self.server.close()
