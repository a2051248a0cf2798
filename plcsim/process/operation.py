"""Running a controller as its operator asks: pause, single cycles, restart, speed, stop.

Requests come out of the shared image in LATCH and are carried out between two cycles. While the
controller is paused nothing runs, but commands are taken and their effect is shown. Where the run
stays, so it is in STOPPED and SERVICE too, until a restart is asked for or the run is ended.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final, Protocol

from plcsim.core.control import AS_FAST_AS_POSSIBLE, REAL_TIME, Action
from plcsim.core.logbook import Severity
from plcsim.core.system import State

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.control import Request
    from plcsim.core.controller import Controller

POLL_S = 0.02
"""A paused controller looks this often for what it is asked."""


_RESTARTS: Final = (Action.WARM_RESTART, Action.COLD_RESTART)


class _Pacer(Protocol):
    """A virtual clock, which can run at a speed."""

    def pace(self, speed: int) -> None:
        """Run at a speed from now on."""


class Operation:
    """Runs a controller that has booted.

    Args:
        controller: to run.
        pacer: its clock, None where that is the real one.
        stays: STOPPED and SERVICE do not end the run.
        beat: called while nothing runs, so that nobody takes it for dead.
        show_paused: told whether it is paused, whenever that changes.
        rest: waits for so many seconds.
    """

    def __init__(
        self,
        controller: Controller,
        *,
        pacer: _Pacer | None = None,
        stays: bool = False,
        beat: Callable[[], None] = lambda: None,
        show_paused: Callable[[bool], None] = lambda _is_paused: None,
        rest: Callable[[float], None] = time.sleep,
    ) -> None:
        self._controller = controller
        self._pacer = pacer
        self._stays = stays
        self._beat = beat
        self._show_paused = show_paused
        self._rest = rest
        self._is_paused = False
        self._steps = 0

    def run(self, until_ns: int | None = None, cycles: int | None = None) -> State:
        """Run until the controller stops or fails, until a time, or for so many cycles.

        Args:
            until_ns: of the controller's clock; a pause does not put it off.
            cycles: of the class with the lowest number.
        """
        controller = self._controller
        first = controller.classes[0]
        last = None if cycles is None else first.cycles + cycles
        while True:
            if self._is_paused or self._is_down:
                self._stay(until_ns)
            left = None if last is None else last - first.cycles
            if left == 0 or controller.stop_requested or self._is_over(until_ns):
                return controller.state
            self._run(until_ns, left)
            if self._is_down:
                continue
            if controller.state is not State.RUN:
                return controller.state
            if not (controller.requests or self._is_paused):
                return controller.state
            self._carry_out()

    @property
    def _is_down(self) -> bool:
        """Nothing runs before a restart, and the run waits for one."""
        return self._stays and self._controller.state in (State.STOPPED, State.SERVICE)

    def _run(self, until_ns: int | None, left: int | None) -> None:
        """Run on, or only the single cycles that were asked for."""
        controller = self._controller
        if not self._steps:
            controller.run(until_ns, left)
            return
        before = controller.classes[0].cycles
        steps = self._steps if left is None else min(self._steps, left)
        controller.run(until_ns, steps)
        self._steps -= controller.classes[0].cycles - before
        if self._steps <= 0 or not controller.requests:
            self._steps, self._is_paused = 0, True

    def _is_over(self, until_ns: int | None) -> bool:
        return until_ns is not None and self._controller.clock.stamp_ns() >= until_ns

    def _stay(self, until_ns: int | None) -> None:
        """Stay as it is until asked for something else."""
        controller = self._controller
        self._show_paused(self._is_paused and not self._is_down)
        while (
            (self._is_paused or self._is_down)
            and not controller.stop_requested
            and not self._is_over(until_ns)
        ):
            self._beat()
            for exchange in controller.image.exchanges:
                exchange()
            self._carry_out()
            if self._is_paused or self._is_down:
                self._rest(POLL_S)
        self._show_paused(False)  # noqa: FBT003  # a callable of one argument
        controller.resume()

    def _carry_out(self) -> None:
        requests = self._controller.requests
        while requests:
            self._do(requests.popleft())

    def _do(self, request: Request) -> None:
        controller = self._controller
        if self._is_down and request.action not in _RESTARTS:
            name, state = request.action.name.lower(), controller.state.name
            controller.log(Severity.INFORMATION, request.source, f"{name}: not in {state}")
            return
        match request.action:
            case Action.STOP:
                text = "stop"
            case Action.PAUSE:
                self._is_paused, self._steps = True, 0
                text = "pause"
            case Action.CONTINUE:
                self._is_paused, self._steps = False, 0
                text = "continue"
            case Action.CYCLES:
                self._is_paused, self._steps = False, max(1, request.argument)
                text = f"{self._steps} cycles"
            case Action.WARM_RESTART | Action.COLD_RESTART:
                text = "warm restart" if request.action is Action.WARM_RESTART else "cold restart"
            case Action.SPEED:
                text = self._pace(request.argument)
        controller.log(Severity.INFORMATION, request.source, text)
        if request.action is Action.STOP:
            self._stop()
        elif request.action in _RESTARTS:
            controller.shutdown()
            controller.boot(cold=request.action is Action.COLD_RESTART)
            controller.start()

    def _stop(self) -> None:
        """End the run, or only the programs where the run stays."""
        if not self._stays:
            self._controller.stop()
            return
        self._is_paused, self._steps = False, 0
        self._controller.shutdown()

    def _pace(self, speed: int) -> str:
        if self._pacer is None:
            return "the real clock has one speed"
        self._pacer.pace(max(0, speed))
        if speed <= AS_FAST_AS_POSSIBLE:
            return "speed: as fast as possible"
        return f"speed: {speed / REAL_TIME:g} times real time"
