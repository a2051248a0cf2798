"""Requests of the operator, carried out between two cycles."""

from collections.abc import Callable, Iterator

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.control import REAL_TIME, Action, Request
from plcsim.core.controller import Controller
from plcsim.core.system import State
from plcsim.process.operation import Operation
from st_types import UINT, var

MS = 1_000_000


@pytest.fixture
def controller(make_controller, task_class, program_of) -> Controller:
    def cyclic(program) -> None:
        program.cycles += 1

    def leave(program) -> None:
        program.exits += 1

    program = program_of(cyclic, cycles=var(UINT), exits=var(UINT, 0), exit=leave)
    made = make_controller(task_class(1, 10, main=program), task_class(2, 50, slow=program))
    made.boot()
    return made


def value(controller: Controller, path: str) -> object:
    return controller.tags.read(controller.tags.find(path))


class Script:
    """What is asked for: after so many cycles of class 1, and at each look while paused."""

    def __init__(self, controller: Controller) -> None:
        self.controller = controller
        self.at_cycle: dict[int, Request] = {}
        self.while_paused: Iterator[Request | None] = iter(())
        self.looks: list[int] = []
        self.beats = 0
        controller.image.watchers.append(self._published)
        controller.image.exchanges.append(self._exchanged)

    def _published(self, task_class: object) -> None:
        request = self.at_cycle.pop(self.controller.classes[0].cycles, None)
        if request is not None:
            self.controller.request(request)

    def _exchanged(self) -> None:
        self.looks.append(self.controller.classes[0].cycles)
        request = next(self.while_paused, Request(Action.STOP))
        if request is not None:
            self.controller.request(request)

    def beat(self) -> None:
        self.beats += 1

    def operation(self, rest: Callable[[float], None] = lambda _: None) -> Operation:
        return Operation(self.controller, beat=self.beat, rest=rest)


@pytest.fixture
def script(controller: Controller) -> Script:
    return Script(controller)


def texts(controller: Controller) -> list[str]:
    return [f"{e.source}: {e.text}" for e in controller.logbook if e.source == "web"]


def test_without_requests_it_is_a_run(controller, script) -> None:
    assert script.operation().run(cycles=7) is State.RUN
    assert value(controller, "main.cycles") == 7
    start_ns = controller.clock.now_ns()
    script.operation().run(until_ns=start_ns + 30 * MS)
    assert value(controller, "main.cycles") == 9


def test_a_pause_holds_all_classes_and_values_are_exchanged_meanwhile(controller, script) -> None:
    script.at_cycle = {3: Request(Action.PAUSE, 0, "web")}
    script.while_paused = iter([None, None, Request(Action.CONTINUE, 0, "web"), None])
    script.operation().run(cycles=8)
    assert script.looks == [3, 3, 3]
    assert script.beats == 3
    assert value(controller, "main.cycles") == 8
    assert texts(controller) == ["web: pause", "web: continue"]


def test_single_cycles(controller, script) -> None:
    script.at_cycle = {2: Request(Action.PAUSE)}
    script.while_paused = iter(
        [Request(Action.CYCLES, 1), None, Request(Action.CYCLES, 3), Request(Action.STOP)]
    )
    assert script.operation().run() is State.RUN
    assert script.looks == [2, 3, 3, 6]
    assert value(controller, "main.cycles") == 6
    assert controller.stop_requested


def test_single_cycles_while_it_runs_end_in_a_pause(controller, script) -> None:
    script.at_cycle = {5: Request(Action.CYCLES, 2)}
    script.while_paused = iter([Request(Action.STOP)])
    script.operation().run()
    assert script.looks == [7]


def test_a_pause_ends_single_cycles(controller, script) -> None:
    script.at_cycle = {1: Request(Action.CYCLES, 100), 4: Request(Action.PAUSE)}
    script.while_paused = iter([Request(Action.CONTINUE)])
    script.operation().run(cycles=200)
    assert script.looks == [4]
    assert value(controller, "main.cycles") == 200


def test_a_stop_ends_the_run_and_no_limit_is_needed(controller, script) -> None:
    script.at_cycle = {4: Request(Action.STOP, 0, "web")}
    script.operation().run()
    assert value(controller, "main.cycles") == 4
    controller.shutdown()
    assert controller.state is State.STOPPED


@pytest.mark.parametrize("action", [Action.WARM_RESTART, Action.COLD_RESTART])
def test_a_restart_runs_exits_and_inits_without_ending_the_run(controller, script, action) -> None:
    script.at_cycle = {5: Request(action, 0, "web")}
    script.operation().run(cycles=8)
    assert value(controller, "main.cycles") == 3
    assert value(controller, "main.exits") == 0
    assert texts(controller) == [f"web: {action.name.lower().replace('_', ' ')}"]
    states = [e.text.partition(":")[0] for e in controller.logbook if e.source == "system"]
    assert states == ["RUN", "STOPPED", "BOOT", "RUN"]


def test_a_restart_that_fails_ends_in_service(make_controller, task_class, program_of) -> None:
    starts: list[int] = []

    def init(_: object) -> None:
        starts.append(1)
        if len(starts) == 2:
            raise RuntimeError("not again")

    controller = make_controller(task_class(1, 10, main=program_of(init=init)))
    controller.boot()
    script = Script(controller)
    script.at_cycle = {2: Request(Action.WARM_RESTART)}
    assert script.operation().run() is State.SERVICE


