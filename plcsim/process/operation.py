"""Running a controller as its operator asks: pause, single cycles, restart, speed, stop.

Requests come out of the shared image in LATCH and are carried out between two cycles. While the
controller is paused nothing runs, but commands are taken and their effect is shown.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Protocol

from plcsim.core.control import AS_FAST_AS_POSSIBLE, REAL_TIME, Action
from plcsim.core.logbook import Severity
from plcsim.core.system import State

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.control import Request
    from plcsim.core.controller import Controller

POLL_S = 0.02
"""A paused controller looks this often for what it is asked."""


class _Pacer(Protocol):
    """A virtual clock, which can run at a speed."""

    def pace(self, speed: int) -> None:
        """Run at a speed from now on."""


class Operation:
    """Runs a controller that has booted.

    Args:
        controller: to run.
        pacer: its clock, None where that is the real one.
        beat: called while it is paused, so that nobody takes it for dead.
        rest: waits for so many seconds.
    """

    def __init__(
        self,
        controller: Controller,
        *,
        pacer: _Pacer | None = None,
        beat: Callable[[], None] = lambda: None,
        rest: Callable[[float], None] = time.sleep,
    ) -> None:
        self._controller = controller
        self._pacer = pacer
        self._beat = beat
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
            if self._is_paused:
                self._stay(until_ns)
            left = None if last is None else last - first.cycles
            if left == 0 or controller.stop_requested or self._is_over(until_ns):
                return controller.state
            self._run(until_ns, left)
            if controller.state is not State.RUN:
                return controller.state
            if not (controller.requests or self._is_paused):
                return controller.state
            self._carry_out()

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
        """Stay paused until asked for something else."""
        controller = self._controller
        while self._is_paused and not controller.stop_requested and not self._is_over(until_ns):
            self._beat()
            for exchange in controller.image.exchanges:
                exchange()
            self._carry_out()
            if self._is_paused:
                self._rest(POLL_S)
        controller.resume()

    def _carry_out(self) -> None:
        requests = self._controller.requests
        while requests:
            self._do(requests.popleft())

    def _do(self, request: Request) -> None:
        controller = self._controller
        match request.action:
            case Action.STOP:
                controller.stop()
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
        if request.action in (Action.WARM_RESTART, Action.COLD_RESTART):
            controller.shutdown()
            controller.boot()
            controller.start()

    def _pace(self, speed: int) -> str:
        if self._pacer is None:
            return "the real clock has one speed"
        self._pacer.pace(max(0, speed))
        if speed <= AS_FAST_AS_POSSIBLE:
            return "speed: as fast as possible"
        return f"speed: {speed / REAL_TIME:g} times real time"
