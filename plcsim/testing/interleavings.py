"""Interleavings: how the releases and overruns of task classes can fall against each other."""

from __future__ import annotations

from dataclasses import replace
from math import prod
from random import Random
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.duration import format_duration
from plcsim.core.task import Policy
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from plcsim.program.setup import Setup, TaskClassSetup

__tracebackhide__ = True


class Overrun(NamedTuple):
    """One cycle of a program that takes a long time."""

    program: str
    cycle: int
    cost_ns: int


class Interleaving(NamedTuple):
    """One way in which task classes meet.

    Attributes:
        first_release_ns: by number of the task class, from the start to its first release.
        overrun: a program that takes long once; None for none.
    """

    first_release_ns: Mapping[int, int]
    overrun: Overrun | None = None

    def __str__(self) -> str:
        texts = [
            f"task class {number} first released at {format_duration(offset_ns)}"
            for number, offset_ns in self.first_release_ns.items()
        ]
        if self.overrun is not None:
            cost = format_duration(self.overrun.cost_ns)
            texts.append(f"{self.overrun.program} takes {cost} in its cycle {self.overrun.cycle}")
        return ", ".join(texts)

    def apply(self, setup: Setup) -> Setup:
        """Return the setup of a controller on which the classes meet in this way.

        Cycle time violations are only logged on it, as the overruns are made on purpose.
        """
        classes = [
            replace(
                c,
                first_release_ns=self.first_release_ns.get(c.number, c.first_release_ns),
                policy=Policy.LOG,
                host_policy=Policy.LOG,
            )
            for c in setup.classes
        ]
        return replace(setup, classes=classes)


def interleavings(
    setup: Setup, classes: Sequence[int], step_ns: int, overrun_cycles: int, most: int, seed: int
) -> Iterator[Interleaving]:
    """Iterate over all interleavings, or over ``most`` of them chosen by the seed, in one order.

    The offset of each class goes from 0 up to its cycle time, or up to the longest cycle time of
    the others where that is shorter, in steps: later offsets repeat what was there. A program
    overruns in one of its first cycles, by half of the shortest cycle time or by one and a half.

    Raises:
        PlcTestError: there is no such class, or fewer than two; the step is 0.
    """
    if not step_ns:
        raise PlcTestError("every_interleaving: the step must be above 0")
    chosen = _chosen(setup, classes)
    offsets = _offsets(chosen, step_ns)
    overruns = _overruns(chosen, overrun_cycles)
    count = prod(len(range_) for range_ in offsets) * len(overruns)
    numbers = [c.number for c in chosen]

    def one(index: int) -> Interleaving:
        chosen: dict[int, int] = {}
        for number, choices in zip(reversed(numbers), reversed(offsets), strict=True):
            index, digit = divmod(index, len(choices))
            chosen[number] = choices[digit]
        return Interleaving(dict(sorted(chosen.items())), overruns[index])

    if count <= most:
        return map(one, range(count))
    picked = Random(seed).sample(range(count), most)  # noqa: S311  # repeatable on purpose
    return map(one, sorted(picked))


def _chosen(setup: Setup, classes: Sequence[int]) -> list[TaskClassSetup]:
    known = {c.number: c for c in setup.classes}
    for number in classes:
        if number not in known:
            numbers = ", ".join(str(n) for n in sorted(known))
            raise PlcTestError(f"there is no task class {number}; there are {numbers}")
    chosen = [known[number] for number in sorted(classes or known)]
    if len(chosen) < 2:
        raise PlcTestError("interleavings need at least two task classes")
    return chosen


def _offsets(chosen: Sequence[TaskClassSetup], step_ns: int) -> list[range]:
    longest_ns = sorted(c.cycle_ns for c in chosen)[-2:]
    return [range(0, min(c.cycle_ns, longest_ns[0]), step_ns) for c in chosen]


def _overruns(chosen: Sequence[TaskClassSetup], cycles: int) -> list[Overrun | None]:
    shortest_ns = min(c.cycle_ns for c in chosen)
    costs_ns = (shortest_ns // 2, shortest_ns * 3 // 2)
    return [
        None,
        *(
            Overrun(program.name, cycle, cost_ns)
            for c in chosen
            for program in c.programs
            for cycle in range(1, cycles + 1)
            for cost_ns in costs_ns
        ),
    ]
