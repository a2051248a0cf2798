from plcsim.core.clock import VirtualClock
from plcsim.core.control import Step
from plcsim.network import VirtualNetwork
from plcsim.program.setup import make_controller
from plcsim.recorder.journal.journal import Journal
from plcsim.recorder.journal.record import LIMITS, JournalRecord, record_of
from plcsim.recorder.journal.tape import Tape

from ..conftest import Fast, Slow, application_of


def test_every_cycle_and_every_step_is_a_record() -> None:
    clock = VirtualClock()
    net = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    controller = make_controller(application_of(Fast, Slow).setup, network=net, clock=clock)
    records: list[JournalRecord] = []
    Tape(controller, Journal(), lambda _time_ns, data: records.append(record_of(data)))

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
