"""Winds a controller under test back: it runs again from its start, on what came in then.

What came in up to each LATCH is told by the variables: they are compared with those at the end of
the cycle before. Every cycle that is run again has to end as it did, so what is wound back is what
it was; a program that asks the world otherwise is named instead. A cycle costs eight bytes, and
what came in; of the latest ones the variables are kept, to name a tag.
"""

from __future__ import annotations

from array import array
from collections import deque
from typing import TYPE_CHECKING, Final

from plcsim.core.clock import VirtualClock
from plcsim.core.control import Step
from plcsim.core.tag import differences
from plcsim.testing.errors import PlcTestError
from st_types.types.values import decode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from plcsim.core.forces import Force
    from plcsim.core.task import TaskClass
    from plcsim.testing.plc import Plc

__tracebackhide__ = True

MOST_BYTES: Final = 64 * 1024 * 1024
"""Kept of all cycles; after a run with more, nothing is wound back."""

IMAGES_BYTES: Final = 1024 * 1024
"""Variables kept of the latest cycles."""

_ENTRY_BYTES: Final = 150
"""Roughly what an entry of a dict takes."""


class _Run:
    """The cycles since a boot.

    Attributes:
        start_ns: of the clock at the boot.
        retained: what the boot was given.
        ends: what each cycle ended with, as a hash.
        came_in: by the cycle's place, what was otherwise than at the end of the cycle before: where
            it begins, and the bytes.
        forces: by the cycle's place, those forced since.
        images: places and variables of the latest cycles.
        size: bytes of all that.
    """

    def __init__(self, start_ns: int, retained: bytes, images: int) -> None:
        self.start_ns = start_ns
        self.retained = retained
        self.ends = array("q")
        self.came_in: dict[int, tuple[int, bytes]] = {}
        self.forces: dict[int, list[Force]] = {}
        self.images: deque[tuple[int, bytes]] = deque(maxlen=images)
        self.size = 0


class Winding:
    """The cycles of a controller since its start.

    Args:
        plc: the controller under test.
    """

    def __init__(self, plc: Plc) -> None:
        self._plc = plc
        controller = plc.controller
        memory = controller.memory
        self._views = [memory.view(a.address, a.data_type.size) for a in controller.areas]
        self._images = max(1, IMAGES_BYTES // max(1, sum(map(len, self._views))))
        self._before = b""
        self._run = _Run(0, b"", 1)
        self._script: _Run | None = None
        self._has_new_forces = False
        self._reason = ""
        controller.forces.follow(self._forced)
        controller.follow_steps(self._stepped)

    @property
    def is_winding(self) -> bool:
        """Whether cycles are run again."""
        return self._script is not None

    def back(self, cycles: int) -> None:
        """Go back by cycles of the task class under test.

        Raises:
            PlcTestError: there were not so many, or one cannot be repeated.
        """
        plc, then = self._plc, self._run
        target = plc.cycle_count - cycles
        if cycles < 1 or target < 0:
            raise PlcTestError(f"rewind: {plc.cycle_count} cycles can be wound back, not {cycles}")
        if then.size > MOST_BYTES:
            raise PlcTestError("rewind: what came in is more than is kept of a run (64 MiB)")
        self._script, self._reason = then, ""
        try:
            plc.restart()
            if target:
                plc.cycles(target)
        finally:
            self._script = None
        if self._reason:
            raise PlcTestError(
                f"rewind: {self._reason}; what a program has from elsewhere than its variables "
                "cannot be wound back"
            )

    def _forced(self) -> None:
        self._has_new_forces = True

    def _stepped(self, step: Step, _until_ns: int, _cycles: int) -> None:
        if step is not Step.BOOT:
            return
        controller, script = self._plc.controller, self._script
        if script is not None and isinstance(self._plc.clock, VirtualClock):
            self._plc.clock.wind_back_to_ns(script.start_ns)
            controller.retained.from_bytes(script.retained)
            controller.forces.clear()
        start_ns, retained = controller.clock.now_ns(), controller.retained.to_bytes()
        self._run = _Run(start_ns, retained, self._images)
        self._before = b""
        self._has_new_forces = bool(list(controller.forces))

    def _variables(self) -> bytes:
        return b"".join(self._views)

    def latched(self) -> None:
        """Note what has come in; while winding, let come in what did then."""
        now, run = self._variables(), self._run
        place = len(run.ends)
        if self._script is not None and not self._reason:
            now = self._repeat(self._script, place, now)
        if now != self._before and run.size <= MOST_BYTES:
            start, data = _difference(self._before, now)
            run.came_in[place] = start, data
            run.size += len(data) + _ENTRY_BYTES
        if self._has_new_forces:
            self._has_new_forces = False
            run.forces[place] = list(self._plc.controller.forces)
            run.size += _ENTRY_BYTES * (1 + len(run.forces[place]))

    def _repeat(self, script: _Run, place: int, now: bytes) -> bytes:
        """Let come in what came in then; return the variables."""
        start, data = script.came_in.get(place, (0, b""))
        if self._before or data:
            now = (self._before or now)[:start] + data + (self._before or now)[start + len(data) :]
        at = 0
        for view in self._views:
            view[:] = now[at : at + len(view)]
            at += len(view)
        if place in script.forces:
            forces = self._plc.controller.forces
            forces.clear()
            for each in script.forces[place]:
                forces.force(*each)
        return now

    def ended(self, task_class: TaskClass) -> None:
        """Note how a cycle ends; while winding, compare it."""
        now, run, script = self._variables(), self._run, self._script
        place, here = len(run.ends), (task_class.number, task_class.cycles)
        end = hash((here, now))
        is_same = script is None or (place < len(script.ends) and end == script.ends[place])
        if script is not None and not is_same and not self._reason:
            was = next((image for at, image in script.images if at == place), b"")
            where = f"cycle {here[1]} of task class {here[0]}"
            self._reason = f"{where} {self._name(now, was)}"
        if run.size <= MOST_BYTES:
            run.ends.append(end)
        run.images.append((place, now))
        run.size += 8
        self._before = now

    def _name(self, now: bytes, was: bytes) -> str:
        """Return the first tag that differs, with both values, where it is known."""
        found = next(differences(self._plc.controller.areas, now, was), None) if was else None
        if found is None:
            return "ends otherwise than it did"
        leaf, *images = found
        values = [value_text(leaf.data_type, decode(leaf.data_type, each)) for each in images]
        return f"ends otherwise: {leaf.path} is {values[0]} now, and was {values[1]}"


def _difference(before: bytes, now: bytes) -> tuple[int, bytes]:
    """Return where two images differ first, and the second one from there to where they do last."""
    if len(before) != len(now):
        return 0, now
    bits = int.from_bytes(before, "little") ^ int.from_bytes(now, "little")
    first, last = ((bits & -bits).bit_length() - 1) // 8, (bits.bit_length() - 1) // 8
    return first, now[first : last + 1]
