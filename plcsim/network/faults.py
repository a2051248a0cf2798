"""Faults of a virtual net: planned by a test, each for a moment or for a span of time."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING

from plcsim.network.errors import NetworkSetupError
from plcsim.network.protocol import is_ip

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


class NetworkFaultKind(Enum):
    """What can go wrong for a span of time."""

    REFUSE = auto()
    SILENCE = auto()
    UNREACHABLE = auto()
    DELAY = auto()
    SHORT_SENDS = auto()


@dataclass(frozen=True, slots=True)
class NetworkFault:
    """A fault between hosts ``a`` and ``b`` (None: any other) from ``from_ns`` until ``until_ns``.

    Attributes:
        kind: what goes wrong.
        a: IPv4 literal of a host.
        b: IPv4 literal of the other host, None for any.
        from_ns: first moment.
        until_ns: first moment after it, None for never.
        value: port of REFUSE (0: all), extra nanoseconds of DELAY, largest bytes of SHORT_SENDS.
    """

    kind: NetworkFaultKind
    a: str
    b: str | None
    from_ns: int
    until_ns: int | None
    value: int = 0

    def covers(self, a: str, b: str, now_ns: int) -> bool:
        """Whether the fault holds now between ``a`` and ``b``, in either direction."""
        if not self.holds(now_ns):
            return False
        if self.b is None:
            return a != b and self.a in (a, b)
        return (self.a, self.b) in ((a, b), (b, a))

    def holds(self, now_ns: int) -> bool:
        """Whether it is time for the fault."""
        return self.from_ns <= now_ns and (self.until_ns is None or now_ns < self.until_ns)


class NetworkFaults:
    """Plans faults. Hosts are IPv4 literals; times are of the net, ``at_ns`` None means now.

    Args:
        now_ns: gives the time of the net.
        plan_reset: resets all connections between two hosts (None: any other) at a time.
    """

    def __init__(
        self,
        now_ns: Callable[[], int],
        plan_reset: Callable[[str, str | None, int], None],
    ) -> None:
        self._now_ns = now_ns
        self._plan_reset = plan_reset
        self._faults: list[NetworkFault] = []

    def reset(self, a: str, b: str | None = None, *, at_ns: int | None = None) -> None:
        """Tear down all connections that exist at ``at_ns`` between two hosts: both ends see RESET.

        Raises:
            NetworkSetupError: not an IPv4 literal, or a time in the past.
        """
        from_ns, _ = self._span(a, b, at_ns, None)
        self._plan_reset(a, b, from_ns)

    def refuse(
        self, host: str, port: int = 0, *, at_ns: int | None = None, until_ns: int | None = None
    ) -> None:
        """Let ``host`` refuse connections to ``port`` (0: to all ports), listening or not.

        Raises:
            NetworkSetupError: not an IPv4 literal, a time in the past or an empty span.
        """
        self._add(NetworkFaultKind.REFUSE, host, None, at_ns, until_ns, port)

    def silence(
        self, a: str, b: str | None = None, *, at_ns: int | None = None, until_ns: int | None = None
    ) -> None:
        """Lose all packets between two hosts; without ``b`` and ``until_ns`` the host is lost.

        Packets are sent again as TCP does: a short silence only delays, a long one ends the
        connection with TIMED_OUT at the end that sends or has keepalive on. Datagrams are lost.

        Raises:
            NetworkSetupError: not an IPv4 literal, a time in the past or an empty span.
        """
        self._add(NetworkFaultKind.SILENCE, a, b, at_ns, until_ns)

    def unreachable(
        self, a: str, b: str | None = None, *, at_ns: int | None = None, until_ns: int | None = None
    ) -> None:
        """Take the route away: connecting gives UNREACHABLE at once, the rest acts as silence.

        Raises:
            NetworkSetupError: not an IPv4 literal, a time in the past or an empty span.
        """
        self._add(NetworkFaultKind.UNREACHABLE, a, b, at_ns, until_ns)

    def delay(
        self,
        a: str,
        b: str | None = None,
        *,
        by_ns: int,
        at_ns: int | None = None,
        until_ns: int | None = None,
    ) -> None:
        """Let packets that are sent in the span take ``by_ns`` longer.

        Raises:
            NetworkSetupError: not an IPv4 literal, a time in the past, an empty span or no delay.
        """
        self._add(NetworkFaultKind.DELAY, a, b, at_ns, until_ns, self._positive(by_ns, "by_ns"))

    def short_sends(
        self,
        host: str,
        *,
        largest: int = 1,
        at_ns: int | None = None,
        until_ns: int | None = None,
    ) -> None:
        """Let each ``send`` of ``host`` take 1 to ``largest`` bytes, by the seed of the net.

        Raises:
            NetworkSetupError: not an IPv4 literal, a time in the past, an empty span or no bytes.
        """
        value = self._positive(largest, "largest")
        self._add(NetworkFaultKind.SHORT_SENDS, host, None, at_ns, until_ns, value)

    def clear(self) -> None:
        """End all faults that last for a span; resets that are planned still come."""
        self._faults.clear()

    def silent(self, a: str, b: str, now_ns: int) -> bool:
        """Whether packets between ``a`` and ``b`` are lost."""
        kinds = (NetworkFaultKind.SILENCE, NetworkFaultKind.UNREACHABLE)
        return any(f.kind in kinds and f.covers(a, b, now_ns) for f in self._faults)

    def no_route(self, a: str, b: str, now_ns: int) -> bool:
        """Whether connecting from ``a`` to ``b`` fails at once."""
        kind = NetworkFaultKind.UNREACHABLE
        return any(f.kind is kind and f.covers(a, b, now_ns) for f in self._faults)

    def refuses(self, host: str, port: int, now_ns: int) -> bool:
        """Whether ``host`` refuses connections to ``port``."""
        return any(
            f.value in (0, port) for f in self._of_host(NetworkFaultKind.REFUSE, host, now_ns)
        )

    def extra_delay_ns(self, a: str, b: str, now_ns: int) -> int:
        """Nanoseconds that packets between ``a`` and ``b`` take longer."""
        kind = NetworkFaultKind.DELAY
        return sum(f.value for f in self._faults if f.kind is kind and f.covers(a, b, now_ns))

    def largest_send(self, host: str, now_ns: int) -> int | None:
        """Most bytes that one ``send`` of ``host`` takes, None without limit."""
        faults = self._of_host(NetworkFaultKind.SHORT_SENDS, host, now_ns)
        return min((f.value for f in faults), default=None)

    def _of_host(self, kind: NetworkFaultKind, host: str, now_ns: int) -> Iterator[NetworkFault]:
        return (f for f in self._faults if f.kind is kind and f.a == host and f.holds(now_ns))

    def _add(
        self,
        kind: NetworkFaultKind,
        a: str,
        b: str | None,
        at_ns: int | None,
        until_ns: int | None,
        value: int = 0,
    ) -> None:
        from_ns, until_ns = self._span(a, b, at_ns, until_ns)
        now_ns = self._now_ns()
        self._faults = [f for f in self._faults if f.until_ns is None or f.until_ns > now_ns]
        self._faults.append(NetworkFault(kind, a, b, from_ns, until_ns, value))

    def _span(
        self, a: str, b: str | None, at_ns: int | None, until_ns: int | None
    ) -> tuple[int, int | None]:
        for host in (a, b):
            if host is not None and not is_ip(host):
                raise NetworkSetupError(f"{host!r} is not an address such as 192.168.0.10.")
        now_ns = self._now_ns()
        from_ns = now_ns if at_ns is None else at_ns
        if from_ns < now_ns:
            raise NetworkSetupError(f"at_ns={from_ns} is before the time of the net, {now_ns}.")
        if until_ns is not None and until_ns <= from_ns:
            raise NetworkSetupError(f"until_ns={until_ns} is not after the begin, {from_ns}.")
        return from_ns, until_ns

    @staticmethod
    def _positive(value: int, name: str) -> int:
        if value < 1:
            raise NetworkSetupError(f"{name}={value}: must be above 0.")
        return value
