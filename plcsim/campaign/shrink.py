"""The smallest failing example: the values of a failure made simpler while its cause stays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.campaign.result import PlannedRun

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.campaign.result import Result
    from plcsim.campaign.variables import Scalar, VariedVariable

MOST_RUNS: Final = 200
"""Runs that are spent on one failure."""


def shrink(
    failure: Result,
    variables: Mapping[str, VariedVariable],
    perform: Callable[[Sequence[PlannedRun]], Mapping[int, Result]],
) -> Result:
    """Return the simplest run that was found to fail for the same cause.

    Each variable in turn is set to the values that are simpler, all of them tried at once, until no
    variable can be made simpler any more.

    Args:
        failure: a run that failed.
        variables: those of its values that may be changed.
        perform: does runs; returns their results by number.
    """
    left = MOST_RUNS
    changed = True
    while changed and left > 0:
        changed = False
        for name, variable in variables.items():
            candidates = list(variable.simpler(failure.order.values[name]))[:left]
            left -= len(candidates)
            better = _first_alike(failure, name, candidates, perform)
            if better is not None:
                failure, changed = better, True
    return failure


def _first_alike(
    failure: Result,
    name: str,
    candidates: Sequence[Scalar],
    perform: Callable[[Sequence[PlannedRun]], Mapping[int, Result]],
) -> Result | None:
    """Return the result with the first candidate that fails for the same cause."""
    seed = failure.order.seed
    orders = [
        PlannedRun(number, seed, failure.order.values | {name: value})
        for number, value in enumerate(candidates)
    ]
    results = perform(orders) if orders else {}
    return next((results[n] for n in range(len(orders)) if results[n].cause == failure.cause), None)
