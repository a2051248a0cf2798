"""The smallest failing example."""

from collections.abc import Mapping, Sequence

from plcsim.campaign import Choice, Integer, Uniform
from plcsim.campaign.result import PlannedRun, Result, RunOutcome
from plcsim.campaign.shrink import MOST_RUNS, shrink

VARIABLES = {
    "speed": Uniform(0, 100, nominal=0),
    "delay": Integer(0, 50),
    "valve": Choice("works", "stuck"),
}
FAILURE = Result(
    PlannedRun(7, 3, {"speed": 83.217731, "delay": 37, "valve": "stuck"}),
    RunOutcome.FAILED,
    "too fast",
)


def perform(orders: Sequence[PlannedRun]) -> Mapping[int, Result]:
    """Fail above a speed of 60 from a delay of 10 on."""
    results = {}
    for order in orders:
        fails = float(order.values["speed"]) > 60 and int(order.values["delay"]) >= 10
        outcome = RunOutcome.FAILED if fails else RunOutcome.PASSED
        results[order.number] = Result(order, outcome, "too fast" if fails else "")
    return results


def test_what_does_not_matter_becomes_nominal_and_numbers_become_round() -> None:
    smallest = shrink(FAILURE, VARIABLES, perform)
    assert smallest.order.values == {"speed": 80.0, "delay": 10, "valve": "works"}
    assert smallest.order.seed == 3


def test_another_cause_is_not_taken() -> None:
    def other(orders: Sequence[PlannedRun]) -> Mapping[int, Result]:
        return {o.number: Result(o, RunOutcome.FAILED, "something else") for o in orders}

    assert shrink(FAILURE, VARIABLES, other) is FAILURE


def test_the_runs_are_bounded() -> None:
    done = 0

    def count(orders: Sequence[PlannedRun]) -> Mapping[int, Result]:
        nonlocal done
        done += len(orders)
        return {o.number: Result(o, RunOutcome.FAILED, "too fast") for o in orders}

    shrink(FAILURE, {"speed": Uniform(0, 1e9, nominal=0), **VARIABLES}, count)
    assert done <= MOST_RUNS
