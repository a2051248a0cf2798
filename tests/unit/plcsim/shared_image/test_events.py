"""What happens, as other processes see it: the logbook and violations, in order."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim import Program
from plcsim.core.logbook import Entry, Severity
from plcsim.core.task import Cause, Policy, Violation
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, TaskClassSetup
from plcsim.shared_image import ImageReader
from plcsim.shared_image.events import (
    EventKind,
    encode_entry,
    encode_violation,
    entry_of,
    violation_of,
)
from plcsim.shared_image.stream import StreamRecord

from .conftest import MS, Make, World

times = st.integers(-(2**62), 2**62)
texts = st.text(st.characters(exclude_categories=["Cs"]), max_size=40)


@given(st.builds(Entry, times, st.sampled_from(Severity), texts, texts))
def test_an_entry_survives_its_record(entry: Entry) -> None:
    assert (
        entry_of(StreamRecord(EventKind.ENTRY.value, 0, entry.time_ns, encode_entry(entry)))
        == entry
    )


@given(
    st.builds(
        Violation, st.integers(1, 8), texts, st.integers(0, 2**40), st.sampled_from(Cause),
        *[times] * 6, texts,
    )
)  # fmt: skip
def test_a_violation_survives_its_record(violation: Violation) -> None:
    record = StreamRecord(EventKind.VIOLATION.value, 0, 1, encode_violation(violation))
    assert violation_of(record) == violation


def test_text_that_is_none_does_not_stop_the_scan() -> None:
    data = encode_entry(Entry(0, Severity.ERROR, "p", "a \ud800 b"))
    assert entry_of(StreamRecord(1, 0, 0, data)).text == "a ? b"


class Late(Program):
    def cyclic(self) -> None:
        self.context.memory.clock.spend_ns(5 * MS)  # type: ignore[attr-defined]  # set by the test


@pytest.fixture
def late(make: Make) -> World:
    world = make(TaskClassSetup(1, MS, [ProgramSetup("late", PythonCode(Late))], policy=Policy.LOG))
    world.controller.memory.clock = world.clock  # type: ignore[attr-defined]
    return world


def test_everything_since_the_boot_can_be_read_and_what_is_new(late: World) -> None:
    live = late.reader.events()
    late.controller.run(cycles=1)
    late.controller.shutdown()
    everything = ImageReader(late.fd).events(from_oldest=True).read()
    assert everything[-3:] == live.read()
    entries = [entry_of(r) for r in everything if r.kind == EventKind.ENTRY.value]
    assert entries == list(late.controller.logbook)
    violations = [violation_of(r) for r in everything if r.kind == EventKind.VIOLATION.value]
    assert violations == late.controller.violations
    assert [r.kind for r in everything[-3:]] == [
        EventKind.VIOLATION.value, EventKind.ENTRY.value, EventKind.ENTRY.value,
    ]  # fmt: skip
    assert live.lost == 0


def test_entries_that_nobody_reads_make_room_for_later_ones(world: World) -> None:
    reader = world.reader.events()
    for number in range(20_000):
        world.controller.log(Severity.WARNING, "test", f"entry {number}")
    found = [entry_of(record).text for record in reader.read(50_000)]
    assert found[-1] == "entry 19999"
    assert len(found) + reader.lost == 20_000
    assert len(found) > 2000
