from pathlib import Path
from random import Random
from typing import Any

import pytest

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.core.control import Action, Request
from plcsim.core.controller import Controller
from plcsim.library.astcp import TcpOpen
from plcsim.network import VirtualNetwork
from plcsim.process.operation import Operation
from plcsim.project.assembly import Application
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.replay.replay import Replay
from st_types import BOOL, LINT, STRING, UDINT, UINT, var

from ..conftest import Fast, Recordings, Slow, application_of


def repeat(bag: Path, application: Application) -> Replay:
    with open_bag(bag) as reader:
        again = Replay(application, reader.head(), reader.records())
        again.run()
    return again


def tell(controller: Controller) -> None:
    """Write from outside, as a service does between two cycles, and force."""
    told = controller.tags.find("Fast.told")
    controller.memory.write(told.address, (21).to_bytes(2, "little"))
    for follower in controller.image.followers:
        follower(told.address, (21).to_bytes(2, "little"))
    controller.forces.force(controller.tags.find("Fast.lamp"), b"\1", "test")


def test_a_run_is_repeated_with_the_same_tags_in_every_cycle(recordings: Recordings) -> None:
    application = application_of(Fast, Slow)

    again = repeat(recordings("a.bag", application), application)

    assert again.difference is None
    assert [c.cycles for c in again.controller.classes] == [40, 20]
    assert again.cycles == 60


def test_what_was_written_and_forced_from_outside_comes_again(recordings: Recordings) -> None:
    application = application_of(Fast, Slow)

    again = repeat(recordings("a.bag", application, act=tell), application)

    assert again.difference is None
    tags = again.controller.tags
    assert tags.read(tags.find("Fast.doubled")) == 42
    assert [force.tag.path for force in again.controller.forces] == ["Fast.lamp"]


def changed_fast() -> type[Program]:
    """Return `Fast` after somebody has worked on it: from cycle 8 on it counts otherwise."""

    class Fast(Program):
        count = var(UDINT)
        told = var(UINT)
        doubled = var(UINT)
        lamp = var(BOOL)
        name = var(STRING(11), "fast")

        def cyclic(self) -> None:
            self.count += 1 if self.count < 7 else 2
            self.doubled = 2 * self.told
            self.lamp = not self.lamp

    return Fast


def test_the_first_cycle_that_differs_is_named_with_its_tag(recordings: Recordings) -> None:
    bag = recordings("a.bag", application_of(Fast))

    again = repeat(bag, application_of(changed_fast()))

    assert str(again.difference) == "cycle 8 of task class 1: Fast.count is 9, and was 8"
    assert again.cycles == 7


def test_other_variables_are_another_project(recordings: Recordings) -> None:
    bag = recordings("a.bag", application_of(Fast))

    class Other(Program):
        count = var(UDINT)

        def cyclic(self) -> None:
            self.count += 1

    with pytest.raises(RecordingError, match="variables of Other"):
        repeat(bag, application_of(Other))


def test_a_cycle_can_be_reached_and_looked_at(recordings: Recordings) -> None:
    application = application_of(Fast, Slow)
    with open_bag(recordings("a.bag", application)) as reader:
        again = Replay(application, reader.head(), reader.records())
        again.run(lambda each: each.number == 1 and each.cycles == 7)

    tags = again.controller.tags
    assert tags.read(tags.find("Fast.count")) == 7
    assert again.difference is None


class Watcher(Program):
    """Depends on everything that is never the same twice: time, and what the network answers."""

    opened = var(UINT)
    now = var(LINT)
    server = var(TcpOpen)

    def cyclic(self) -> None:
        self.now = self.context.release_ns
        self.server(enable=True, port=5000)
        self.opened = self.server.status


class Jittery(VirtualClock):
    """Wakes a little late, each time otherwise, and grows while nobody sleeps: as a real one."""

    is_virtual = False

    def __init__(self) -> None:
        super().__init__()
        self._chance = Random(7)

    def now_ns(self) -> int:
        self.stall_ns(self._chance.randrange(1_000, 300_000))
        return super().now_ns()

    def cpu_ns(self) -> int:
        self.spend_ns(self._chance.randrange(100_000))
        return super().cpu_ns()


def test_a_run_on_a_clock_that_is_never_the_same_is_repeated(recordings: Recordings) -> None:
    application = application_of(Watcher, Slow)
    clock = Jittery()
    net = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    bag = recordings("a.bag", application, cycles=10, network=net, clock=clock)

    again = repeat(bag, application)

    assert again.difference is None
    assert again.cycles == 30
    lateness = again.controller.classes[0].lateness
    assert lateness.percentile_ns(50) > 0


def test_records_that_were_lost_end_the_replay(recordings: Recordings) -> None:
    application = application_of(Fast)
    with open_bag(recordings("a.bag", application)) as reader:
        records: list[Any] = list(reader.records())
        del records[10]
        again = Replay(application, reader.head(), records)
        with pytest.raises(RecordingError, match="records 10 to 10 were lost"):
            again.run()


def test_a_recording_without_its_beginning_cannot_be_repeated(recordings: Recordings) -> None:
    application = application_of(Fast)
    with open_bag(recordings("a.bag", application)) as reader:
        records = [(n - 5, r) for n, r in reader.records() if n >= 5]
        with pytest.raises(RecordingError, match="does not begin with the start"):
            Replay(application, reader.head(), records)


@pytest.mark.parametrize(
    "asked",
    [
        [(5, Action.PAUSE), (0, Action.CONTINUE)],
        [(7, Action.WARM_RESTART)],
        [(4, Action.COLD_RESTART), (9, Action.PAUSE), (0, Action.CYCLES), (0, Action.CONTINUE)],
    ],
)
def test_pauses_single_cycles_and_restarts_come_again(
    recordings: Recordings, asked: list[tuple[int, Action]]
) -> None:
    def operate(controller: Controller) -> None:
        waiting = list(asked)

        def ask() -> None:
            if waiting and controller.classes[0].cycles % 20 >= waiting[0][0]:
                controller.request(Request(waiting.pop(0)[1], 3, "test"))

        controller.image.inputs.append(lambda _: ask())
        controller.image.exchanges.append(ask)
        Operation(controller, rest=lambda _: None).run(cycles=40)

    application = application_of(Watcher, Slow, Fast)
    bag = recordings("a.bag", application, act=operate, clock=Jittery())

    again = repeat(bag, application)

    assert again.difference is None
    with open_bag(bag) as reader:
        cycles = sum(record.step == 0 for _, record in reader.records())
    assert again.cycles == cycles
