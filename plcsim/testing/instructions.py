"""Costs of compiled programs in instructions: exact, so nothing is measured again.

On the virtual clock the machine counts the instructions of every cycle. They are the same in every
run and on every machine, so one cycle over its limit is one too many.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.core.statistics import Histogram
from plcsim.testing.budget import QUANTILES, check_count, quantile_of
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__tracebackhide__ = True


def exceeded(
    counted: Mapping[str, Sequence[int]],
    limits: Mapping[str, int],
    program: str = "",
    who: str = "",
) -> list[str]:
    """Return in words which limits do not hold.

    Args:
        counted: instructions of each cycle, by program.
        limits: by the names of `QUANTILES`.
        program: the program that they are for, "" for all compiled ones.
        who: asks, for errors.

    Raises:
        PlcTestError: the program is not known or its instructions are not counted, a limit has an
            unknown name, or there are too few cycles for it.
    """
    found = []
    for name in _programs(counted, program, who):
        for quantile, limit in limits.items():
            if quantile not in QUANTILES:
                raise PlcTestError(f"{who}: {quantile}: give one of {', '.join(QUANTILES)}")
            check_count(quantile, name, len(counted[name]), who)
            seen = quantile_of(sorted(counted[name]), QUANTILES[quantile])
            if seen > limit:
                found.append(_describe(name, quantile, counted[name], seen, limit))
    return found


def _programs(counted: Mapping[str, Sequence[int]], program: str, who: str) -> list[str]:
    names = [name for name in counted if program.upper() in ("", name.upper())]
    if names:
        return names
    known = f"; they are of {', '.join(counted)}" if counted else ""
    raise PlcTestError(
        f"{who}: no instructions are counted of {program or 'any program'}{known}: only compiled "
        "programs have them, on the virtual clock"
    )


def _describe(name: str, quantile: str, cycles: Sequence[int], seen: int, limit: int) -> str:
    where = f" (in cycle {cycles.index(seen) + 1})" if quantile == "worst" else ""
    return (
        f"program {name} is over its budget: {quantile} of {len(cycles)} cycles is {seen:,} "
        f"instructions{where}, limit {limit:,}"
    )


def summary_of(counted: Sequence[int]) -> dict[str, Any]:
    """Return what the report says of the instructions of a program's cycles."""
    ordered, histogram = sorted(counted), Histogram()
    for count in counted:
        histogram.record(count)
    return {
        "total": sum(counted),
        **{name: quantile_of(ordered, QUANTILES[name]) for name in ("p50", "p99")},
        "maximum": ordered[-1],
        "maximum_cycle": counted.index(ordered[-1]) + 1,
        "histogram": histogram.buckets(),
    }
