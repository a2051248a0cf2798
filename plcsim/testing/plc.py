"""The controller under test: what the fixture ``plc`` is."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from random import Random
from typing import TYPE_CHECKING, Any, NoReturn

from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ProgramError
from plcsim.core.logbook import Severity
from plcsim.core.system import State
from plcsim.network import OsNetwork, VirtualNetwork
from plcsim.project.assembly import assemble
from plcsim.testing.bools import check_bools
from plcsim.testing.condition import Condition
from plcsim.testing.costs import Costs, garbage_held
from plcsim.testing.errors import ControllerFault, ExpectationFailed, PlantError, PlcTestError
from plcsim.testing.expectations import Expectations
from plcsim.testing.history import History
from plcsim.testing.image import SharedImage
from plcsim.testing.instructions import exceeded
from plcsim.testing.interleavings import Interleaving, interleavings
from plcsim.testing.tags import Tags
from plcsim.testing.times import duration_ns
from plcsim.testing.trace import Trace
from plcsim.testing.wall_clock import WallClock
from plcsim.testing.watchdog import watchdog
from plcsim.testing.winding import Winding
from plcsim.testing.world import CONTROLLER_IP, World

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from plcsim.core.task import TaskClass
    from plcsim.network import Network
    from plcsim.project.assembly import Application
from plcsim.testing.condition import Given

__tracebackhide__ = True

MOST_TAGS = 8
"""Tags shown of a failure at most."""


class Plc(World, Expectations):
    """A controller with its programs, on a clock that the test moves.

    Tags are read and written as ``plc["program.variable"]``. Time moves only in `run`, `cycles`,
    `until` and the assertions.

    Args:
        application: what runs on the controller.
        seed: of the virtual network and of noise.
        realtime: run on the wall clock instead of the virtual one.
        host_network: use the sockets of the host instead of a virtual network.
        task_class: number of the class whose cycles `cycles` counts; by default the lowest.

    Attributes:
        controller: the controller itself.
        tags: its tags.
        costs: CPU time of the programs, cycle by cycle.
        faults: faults of the network and of tags.
        traces: all traces made by `record`.
        settings: of the extensions in plc.toml, by table, as they hold in tests.
        image: what services of the project would share with the controller.
        winding: what `rewind` goes back by.
        after_cycle: functions called after every cycle, to step what runs beside the controller.
        interleaving: how the task classes meet, where `every_interleaving` made this controller.
    """

    def __init__(
        self,
        application: Application,
        *,
        seed: int = 0,
        realtime: bool = False,
        host_network: bool = False,
        task_class: int | None = None,
    ) -> None:
        self.name = application.name
        self.seed = seed
        self.application = application
        self.realtime = realtime
        self.clock: VirtualClock | WallClock = WallClock() if realtime else VirtualClock()
        net = None if host_network else VirtualNetwork(self.clock.now_ns, seed=seed)
        network: Network = OsNetwork() if net is None else net.host(CONTROLLER_IP)
        here = application.in_process("" if host_network else CONTROLLER_IP, is_test=True)
        self.settings = here.extensions
        self.image = SharedImage(here.extensions)
        self.controller = assemble(
            here, clock=self.clock, network=network, image=self.image.of_controller
        )
        if not realtime:
            check_bools(self.controller.areas)
        World.__init__(self, Tags(self.controller), self.controller.forces, net, seed)
        Expectations.__init__(self)
        self.costs = Costs(self.controller)
        self.history = History(self.controller)
        self.traces: list[Trace] = []
        self.interleaving: Interleaving | None = None
        self.latest: Plc = self
        self.after_cycle: list[Callable[[], None]] = []
        self._class = self._find_class(task_class)
        self._invariants: list[Condition] = []
        self._stop: Callable[[], bool] | None = None
        self._stopped = False
        self._pending: BaseException | None = None
        self._last_release_ns = 0
        self._earlier_ns = 0
        self.winding = Winding(self)
        self.controller.image.inputs.append(self._latch)
        self.controller.image.watchers.append(self._publish)

    def _find_class(self, number: int | None) -> TaskClass:
        classes = {c.number: c for c in self.controller.classes}
        found = classes.get(min(classes) if number is None else number)
        if found is None:
            known = ", ".join(str(n) for n in classes)
            raise PlcTestError(f"there is no task class {number}; there are {known}")
        return found

    def boot(self, *, cold: bool = False) -> None:
        """Give all variables their initial values and run every INIT.

        Args:
            cold: see `restart`.

        Raises:
            ControllerFault: an INIT failed.
        """
        self._earlier_ns = self.total_ns
        for task_class in self.controller.classes:
            task_class.cycles = 0
        self.history.clear()
        self._last_release_ns = 0
        self.costs.restart()
        with watchdog(self.controller):
            self.controller.boot(cold=cold)
        self._check_fault()
        self.controller.start()

    def restart(self, *, cold: bool = False) -> None:
        """Restart as after a power failure: EXITs, initial values, INITs; time starts at 0 again.

        RETAIN variables keep their values, permanent ones at a cold restart too. Plants, forces and
        faults stay; acts that were planned and have not happened are dropped.
        From SERVICE, too, a restart leads back to RUN.

        Args:
            cold: RETAIN variables get their initial values too.

        Raises:
            ControllerFault: an EXIT or an INIT failed.
        """
        if self.controller.state is not State.SERVICE:
            self.stop()
        self._restart_world()
        self.boot(cold=cold)

    def stop(self) -> None:
        """Run every EXIT, as when the controller is switched off in an orderly way.

        Raises:
            ControllerFault: an EXIT failed.
        """
        with watchdog(self.controller):
            self.controller.shutdown()
        self._check_fault()

    def close(self) -> None:
        """End it all: EXITs if the programs still run, sockets closed.

        Raises:
            ControllerFault: an EXIT failed.
        """
        if self.latest is not self:
            self.latest.close()
            self.latest = self
        self.image.close()
        if self.controller.state is State.RUN:
            self.stop()
        else:
            self.controller.context.restart()

    @property
    def time_ns(self) -> int:
        """Time since the start of the controller, in nanoseconds."""
        origin_ns = self.controller.scan.origin_ns
        return self.clock.now_ns() - origin_ns if origin_ns else 0

    @property
    def total_ns(self) -> int:
        """Time that the controller has run in this test, those before restarts included."""
        return self._earlier_ns + self.time_ns

    @property
    def last_release_ns(self) -> int:
        """Release of the latest cycle, since the start of the controller."""
        return self._last_release_ns

    @property
    def cycle_count(self) -> int:
        """Cycles of the task class under test since the start."""
        return self._class.cycles

    @property
    def cycle_ns(self) -> int:
        """Cycle time of the task class under test."""
        return self._class.cycle_ns

    def run(self, duration: str) -> None:
        """Run for a time, such as ``"250ms"``; `advance` takes nanoseconds.

        Raises:
            PlcTestError: it is no duration; a number alone might be meant in any unit.
            ControllerFault: a program failed.
            PlantError: a plant or a planned act raised.
        """
        given: object = duration
        if isinstance(given, int):
            raise PlcTestError(
                f'run: {duration!r} has no unit; a duration is a text, such as "{duration}ms"'
            )
        self.advance(duration_ns(duration, "run"))

    def cycles(self, count: int = 1) -> None:
        """Run until the task class under test has done ``count`` more cycles; errors as `run`."""
        if count < 1:
            raise PlcTestError(f"cycles: {count!r} is not a number above 0")
        last = self._class.cycles + count
        # twice the time that they take, as each grid point may be missed once
        limit_ns = (2 * count + 2) * self._class.cycle_ns + self._class.first_release_ns
        if not self.advance(limit_ns, lambda: self._class.cycles >= last):
            done = count - (last - self._class.cycles)
            self.fail(f"only {done} of {count} cycles were done: the others were missed", [])

    def advance(self, duration_ns: int, stop: Callable[[], bool] | None = None) -> bool:
        """Run for a time, or until ``stop`` holds after a cycle; return whether it did."""
        if self.controller.state is State.STOPPED:
            raise PlcTestError("the controller is stopped; restart() starts it again")
        self._check_fault()
        self._stop, self._stopped = stop, False
        ticking = self.clock if isinstance(self.clock, WallClock) else nullcontext()
        with ticking, watchdog(self.controller), garbage_held():
            self.controller.run_for(duration_ns)
        self._stop = None
        if self._pending is not None:
            pending, self._pending = self._pending, None
            raise pending
        self._check_fault()
        return self._stopped

    def rewind(self, cycles: int) -> None:
        """Go back by cycles of the task class under test, to look there, or to go on otherwise.

        ::

            plc.run("10s")
            plc.rewind(100)
            plc["tank.valve"] = False
            plc.run("1s")

        The controller starts again, at the same time of its clock, and runs up to there on what
        came in then: what the test, plants and forces stored. Every cycle must end as it did. What
        came later is forgotten; acts that were planned are dropped.

        Raises:
            PlcTestError: there were not so many cycles since the start, the clock is the real one,
                or a cycle does not end as it did: what a program has from sockets, files or
                ``random`` cannot be wound back.
        """
        if not isinstance(self.clock, VirtualClock):
            raise PlcTestError("rewind: the real clock cannot be wound back")
        earlier_ns = self._earlier_ns
        self.winding.back(cycles)
        self._earlier_ns = earlier_ns
        for trace in self.traces:
            trace.cut(self._last_release_ns if self.cycle_count else 0)

    def __getitem__(self, path: str) -> Any:
        """Return the plain value of a tag: a dict for a STRUCT, a list for an ARRAY.

        Raises:
            TagError: there is no such tag; near names are offered.
        """
        return self.tags[path]

    def __setitem__(self, path: str, value: object) -> None:
        """Store a value at once; the programs see it in their next cycle.

        Raises:
            TagError: there is no such tag, or it cannot take the value.
        """
        self.tags[path] = value

    def _ipython_key_completions_(self) -> list[str]:
        return self.tags.paths()

    def record(self, *paths: str) -> Trace:
        """Record tags from now on, in every cycle; a STRUCT or ARRAY with all its elements.

        Raises:
            TagError: there is no such tag.
        """
        trace = Trace([leaf for path in paths for leaf in self.tags.leaves(path)])
        self.traces.append(trace)
        trace.sample(self.controller.memory, 0, 0, self.time_ns)
        return trace

    def cost(self, program: str, duration: str | int, cycle: int | None = None) -> None:
        """Let a program take time on the virtual clock, always or in one of its cycles.

        Raises:
            PlcTestError: there is no such program, or the clock is the real one.
        """
        self.costs.plan(program, duration_ns(duration, "cost"), cycle)

    def assert_cost(self, program: str, **limits: int) -> None:
        """Require that a compiled program has taken no more instructions in its cycles so far.

        ::

            plc.assert_cost("conveyor", worst=12_000, p99=9_000)

        Args:
            program: its name.
            limits: instructions of CYCLIC, by ``p50``, ``p90``, ``p99``, ``p999``, ``worst``.

        Raises:
            ExpectationFailed: one does not hold.
            PlcTestError: the instructions of this program are not counted, a limit is unknown, or
                too few cycles have run for it.
        """
        over = exceeded(self.costs.instructions, limits, program, "assert_cost")
        if over:
            raise ExpectationFailed("; ".join(over))

    def always(self, condition: Given) -> None:
        """Require a condition after every cycle from now on.

        Raises:
            ExpectationFailed: raised by whatever runs the controller when it does not hold.
        """
        self._invariants.append(Condition(condition, self.tags))

    def every_interleaving(
        self,
        classes: Iterable[int] = (),
        *,
        step: str | int | None = None,
        overrun_cycles: int = 3,
        most: int = 200,
        invariant: Callable[[Plc], object] | None = None,
    ) -> Iterator[Plc]:
        """Iterate over controllers, freshly booted, whose task classes meet in every possible way.

        ::

            for plc in plc.every_interleaving(classes=(1, 4)):
                plc.run("1s")
                assert plc["consumer.lost"] == 0

        First releases are moved against each other, and one program at a time takes half or one and
        a half of the shortest cycle time in one of its first cycles; violations are only logged.

        Args:
            classes: numbers of the task classes; none for all.
            step: by how much releases are moved; by default half the shortest cycle time, at most
                1 ms.
            overrun_cycles: first cycles of each program in which it may overrun.
            most: more interleavings than this are sampled, by the seed.
            invariant: called with the controller after every cycle; must be true.
        """
        setup = self.application.setup
        shortest_ns = min(c.cycle_ns for c in setup.classes)
        step_ns = min(1_000_000, shortest_ns // 2) if step is None else duration_ns(step, "step")
        every = interleavings(setup, tuple(classes), step_ns, overrun_cycles, most, self.seed)
        for one in every:
            application = replace(self.application, setup=one.apply(setup))
            plc = Plc(application, seed=self.seed)
            self.latest = plc
            plc.interleaving = one
            if one.overrun is not None:
                plc.cost(one.overrun.program, one.overrun.cost_ns, one.overrun.cycle)
            if invariant is not None:
                plc.always(partial(invariant, plc))
            plc.boot()
            yield plc
            plc.close()
        self.latest = self

    def fail(self, text: str, paths: Iterable[str]) -> NoReturn:
        """Raise ExpectationFailed with the last cycles of tags.

        Raises:
            ExpectationFailed: always.
        """
        raise ExpectationFailed(self._in_place(text), tuple(paths), self.explain(paths))

    def _in_place(self, text: str) -> str:
        return f"{text} (interleaving: {self.interleaving})" if self.interleaving else text

    def explain(self, paths: Iterable[str] = ()) -> str:
        """Return the last cycles of tags, and of those recorded, as a table and as a diagram."""
        leaves = [leaf for path in paths for leaf in self.tags.leaves(path)]
        leaves += [tag for trace in self.traces for tag in trace.tags]
        return self.history.explain(leaves, MOST_TAGS)

    def recent(self) -> list[str]:
        """Return the tags that were read last."""
        return list(self.tags.read)[-MOST_TAGS:]

    @property
    def used_chance(self) -> bool:
        """Whether anything so far depended on the seed."""
        drawn = self.interleaving is not None or self.faults.used_chance
        fresh = Random(self.seed).getstate()  # noqa: S311  # repeatable on purpose
        return drawn or (self._net is not None and self._net.random.getstate() != fresh)

    def _check_fault(self) -> None:
        """Raise what led to SERVICE."""
        fault = self.controller.fault
        if self.controller.state is not State.SERVICE or fault is None:
            return
        program = fault.program
        if isinstance(fault, ProgramError) and isinstance(
            fault.__cause__, KeyboardInterrupt | SystemExit
        ):
            raise fault.__cause__
        errors = [e.text for e in self.controller.logbook if e.severity is Severity.ERROR]
        text = self._in_place(f"the controller is in SERVICE: {errors[-1] if errors else fault}")
        paths = [p for p in self.tags.paths() if p.upper().startswith(f"{program.upper()}.")]
        shown = tuple(p for p in self.recent() if p in paths) or tuple(paths[:MOST_TAGS])
        raise ControllerFault(text, shown, self.explain(shown)) from None

    def _latch(self, task_class: TaskClass) -> None:
        """Bring in what acts on the programs."""
        time_ns = self.controller.context.release_ns - self.controller.scan.origin_ns
        try:
            self._act(task_class, time_ns, under_test=task_class is self._class)
        except PlantError as error:
            self._end_run(error)
        self.winding.latched()

    def _publish(self, task_class: TaskClass) -> None:
        """Record, and look whether what the test waits for has come."""
        time_ns = self.controller.context.release_ns - self.controller.scan.origin_ns
        self._last_release_ns = time_ns
        self.history.add(task_class)
        self.winding.ended(task_class)
        if not self.winding.is_winding:
            for trace in self.traces:
                trace.sample(self.controller.memory, task_class.number, task_class.cycles, time_ns)
        for act in self.after_cycle:
            act()
        try:
            self._check_invariants()
            if self._stop is not None and self._stop():
                self._stopped = True
                self.controller.scan.pause()
        except BaseException as error:  # carried out of the scan, raised by advance
            self._end_run(error)

    def _check_invariants(self) -> None:
        for invariant in self._invariants:
            if not invariant.holds():
                self.fail(
                    f"expected {invariant.text} after every cycle; it does not hold after cycle "
                    f"{self.cycle_count} at {self._last_release_ns / 1e6:g} ms",
                    invariant.paths,
                )

    def _end_run(self, error: BaseException) -> None:
        self._pending = self._pending or error
        self.controller.scan.pause()
