"""What a virtual net is made of: links with latency, packets, limits of hosts, the trace."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from plcsim.network.errors import NetworkSetupError

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.network.protocol import Address

SECOND_NS = 1_000_000_000


@dataclass(frozen=True, slots=True)
class Link:
    """The way between two hosts.

    Attributes:
        latency_ns: nanoseconds from send to arrival, one way.
        jitter_ns: a random time up to this is added to each packet; packets stay in order.
        largest_packet: bytes; data are cut into packets of random sizes from
            ``smallest_packet`` to this.
        smallest_packet: bytes; equal to ``largest_packet`` for no randomness.
    """

    latency_ns: int = 0
    jitter_ns: int = 0
    largest_packet: int = 1460
    smallest_packet: int = 1460

    def __post_init__(self) -> None:
        if self.latency_ns < 0 or self.jitter_ns < 0:
            raise NetworkSetupError(f"{self}: times must not be negative.")
        if not 1 <= self.smallest_packet <= self.largest_packet:
            raise NetworkSetupError(f"{self}: need 1 <= smallest_packet <= largest_packet.")


@dataclass(frozen=True, slots=True)
class WireLimits:
    """Bounds of each host.

    Attributes:
        send_buffer: bytes, as on X20 controllers.
        receive_buffer: bytes.
        sockets: open sockets, queued connections and closed ones that still fade out.
        connect_ns: time after which connecting gives TIMED_OUT (BSD: 75 s).
        retransmit_ns: time after which unanswered data end the connection.
        fade_ns: time in which a closed socket may still send its bytes, and TIME_WAIT afterwards.
    """

    send_buffer: int = 8192
    receive_buffer: int = 65_536
    sockets: int = 1024
    connect_ns: int = 75 * SECOND_NS
    retransmit_ns: int = 60 * SECOND_NS
    fade_ns: int = 60 * SECOND_NS


@dataclass(slots=True)
class Packet:
    """One packet on its way.

    Attributes:
        kind: SYN, SYN-ACK, DATA, FIN or RST.
        source: sender.
        target: receiver.
        size: bytes of data.
        deliver: act of arriving; False when the receiver drops the packet.
        give_up: act when no repeat has arrived within ``patience_ns``.
        patience_ns: nanoseconds; 0 for a packet that is not repeated.
        retry_ns: nanoseconds until the first repeat.
    """

    kind: str
    source: Address
    target: Address
    size: int
    deliver: Callable[[], bool]
    give_up: Callable[[], None]
    patience_ns: int
    retry_ns: int
    first_sent_ns: int = 0


class TraceEvent(NamedTuple):
    """A packet that arrived or was lost, for comparing runs and for reading after a failure."""

    time_ns: int
    kind: str
    source: Address
    target: Address
    size: int
    lost: bool


def is_loopback(ip: str) -> bool:
    """Whether a literal means the own host (127.0.0.0/8, ::1)."""
    return ip.startswith("127.") or ip == "::1"
