"""A Hypothesis state machine that drives a program and checks invariants after every cycle.

::

    class PressMachine(PlcMachine):
        project = Path(__file__).parents[1]
        inputs = ("press.start", "press.door_closed")

        @every_cycle
        def never_moves_with_an_open_door(self):
            assert self.plc["press.door_closed"] or not self.plc["press.motor"]

    TestPress = PressMachine.TestCase
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule

from plcsim.testing.errors import PlcTestError
from plcsim.testing.plc import Plc
from plcsim.testing.strategies import tag_values
from plcsim.testing.target import program_target, project_target

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from plcsim.program.python.program import Program
    from plcsim.project.assembly import Application

__tracebackhide__ = True

F = TypeVar("F", bound="Callable[[Any], object]")

LONGEST_RUN = 20
"""Cycles that one step of the machine runs at most."""


def every_cycle(method: F) -> F:
    """Mark a method of a `PlcMachine` as an invariant: called after every cycle.

    It fails by an assertion, or by answering False.
    """
    method._plc_every_cycle = True  # type: ignore[attr-defined]  # a mark on a function
    return method


class PlcMachine(RuleBasedStateMachine):
    """Writes random values to the inputs of a program and lets it run, in random order.

    Every example runs on a controller of its own. A subclass may add rules and invariants of
    Hypothesis; ``self.plc`` is the controller.

    Attributes:
        project: folder of the project.
        program: a program class instead of a project.
        inputs: tags that are written.
        cycle: cycle time of ``program``.
    """

    project: ClassVar[Path | None] = None
    program: ClassVar[type[Program] | None] = None
    inputs: ClassVar[tuple[str, ...]] = ()
    cycle: ClassVar[str] = "10ms"

    def __init__(self) -> None:
        super().__init__()
        self._target = self._load()
        self.plc = Plc(self._target)
        for name in dir(type(self)):
            if getattr(getattr(type(self), name), "_plc_every_cycle", False):
                self.plc.always(_named(name, getattr(self, name)))

    def _load(self) -> Application:
        if self.program is not None:
            return program_target([self.program], self.cycle)
        if self.project is None:
            raise PlcTestError(f"{type(self).__name__} needs a project or a program")
        return project_target(self.project)

    def teardown(self) -> None:
        """Run the EXITs."""
        self.plc.close()
        self._target.unload()

    @initialize()
    def boot(self) -> None:
        """Run the INITs."""
        self.plc.boot()

    @rule(data=st.data())
    def write(self, data: st.DataObject) -> None:
        """Write a value to one of the inputs."""
        if self.inputs:
            path = data.draw(st.sampled_from(self.inputs), label="tag")
            self.plc[path] = data.draw(tag_values(self.plc, path), label=path)

    @rule(count=st.integers(1, LONGEST_RUN))
    def cycles(self, count: int) -> None:
        """Run some cycles."""
        self.plc.cycles(count)


def _named(name: str, method: Callable[[], object]) -> Callable[[], object]:
    """Return a condition that holds unless the method raises or answers False."""
    check: Any = partial(_holds, method)
    check.__name__ = name
    condition: Callable[[], object] = check
    return condition


def _holds(method: Callable[[], object]) -> bool:
    return method() is not False
