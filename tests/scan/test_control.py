"""A run that is written, forced and controlled by another process, as the command line does it."""

import os
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from plcsim.core.control import Action
from plcsim.process.run_file import find_run
from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from plcsim.shared_image import (
    Command,
    CommandOutcome,
    Control,
    ForceCommand,
    ImageReader,
    Release,
    StoreCommand,
    Write,
)
from plcsim.shared_image.guest import guest

PROGRAM = """
from plcsim import Program
from st_types import UDINT, UINT, var

class Main(Program):
    count = var(UDINT)
    wanted = var(UINT)
    seen = var(UINT)

    def cyclic(self):
        self.count += 1
        self.seen = self.wanted
"""

MANY = 1_000_000
"""More cycles than a test takes."""

Scenario = Iterator[Callable[[], bool]]


class Guest:
    """A process beside the run, in the same process here."""

    def __init__(self, supervisor: Supervisor, reader: ImageReader) -> None:
        self.supervisor = supervisor
        self.reader = reader

    def value(self, name: str) -> int:
        tag = self.reader.directory.find(f"main.{name}")
        place = self.reader.directory.offset_of(tag.address, tag.data_type.size)
        return int.from_bytes(self.reader.copy(place, place + tag.data_type.size)[1], "little")

    def address(self, name: str) -> int:
        return self.reader.directory.find(f"main.{name}").address

    def done(self, command: Command) -> Callable[[], bool]:
        ticket = self.reader.send(command)
        return lambda: self.reader.outcome(ticket) is CommandOutcome.APPLIED

    @property
    def cycles(self) -> int:
        return self.supervisor.page.of_class(1).cycles


@pytest.fixture
def play(project_of):
    """``play(scenario)``: run a project; the scenario yields conditions that are waited for."""

    def play(scenario: Callable[[Guest], Scenario], **options: Any) -> dict[str, Any]:
        folder = project_of(PROGRAM, plc='realtime = "off"')
        project = read_project(folder)
        with Supervisor(project, quiet=True, **options) as supervisor:
            steps: Scenario | None = None
            condition: Callable[[], bool] = lambda: True  # noqa: E731
            stack: list[Any] = []

            def look() -> None:
                nonlocal steps, condition
                if steps is None:
                    image = supervisor.services.image
                    if image is None or not image.latest:
                        return
                    run = find_run(folder)
                    stack.append(guest(f"/proc/{run.pid}/fd/{run.image_fd}"))
                    steps = scenario(Guest(supervisor, stack[0].__enter__()))
                while condition():
                    try:
                        condition = next(steps)
                    except StopIteration:
                        condition = lambda: False  # noqa: E731
                        supervisor.stop()

            result = supervisor.wait(look)
            for each in stack:
                each.__exit__(None, None, None)
            return result

    return play


def waits(count: int) -> Callable[[], bool]:
    """Return a condition that holds at the ``count``-th look."""
    looks = iter(range(count))
    return lambda: next(looks, None) is None


@pytest.mark.parametrize("virtual", [False, True])
def test_a_run_is_paused_stepped_and_continued_from_another_process(play, virtual) -> None:
    seen: list[int] = []

    def scenario(g: Guest) -> Scenario:
        yield lambda: g.cycles >= 3
        yield g.done(Control(Action.PAUSE))
        yield waits(3)
        before = g.cycles
        yield waits(10)
        seen.append(g.cycles - before)
        yield g.done(Write((StoreCommand(g.address("wanted"), b"\x2a\0"),)))
        seen.append(g.value("wanted"))
        seen.append(g.value("seen"))
        yield g.done(Control(Action.CYCLES, 2))
        yield lambda: g.cycles == before + 2
        yield waits(5)
        seen.append(g.cycles - before)
        seen.append(g.value("seen"))
        yield g.done(Control(Action.CONTINUE))
        yield lambda: g.cycles > before + 5
        g.reader.send(Control(Action.STOP))
        yield lambda: False

    result = play(scenario, virtual=virtual)
    assert seen == [0, 42, 0, 2, 42]
    assert result["state"] == "STOPPED"
    assert not (virtual and result["task_classes"][0]["missed_grid_points"])
    texts = [e["text"] for e in result["logbook"] if e["source"] == "plcsim"]
    assert texts == ["pause", "2 cycles", "continue", "stop"]


