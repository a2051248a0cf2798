"""Budgets of execution time: judged so that a busy machine neither fails nor passes a program.

On the virtual clock a test repeats exactly, so its n-th cycle does the same work in every run. What
else happens on the machine only ever adds CPU time to it. A test over its budget is therefore run
again, and for each cycle the smallest cost of all runs counts; a disturbance would have to hit the
same cycle each time. How fast the machine is, is told by the calibration loop that runs between the
cycles: by its undisturbed runs, as the smallest costs are undisturbed too.
"""

from __future__ import annotations

import re
from math import ceil
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from plcsim.core.duration import format_duration
from plcsim.testing.calibration import slowness
from plcsim.testing.errors import PlcTestError
from plcsim.testing.times import duration_ns

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__tracebackhide__ = True

MOST_RUNS = 7
"""Runs of a test until a budget that does not hold is believed to be broken."""

QUANTILES = {"p50": 0.5, "p90": 0.9, "p99": 0.99, "p999": 0.999, "worst": 1.0}


class Budget(NamedTuple):
    """What the marker ``cycle_budget`` says.

    Attributes:
        limits_ns: by the names of `QUANTILES`, for the reference machine.
        program: the program it is for, "" for all.
        instructions: limits in instructions, likewise by the names of `QUANTILES`.
    """

    limits_ns: Mapping[str, int]
    program: str = ""
    instructions: Mapping[str, int] = MappingProxyType({})


class Breach(NamedTuple):
    """A limit that does not hold; times are those of the reference machine."""

    program: str
    quantile: str
    seen_ns: int
    limit_ns: int


class CycleMeasurement:
    """Costs of all runs of one test.

    Attributes:
        costs_ns: smallest cost of each cycle, one list a program.
        calibration_ns: every run of the calibration loop.
        runs: how often the test ran.
    """

    def __init__(self) -> None:
        self.costs_ns: dict[str, list[int]] = {}
        self.calibration_ns: list[int] = []
        self.runs = 0

    def add(self, costs_ns: Mapping[str, Sequence[int]], calibration_ns: Sequence[int]) -> None:
        """Add a run.

        Raises:
            PlcTestError: it had other numbers of cycles than the runs before.
        """
        for program, costs in costs_ns.items():
            before = self.costs_ns.setdefault(program, list(costs))
            if len(before) != len(costs):
                raise PlcTestError(
                    f"cycle_budget: {program} ran {len(before)} cycles in one run of the test and "
                    f"{len(costs)} in the next; a test with a budget must repeat exactly"
                )
            self.costs_ns[program] = [min(pair) for pair in zip(before, costs, strict=True)]
        self.calibration_ns += calibration_ns
        self.runs += 1


def budget_of(given: Mapping[str, Any]) -> Budget:
    """Return the budget of a marker's keyword arguments.

    Raises:
        PlcTestError: a limit is unknown, neither a duration nor a number of instructions, or there
            is none.
    """
    limits = dict(given)
    program = str(limits.pop("program", ""))
    unknown = [name for name in limits if name not in QUANTILES]
    if unknown or not limits:
        raise PlcTestError(
            f"cycle_budget: {unknown[0] if unknown else 'no limit'}: give one of "
            f'{", ".join(QUANTILES)}, such as cycle_budget(p99="200us")'
            ' or cycle_budget(worst="12_000 instructions")'
        )
    counts = {name: _instructions_of(limit) for name, limit in limits.items()}
    spans_ns = {
        name: duration_ns(span, f"cycle_budget: {name}")
        for name, span in limits.items()
        if counts[name] is None
    }
    exact = {name: count for name, count in counts.items() if count is not None}
    return Budget(spans_ns, program, exact)


_INSTRUCTIONS = re.compile(r"(\d[\d_]*) instructions?")


def _instructions_of(limit: object) -> int | None:
    """Return the number in "12_000 instructions", None for another limit."""
    found = _INSTRUCTIONS.fullmatch(limit.strip()) if isinstance(limit, str) else None
    return int(found[1]) if found else None


def quantile_of(ordered: Sequence[int], quantile: float) -> int:
    """Return the smallest of ascending costs that ``quantile`` of them do not exceed."""
    return ordered[max(0, ceil(quantile * len(ordered)) - 1)]


def breaches(budget: Budget, measured: CycleMeasurement, reference_ns: int) -> list[Breach]:
    """Return the limits that do not hold.

    Raises:
        PlcTestError: there is no such program, or too few cycles for a percentile: at least
            1 / (1 - q) are needed for the quantile q.
    """
    factor = slowness(measured.calibration_ns, reference_ns)
    found: list[Breach] = []
    for program in _programs(budget, measured) if budget.limits_ns else ():
        ordered_ns = sorted(measured.costs_ns[program])
        for name, limit_ns in budget.limits_ns.items():
            check_count(name, program, len(ordered_ns))
            seen_ns = round(quantile_of(ordered_ns, QUANTILES[name]) / factor)
            if seen_ns > limit_ns:
                found.append(Breach(program, name, seen_ns, limit_ns))
    return found


def _programs(budget: Budget, measured: CycleMeasurement) -> list[str]:
    names = [p for p in measured.costs_ns if budget.program.upper() in ("", p.upper())]
    if not names:
        known = ", ".join(measured.costs_ns)
        raise PlcTestError(f"cycle_budget: no program {budget.program!r}; there are {known}")
    return names


def check_count(name: str, program: str, count: int, who: str = "cycle_budget") -> None:
    """Raise PlcTestError where a program ran too few cycles for a percentile."""
    needed = 1 if name == "worst" else round(1 / (1 - QUANTILES[name]))
    if count < needed:
        raise PlcTestError(f"{who}: {name} needs {needed} cycles at least; {program} ran {count}")


def describe_breaches(
    found: Sequence[Breach], measured: CycleMeasurement, reference_ns: int
) -> str:
    """Return why a test is over its budget, in words."""
    factor = slowness(measured.calibration_ns, reference_ns)
    lines = [
        f"program {b.program} is over its budget: {b.quantile} of "
        f"{len(measured.costs_ns[b.program])} cycles is {format_duration(b.seen_ns)}, "
        f"limit {format_duration(b.limit_ns)}"
        for b in found
    ]
    lines.append(
        f"times are those of the reference machine; here everything takes {factor:.2f} times as "
        f"long (calibration loop {format_duration(round(factor * reference_ns))}, there "
        f"{format_duration(reference_ns)}); smallest cost of each cycle in {measured.runs} runs"
    )
    return "\n".join(lines)
