from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any, ClassVar

import pytest

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.core.task import Policy
from plcsim.recorder.bag.diagnostics import ClassDiagnostics, DiagnosticLevel
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.types import DIAGNOSTICS, typestore
from plcsim.recorder.bag.writing import Limits, Writing
from plcsim.recorder.journal.record import ClassTiming
from plcsim.recorder.replay.replay import Replay
from st_types import UDINT, var

from ..conftest import Fast, Recordings, Slow, application_of

FIRST = ClassTiming(1, 1, 0, 0, 0, 0, 0, is_service=False)


class Heavy(Program):
    """Takes 1 us of CPU time in its first cycle, 2 us in its second, and so on."""

    count = var(UDINT)
    clock: ClassVar[VirtualClock]

    def cyclic(self) -> None:
        self.count += 1
        self.clock.spend_ns(1_000 * self.count)


def statuses(bag: Path) -> list[Any]:
    """Return the statuses in a bag, as rosbags reads them."""
    is_ros2 = bag.suffix != ".bag"
    store = typestore(ros2=is_ros2)
    decode = store.deserialize_cdr if is_ros2 else store.deserialize_ros1
    with open_bag(bag) as reader:
        found = [(m.type_name, m.time_ns, m.data) for m in reader.messages([DIAGNOSTICS])]
    messages: list[Any] = [decode(data, name) for name, _, data in found]
    for message, (_, time_ns, _) in zip(messages, found, strict=True):
        assert message.header.stamp.sec * 1_000_000_000 + message.header.stamp.nanosec == time_ns
    return [status for message in messages for status in message.status]


def values_of(status: Any) -> dict[str, str]:
    return {each.key: each.value for each in status.values}


@pytest.mark.parametrize("file", ["a.bag", "a.mcap", "a.db3"])
def test_each_class_is_told_once_a_second_and_at_the_end(recordings: Recordings, file: str) -> None:
    found = statuses(recordings(file, application_of(Fast, Slow), cycles=125))

    fast = [each for each in found if each.name == "task class #1"]
    slow = [each for each in found if each.name == "task class #2"]
    assert len(fast) + len(slow) == len(found)
    assert [int(values_of(each)["cycles"]) for each in fast] == [101, 201, 250]
    assert [int(values_of(each)["cycles"]) for each in slow] == [51, 101, 125]
    assert [each.message for each in slow[-2:]] == ["20 ms, 101 cycles", "20 ms, 125 cycles"]
    assert {each.hardware_id for each in found} == {recordings.folder.name}
    assert {each.level for each in found} == {DiagnosticLevel.OK}


def test_the_type_in_a_ros_1_bag_is_that_of_ros(recordings: Recordings) -> None:
    with open_bag(recordings("a.bag", application_of(Fast))) as reader:
        (topic,) = [each for each in reader.topics if each.name == DIAGNOSTICS]

    assert topic.type_name == "diagnostic_msgs/msg/DiagnosticArray"
    assert topic.digest == "60810da900de1dd6ddd437c3503511da"


def test_percentiles_are_those_since_the_last_message(recordings: Recordings) -> None:
    Heavy.clock = VirtualClock()
    found = statuses(recordings("a.bag", application_of(Heavy), cycles=101, clock=Heavy.clock))

    first, second, _ = map(values_of, found)  # in PUBLISH a cycle's own time is not over
    assert first["execution p50 (us)"] == "50.000"
    assert first["execution p99 (us)"] == "99.000"
    assert first["execution max (us)"] == "100.000"
    assert second["execution p50 (us)"] == "150.000"
    assert second["execution max (us)"] == "200.000"
    assert first["lateness max (us)"] == second["lateness max (us)"] == "0.000"


def test_the_last_cycle_counts(recordings: Recordings) -> None:
    Heavy.clock = VirtualClock()
    (last,) = statuses(recordings("a.bag", application_of(Heavy), cycles=10, clock=Heavy.clock))

    assert values_of(last)["execution max (us)"] == "20.000"
    assert values_of(last)["execution p50 (us)"] == "10.000"


def overloaded(policy: Policy) -> Any:
    """Return a controller whose program stops for 35 ms in cycle 50, of 10 ms each."""

    class Stops(Program):
        count = var(UDINT)

        def cyclic(self) -> None:
            self.count += 1
            if self.count == 50:
                Heavy.clock.spend_ns(35_000_000)

    application = application_of(Stops)
    classes = [replace(each, policy=policy) for each in application.setup.classes]
    return replace(application, setup=replace(application.setup, classes=classes))