def test_a_pause_on_the_real_clock_misses_no_grid_points(play) -> None:
    """The host may cost some beside: among several pauses one has to be as good as none."""
    costs: list[int] = []

    def scenario(g: Guest) -> Scenario:
        yield lambda: g.cycles >= 3
        while not costs or (costs[-1] > 3 and len(costs) < 20):
            before = g.supervisor.page.of_class(1).missed
            yield g.done(Control(Action.PAUSE))
            yield waits(13)  # at least 25 grid points
            yield g.done(Control(Action.CONTINUE))
            paused = g.cycles
            yield lambda paused=paused: g.cycles > paused + 5
            costs.append(g.supervisor.page.of_class(1).missed - before)

    assert play(scenario)["state"] == "STOPPED"
    assert costs[-1] <= 3


def test_the_watchdog_leaves_a_paused_run_alone(play, monkeypatch) -> None:
    def scenario(g: Guest) -> Scenario:
        yield g.done(Control(Action.PAUSE))
        yield waits(100)  # 2 s; init_timeout and watchdog are far shorter
        yield g.done(Control(Action.CONTINUE))

    from plcsim.process import watchdog

    monkeypatch.setattr(watchdog, "PATIENCE_NS", 200_000_000)
    result = play(scenario)
    assert result["state"] == "STOPPED"
    assert result["fault"] is None


def test_a_restart_keeps_the_process_and_its_services(play) -> None:
    pids: list[int] = []

    def scenario(g: Guest) -> Scenario:
        yield lambda: g.value("count") > 5
        pids.append(g.supervisor._process.pid)
        yield g.done(ForceCommand("main.wanted", b"\x07\0"))
        yield g.done(Write((StoreCommand(g.address("count"), MANY.to_bytes(4, "little")),)))
        yield lambda: g.value("count") >= MANY
        restart = g.done(Control(Action.WARM_RESTART))
        yield lambda: restart() and g.value("count") < MANY and g.value("seen") == 7
        pids.append(g.supervisor._process.pid)
        yield g.done(Release("main.wanted"))

    result = play(scenario)
    assert pids[0] == pids[1]
    states = [e["text"].partition(":")[0] for e in result["logbook"] if e["source"] == "system"]
    assert states == ["RUN", "STOPPED", "BOOT", "RUN", "STOPPED"]


def test_virtual_time_can_be_made_as_slow_as_real_time(play) -> None:
    """The host may be late, but nothing makes it faster."""
    slow: list[int] = []

    def scenario(g: Guest) -> Scenario:
        start_ns = time.monotonic_ns()

        def due() -> int:
            """Return how many cycles of 10 ms the real time since then has."""
            return (time.monotonic_ns() - start_ns) // 10_000_000

        yield g.done(Control(Action.SPEED, 1_000_000))
        before = g.cycles
        yield lambda: g.cycles >= before + 20
        slow.extend((g.cycles - before, due()))
        yield g.done(Control(Action.SPEED, 0))
        before, start_ns = g.cycles, time.monotonic_ns()
        yield lambda: g.cycles - before > 10 * max(20, due())

    assert play(scenario, virtual=True)["state"] == "STOPPED"
    cycles, due = slow
    assert cycles <= due + 1


def test_the_logbook_of_a_scan_process_that_was_killed_is_in_the_report(play) -> None:
    def scenario(g: Guest) -> Scenario:
        yield g.done(ForceCommand("main.wanted", b"\x07\0"))
        os.kill(g.supervisor._process.pid, 9)
        yield lambda: False

    result = play(scenario)
    assert result["state"] == "SERVICE"
    texts = [e["text"] for e in result["logbook"]]
    assert "main.wanted is forced to 7" in texts
    assert "the scan process ended with SIGKILL" in texts[-1]
    assert result["logbook_dropped"] == 0