def test_a_signal_ends_a_pause(controller, script) -> None:
    script.at_cycle = {2: Request(Action.PAUSE)}
    script.while_paused = iter([None] * 100)

    def rest(_: float) -> None:
        if len(script.looks) == 3:
            controller.stop()

    script.operation(rest).run()
    assert len(script.looks) == 3


def test_a_time_that_has_come_ends_a_pause(controller, script, clock) -> None:
    script.at_cycle = {2: Request(Action.PAUSE)}
    script.while_paused = iter([None] * 100)
    until_ns = clock.now_ns() + 100 * MS

    def rest(seconds: float) -> None:
        clock.stall_ns(int(seconds * 1e9))  # as the real clock goes on

    script.operation(rest).run(until_ns=until_ns)
    assert 100 * MS - 25 * MS <= 20 * MS * len(script.looks) <= 100 * MS


def test_after_a_pause_on_a_clock_that_went_on_no_grid_point_is_missed(
    controller, script, clock
) -> None:
    script.at_cycle = {2: Request(Action.PAUSE)}
    script.while_paused = iter([None, None, Request(Action.CONTINUE)])
    releases: list[int] = []
    origin_ns = clock.now_ns()
    controller.image.inputs.append(
        lambda c: releases.append(c.release_ns - origin_ns) if c.number == 1 else None
    )
    script.operation(lambda _: clock.stall_ns(33 * MS)).run(cycles=4)
    assert [ns // MS for ns in releases] == [5, 15, 85, 95]
    assert [c.missed for c in controller.classes] == [0, 0]


def test_the_speed_is_that_of_the_virtual_clock(controller, script) -> None:
    speeds: list[int] = []

    class Pacer(VirtualClock):
        def pace(self, speed: int) -> None:
            speeds.append(speed)

    script.at_cycle = {
        1: Request(Action.SPEED, REAL_TIME // 10, "web"),
        2: Request(Action.SPEED, 0, "web"),
        3: Request(Action.SPEED, -5, "web"),
    }
    Operation(controller, pacer=Pacer()).run(cycles=4)
    assert speeds == [REAL_TIME // 10, 0, 0]
    script.at_cycle = {5: Request(Action.SPEED, REAL_TIME, "web")}
    Operation(controller).run(cycles=4)
    assert texts(controller) == [
        "web: speed: 0.1 times real time",
        "web: speed: as fast as possible",
        "web: speed: as fast as possible",
        "web: the real clock has one speed",
    ]


def test_a_run_that_stays_is_stopped_and_started_again(controller, script) -> None:
    shown: list[bool] = []
    script.at_cycle = {4: Request(Action.STOP, 0, "web")}
    script.while_paused = iter(
        [
            None,
            Request(Action.CONTINUE, 0, "web"),
            Request(Action.STOP, 0, "web"),
            Request(Action.WARM_RESTART, 0, "web"),
        ]
    )
    operation = Operation(
        controller,
        stays=True,
        beat=script.beat,
        show_paused=shown.append,
        rest=lambda _: None,
    )
    assert operation.run(cycles=10) is State.RUN
    assert script.looks == [4, 4, 4, 4]
    assert value(controller, "main.cycles") == 6  # begun again
    assert texts(controller) == [
        "web: stop",
        "web: continue: not in STOPPED",
        "web: stop: not in STOPPED",
        "web: warm restart",
    ]
    states = [e.text.partition(":")[0] for e in controller.logbook if e.source == "system"]
    assert states == ["RUN", "STOPPED", "BOOT", "RUN"]
    assert shown == [False, False]


def test_a_run_that_stays_leaves_service_by_a_restart(
    make_controller, task_class, program_of
) -> None:
    def cyclic(program) -> None:
        program.cycles += 1
        if program.cycles == 3:
            raise RuntimeError("as told")

    controller = make_controller(task_class(1, 10, main=program_of(cyclic, cycles=var(UINT))))
    controller.boot()
    script = Script(controller)
    script.while_paused = iter([None, Request(Action.COLD_RESTART), Request(Action.COLD_RESTART)])
    operation = Operation(controller, stays=True, beat=script.beat, rest=lambda _: None)
    assert operation.run(cycles=8) is State.RUN
    assert script.looks == [3, 3, 6]
    assert value(controller, "main.cycles") == 2


def test_a_signal_ends_a_run_that_stays_in_service(make_controller, task_class, program_of) -> None:
    def cyclic(_program) -> None:
        raise RuntimeError("as told")

    controller = make_controller(task_class(1, 10, main=program_of(cyclic)))
    controller.boot()
    operation = Operation(controller, stays=True, rest=lambda _: controller.stop())
    assert operation.run() is State.SERVICE


def test_a_pause_is_shown(controller, script) -> None:
    shown: list[bool] = []
    script.at_cycle = {2: Request(Action.PAUSE)}
    script.while_paused = iter([Request(Action.CONTINUE)])
    operation = Operation(controller, show_paused=shown.append, rest=lambda _: None)
    operation.run(cycles=4)
    assert shown == [True, False]
