from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.core.control import Step
from plcsim.core.traffic import Topic
from plcsim.network import VirtualNetwork
from plcsim.program.setup import make_controller
from plcsim.recorder.journal.journal import Journal
from plcsim.recorder.journal.record import (
    LIMITS,
    JournalRecord,
    JournalStore,
    entries,
    numbers_of,
    record_of,
)
from plcsim.recorder.journal.tape import TOPICS_EVERY, Tape

from ..conftest import Fast, Slow, application_of

CHATTER = Topic("/chatter", "std_msgs/String", "0" * 32, "string data", "/plc", True, False)
OTHER = CHATTER._replace(name="/other")


class Taped:
    """A controller with a tape; what it recorded is in ``records``."""

    def __init__(self, *programs: type[Program]) -> None:
        clock = VirtualClock()
        net = VirtualNetwork(clock.now_ns).host("192.168.0.10")
        self.controller = make_controller(application_of(*programs).setup, network=net, clock=clock)
        self.records: list[JournalRecord] = []
        self.journal = Journal()
        Tape(self.controller, self.journal, self._keep)

    def _keep(self, _kind: int, _time_ns: int, data: bytes) -> None:
        self.records.append(record_of(data))

    def run(self, cycles: int) -> None:
        """Run, and boot before where that is not done."""
        if not self.records:
            self.controller.boot()
        self.controller.run(cycles=cycles)


def test_every_cycle_and_every_step_is_a_record() -> None:
    taped = Taped(Fast, Slow)
    controller, records = taped.controller, taped.records

    controller.boot()
    controller.run(cycles=2)
    controller.shutdown()
    controller.close()

    steps = [Step(each.step).name if each.step else f"#{each.task_class}" for each in records]
    assert steps == ["BOOT", "START", "RUN", "#1", "#2", "#1", "SHUTDOWN", "CLOSE"]
    assert LIMITS.unpack(records[2].variables) == (0, 2)
    timings = [[(t.task_class, t.cycles, t.executed) for t in r.timings] for r in records]
    cycles = [[(1, 1, 0)], [(2, 1, 0)], [(1, 2, 1)]]
    assert timings == [[], [], [], *cycles, [], [(1, 2, 2), (2, 1, 1)]]
    assert [r.variables[:4] for r in records if r.task_class == 1] == [b"\1\0\0\0", b"\2\0\0\0"]


def test_a_record_has_what_came_since_the_last_one() -> None:
    taped = Taped(Fast)
    journal = taped.journal
    taped.run(1)
    journal.clock += [5, 6]
    journal.network += b"net"
    journal.messages += [(0, b"a"), (1, memoryview(b"b")), (0, b"c")]
    journal.wrote(100, b"x")

    taped.run(1)

    step, cycle = taped.records[-2:]
    assert (step.network, numbers_of(step.clock)) == (b"net", (5, 6))
    assert step.messages == [(0, b"a"), (1, b"b"), (0, b"c")]
    assert list(entries(step.writes)) == [JournalStore(0, 100, b"x")]
    assert (cycle.cycle, cycle.clock, cycle.network, cycle.writes) == (2, b"", b"", b"")
    assert cycle.messages == []


def test_topics_are_described_once_and_now_and_then() -> None:
    taped = Taped(Fast)
    traffic = taped.controller.context.traffic
    assert traffic.number_of(CHATTER) == 0
    taped.run(3)
    assert traffic.number_of(OTHER) == 1
    taped.run(TOPICS_EVERY)

    described = {n: each.topics for n, each in enumerate(taped.records) if each.topics}

    (first, second, third) = described
    assert described[first] == [(0, CHATTER)]
    assert described[second] == [(1, OTHER)]
    assert described[third] == [(0, CHATTER), (1, OTHER)]
    assert taped.records[third].cycle == TOPICS_EVERY
