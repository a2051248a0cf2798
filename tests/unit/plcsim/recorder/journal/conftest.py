from plcsim.core.clock import VirtualClock
from plcsim.network import VirtualNetwork
from plcsim.program.setup import make_controller
from plcsim.recorder.journal.journal import Journal
from plcsim.recorder.journal.record import JournalRecord, record_of
from plcsim.recorder.journal.tape import Tape

from ..conftest import Fast, application_of


def taken(journal: Journal) -> JournalRecord:
    """Return what a journal has gathered, as a tape records it."""
    clock = VirtualClock()
    net = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    controller = make_controller(application_of(Fast).setup, network=net, clock=clock)
    data: list[bytes] = []
    tape = Tape(controller, journal, lambda _kind, _time_ns, record: data.append(record))
    tape.take(controller.classes[0])
    return record_of(*data)
