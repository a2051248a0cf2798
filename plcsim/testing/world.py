"""What surrounds the programs under test: plants, peers, stimuli, faults, forced tags."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.network import Address, VirtualNetwork
from plcsim.program.fault import describe, location_of
from plcsim.testing.errors import PlantError, PlcTestError
from plcsim.testing.faults import Faults
from plcsim.testing.forces import TagForces
from plcsim.testing.peer import Peer
from plcsim.testing.plant import Plant
from plcsim.testing.schedule import Schedule
from plcsim.testing.stimulus import listed_stimuli, read_stimuli
from plcsim.testing.times import duration_ns

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from plcsim.core import forces as core
    from plcsim.core.task import TaskClass
    from plcsim.testing.plant import PlantStep
    from plcsim.testing.tags import Tags

__tracebackhide__ = True

CONTROLLER_IP = "192.168.0.10"
"""Address of the controller on the virtual network."""

PEER_IP = "192.168.0.20"
"""Address of a peer where the test names none."""


class World(ABC):
    """Base of `Plc`: all of its methods that act on the programs from outside.

    Attributes:
        tags: tags of the controller.
        faults: faults of the network and of tags.
        ip: address of the controller on the virtual network.
    """

    def __init__(
        self, tags: Tags, forces: core.Forces, network: VirtualNetwork | None, seed: int
    ) -> None:
        self.tags = tags
        self.ip = CONTROLLER_IP
        self.faults = Faults(self, seed)
        self._net = network
        self._forces = TagForces(tags, forces)
        self._plants: list[Plant] = []
        self._peers: list[Peer] = []
        self._by_time, self._by_cycle = Schedule(), Schedule()

    @property
    @abstractmethod
    def time_ns(self) -> int:
        """Time since the start of the controller, in nanoseconds."""

    def force(self, path: str, value: object) -> None:
        """Keep a tag at a value whatever the programs and plants do, until `release`.

        Raises:
            TagError: there is no such tag, or it cannot take the value.
        """
        self._forces.force(path, value)

    def release(self, path: str) -> None:
        """Let a forced tag go.

        Raises:
            PlcTestError: it is not forced.
        """
        self._forces.release(path)

    def plant(self, model: PlantStep) -> PlantStep:
        """Add a plant model, stepped before every cycle of the task class under test.

        Args:
            model: a function of (tags, elapsed_ns), or an object with such a method ``step``; it
                reads outputs from ``tags`` and writes inputs to it, or returns them by tag. May be
                used as a decorator.
        """
        self._plants.append(Plant(model, self.tags, self.time_ns))
        return model

    def stimulate(
        self, stimuli: str | Path | Iterable[tuple[str | int, Mapping[str, object]]]
    ) -> int:
        """Write tags at given times from now on.

        Args:
            stimuli: a CSV file (see `plcsim.testing.stimulus`), or pairs (time, {tag: value}).

        Returns:
            Nanoseconds from now to the last stimulus.

        Raises:
            StimulusError: something in them is wrong; line and column are named.
        """
        if isinstance(stimuli, str | Path):
            rows = read_stimuli(Path(stimuli), self.tags)
        else:
            rows = listed_stimuli(stimuli, self.tags)
        for row in rows:
            self.at(row.time_ns, partial(self._write, row.values))
        return max((row.time_ns for row in rows), default=0)

    def _write(self, values: Mapping[str, object]) -> None:
        for path, value in values.items():
            self.tags[path] = value

    def at(self, time: str | int, act: Callable[[], None]) -> None:
        """Plan an act for a time from now; it happens before the first cycle at or after it."""
        self._by_time.plan(self.time_ns + duration_ns(time, "at"), act)

    def at_cycle(self, number: int, act: Callable[[], None]) -> None:
        """Plan an act for just before a cycle of the task class under test, counted from 1."""
        self._by_cycle.plan(number, act)

    @property
    def network(self) -> VirtualNetwork:
        """The virtual network.

        Raises:
            PlcTestError: the test runs on the host's network.
        """
        if self._net is None:
            raise PlcTestError("this test runs on the host's network; there is no virtual one")
        return self._net

    def connect(self, port: int, ip: str = PEER_IP) -> Peer:
        """Return a TCP client that connects to a port of the controller from the next cycle on."""
        return self._add_peer(Peer(self.network, ip, Address(self.ip, port)))

    def listen(self, port: int, ip: str = PEER_IP) -> Peer:
        """Return a TCP server that takes one connection of the controller."""
        return self._add_peer(Peer(self.network, ip, Address(self.ip, 0), port))

    def _add_peer(self, peer: Peer) -> Peer:
        self._peers.append(peer)
        return peer

    def _restart_world(self) -> None:
        """Drop what was planned; the time of plants starts at 0 again."""
        self._by_time.clear()
        self._by_cycle.clear()
        for plant in self._plants:
            plant.restart()

    def _act(self, task_class: TaskClass, time_ns: int, *, under_test: bool) -> None:
        """Bring everything in that acts on the programs; the later one wins.

        Raises:
            PlantError: a plant or a planned act raised.
        """
        actor = "an act planned for this cycle"
        try:
            self._by_time.perform(time_ns)
            if under_test:
                self._by_cycle.perform(task_class.cycles)
                for plant in self._plants:
                    actor = f"plant {plant.name}"
                    plant.step(time_ns)
            for peer in self._peers:
                peer.step()
            self.faults.apply()
        except Exception as error:  # whatever a test's own code raises
            location = location_of(error)
            raise PlantError(
                f"{actor} raised in cycle {task_class.cycles} at {time_ns / 1e6:g} ms: "
                f"{describe(error)}" + (f" ({location})" if location else "")
            ) from None