def test_a_violation_and_missed_grid_points_are_a_warning_once(recordings: Recordings) -> None:
    Heavy.clock = VirtualClock()
    bag = recordings("a.bag", overloaded(Policy.LOG), cycles=125, clock=Heavy.clock)

    first, second, last = statuses(bag)
    assert [each.level for each in (first, second, last)] == [1, 0, 0]
    assert first.message == (
        "10 ms, 98 cycles; since the last message 1 cycle time violation, 3 missed grid points"
    )
    assert values_of(last)["cycle time violations"] == "1"
    assert values_of(last)["missed grid points"] == "3"
    assert values_of(first)["execution max (us)"] == "35000.000"


def test_service_by_a_violation_is_an_error_at_the_end(recordings: Recordings) -> None:
    Heavy.clock = VirtualClock()
    bag = recordings("a.bag", overloaded(Policy.SERVICE), cycles=125, clock=Heavy.clock)

    (last,) = statuses(bag)
    assert last.level == DiagnosticLevel.ERROR
    assert last.message.startswith("controller in SERVICE; 10 ms, 50 cycles")
    assert values_of(last)["execution max (us)"] == "35000.000"


def test_service_by_a_program_is_an_error_in_its_cycle(recordings: Recordings) -> None:
    class Fails(Program):
        count = var(UDINT)

        def cyclic(self) -> None:
            self.count += 1
            if self.count == 7:
                raise ValueError("broken")

    bag = recordings("a.bag", application_of(Fails))

    with open_bag(bag) as reader:
        times = [each.time_ns for each in reader.messages([DIAGNOSTICS])]
        failing = [r.time_ns for _, r in reader.records() if r.cycle == 7]
    assert times[0] == failing[0]
    assert [each.level for each in statuses(bag)] == [DiagnosticLevel.ERROR] * 2


@pytest.mark.parametrize("suffix", [".bag", ".mcap"])
def test_two_runs_make_the_same_file_that_is_repeated_exactly(
    recordings: Recordings, suffix: str
) -> None:
    application = application_of(Fast, Slow)
    bags = [recordings(f"{name}/run{suffix}", application, cycles=150) for name in "ab"]

    assert len({sha256(bag.read_bytes()).hexdigest() for bag in bags}) == 1
    assert statuses(bags[0]) == statuses(bags[1])
    with open_bag(bags[0]) as reader:
        assert sum(t.messages for t in reader.topics if t.name == DIAGNOSTICS) == 5
        again = Replay(application, reader.head(), reader.records())
        assert again.run() is None
    assert again.cycles == 450


def test_a_class_without_timing_is_not_told(recordings: Recordings) -> None:
    """As in a bag that is written from the records of another, which have none."""
    with open_bag(recordings("a.bag", application_of(Fast), cycles=125)) as reader:
        head, records = reader.head(), list(reader.records())
    writing = Writing(recordings.folder / "b.bag", head, Limits())
    for number, record in records:
        writing.record(number, record)
    writing.close()

    assert statuses(recordings.folder / "b.bag") == []


@pytest.mark.parametrize(
    ("change", "level", "text"),
    [
        ({}, DiagnosticLevel.OK, "1 ms, 60,000 cycles"),
        (
            {"missed": 2},
            DiagnosticLevel.WARN,
            "1 ms, 60,000 cycles; since the last message 2 missed grid points",
        ),
        (
            {"violations": 1_234},
            DiagnosticLevel.WARN,
            "1 ms, 60,000 cycles; since the last message 1,234 cycle time violations",
        ),
        (
            {"is_service": True},
            DiagnosticLevel.ERROR,
            "controller in SERVICE; 1 ms, 60,000 cycles",
        ),
        (
            {"is_service": True, "missed": 1},
            DiagnosticLevel.ERROR,
            (
                "controller in SERVICE; 1 ms, 60,000 cycles; since the last message "
                "1 missed grid point"
            ),
        ),
    ],
)
def test_levels(change: dict[str, Any], level: DiagnosticLevel, text: str) -> None:
    told = ClassDiagnostics(1_000_000, "cell", FIRST, 0)
    told.take(FIRST)
    told.take(FIRST._replace(cycles=60_000, **change))

    status = told.tell(0)

    assert (status.level, status.message) == (level, text)


def test_what_was_before_the_recorder_came_is_no_warning() -> None:
    timing = FIRST._replace(cycles=900, executed=899, missed=7, violations=5)
    told = ClassDiagnostics(1_000_000, "cell", timing, 0)
    told.take(timing)

    status = told.tell(0)

    assert status.level == DiagnosticLevel.OK
    assert dict(status.values)["missed grid points"] == "7"


def test_nothing_is_said_of_durations_where_there_were_none() -> None:
    told = ClassDiagnostics(1_000_000, "cell", FIRST, 0)
    told.take(FIRST)
    told.tell(0)

    assert [key for key, _ in told.tell(1).values] == [
        "cycles", "missed grid points", "cycle time violations",
    ]  # fmt: skip
