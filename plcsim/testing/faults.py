"""Faults of the virtual network and of tags, planned by time or cycle, repeatable by the seed."""

from __future__ import annotations

from functools import partial
from random import Random
from typing import TYPE_CHECKING

from plcsim.network.errors import NetworkSetupError
from plcsim.testing.errors import PlcTestError
from plcsim.testing.forces import Noise
from plcsim.testing.times import duration_ns

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.network import VirtualNetwork
    from plcsim.testing.world import World

__tracebackhide__ = True


class Faults:
    """Plans faults for the controller under test.

    Every fault begins at once, ``at`` a time from now ("100ms"), or ``at_cycle`` a cycle of the
    task class under test, and lasts ``for_`` a time, for ever without it. Peers are IPv4 literals.
    """

    def __init__(self, plc: World, seed: int) -> None:
        self._plc = plc
        self._random = Random(seed)  # noqa: S311  # repeatable on purpose
        self._fresh = self._random.getstate()
        self._noises: list[Noise] = []

    def stuck(
        self,
        path: str,
        value: object = None,
        *,
        at: str | None = None,
        at_cycle: int | None = None,
        for_: str | None = None,
    ) -> None:
        """Let a tag stick at ``value``, or at the value it has when the fault begins."""
        self._plc.tags.find(path)
        if value is not None:
            self._plc.tags.encode(path, value)

        def begin() -> None:
            self._plc.force(path, self._plc.tags.peek(path) if value is None else value)
            self._after(for_, partial(self._plc.release, path))

        self._plan(begin, at, at_cycle)

    def noise(
        self,
        path: str,
        amplitude: float,
        *,
        at: str | None = None,
        at_cycle: int | None = None,
        for_: str | None = None,
    ) -> None:
        """Add a random value within ``amplitude`` to a numeric tag before every cycle."""
        noise = Noise(self._plc.tags, path, amplitude, self._random)

        def begin() -> None:
            self._noises.append(noise)
            self._after(for_, partial(self._noises.remove, noise))

        self._plan(begin, at, at_cycle)

    def latency(
        self,
        by: str,
        peer: str | None = None,
        *,
        at: str | None = None,
        at_cycle: int | None = None,
        for_: str | None = None,
    ) -> None:
        """Let packets take longer by a time, to and from a peer or all peers."""
        by_ns = duration_ns(by, "latency")

        def begin(until_ns: int | None) -> None:
            self._net.faults.delay(self._plc.ip, peer, by_ns=by_ns, until_ns=until_ns)

        self._plan_span(begin, at, at_cycle, for_)

    def short_sends(
        self,
        largest: int = 1,
        host: str | None = None,
        *,
        at: str | None = None,
        at_cycle: int | None = None,
        for_: str | None = None,
    ) -> None:
        """Let every send of the controller, or of another host, take 1 to ``largest`` bytes."""

        def begin(until_ns: int | None) -> None:
            self._net.faults.short_sends(host or self._plc.ip, largest=largest, until_ns=until_ns)

        self._plan_span(begin, at, at_cycle, for_)

    def reset(
        self, peer: str | None = None, *, at: str | None = None, at_cycle: int | None = None
    ) -> None:
        """Reset the connections with a peer or all peers."""
        self._plan(lambda: self._net.faults.reset(self._plc.ip, peer), at, at_cycle)

    def refuse(
        self,
        peer: str,
        port: int = 0,
        *,
        at: str | None = None,
        at_cycle: int | None = None,
        for_: str | None = None,
    ) -> None:
        """Let a peer refuse connections to a port (0: all)."""

        def begin(until_ns: int | None) -> None:
            self._net.faults.refuse(peer, port, until_ns=until_ns)

        self._plan_span(begin, at, at_cycle, for_)

    def silence(
        self,
        peer: str | None = None,
        *,
        at: str | None = None,
        at_cycle: int | None = None,
        for_: str | None = None,
    ) -> None:
        """Lose all packets to and from a peer or all peers."""

        def begin(until_ns: int | None) -> None:
            self._net.faults.silence(self._plc.ip, peer, until_ns=until_ns)

        self._plan_span(begin, at, at_cycle, for_)

    def lose_peer(self, peer: str, *, at: str | None = None, at_cycle: int | None = None) -> None:
        """Lose a peer for good, as if its cable were cut."""
        self.silence(peer, at=at, at_cycle=at_cycle)

    @property
    def used_chance(self) -> bool:
        """Whether noise has been drawn."""
        return self._random.getstate() != self._fresh

    def apply(self) -> None:
        """Disturb the tags; called in LATCH."""
        for noise in self._noises:
            noise.apply()

    @property
    def _net(self) -> VirtualNetwork:
        return self._plc.network

    def _plan_span(
        self,
        begin: Callable[[int | None], None],
        at: str | None,
        at_cycle: int | None,
        for_: str | None,
    ) -> None:
        span_ns = None if for_ is None else duration_ns(for_, "for_")

        def act() -> None:
            begin(None if span_ns is None else self._net.now_ns + span_ns)

        self._plan(act, at, at_cycle)

    def _plan(self, act: Callable[[], None], at: str | None, at_cycle: int | None) -> None:
        if at is not None and at_cycle is not None:
            raise PlcTestError("give either at or at_cycle, not both")
        if at is not None:
            self._plc.at(at, act)
        elif at_cycle is not None:
            self._plc.at_cycle(at_cycle, act)
        else:
            try:
                act()
            except NetworkSetupError as err:
                raise PlcTestError(str(err)) from None

    def _after(self, for_: str | None, act: Callable[[], None]) -> None:
        if for_ is not None:
            self._plc.at(for_, act)
