"""The search for a run that fails."""

from collections.abc import Iterable, Sequence

import pytest

pytest.importorskip("scipy", reason="the extra campaign is not installed")

from plcsim.campaign import CampaignError, Falsify, Integer, Uniform
from plcsim.campaign.result import PlannedRun, Result, RunOutcome

VARIABLES = {"a": Uniform(-10, 10), "b": Uniform(-10, 10), "n": Integer(0, 9)}


class Bowl:
    """Fails only near one point of a space that chance hardly ever meets."""

    def __init__(self, depth: float) -> None:
        self.depth = depth
        self.done: list[PlannedRun] = []

    def perform(self, orders: Sequence[PlannedRun]) -> Iterable[Result]:
        """Return the results backwards: nothing may depend on their order."""
        self.done += orders
        return [self.result(order) for order in reversed(orders)]

    def result(self, order: PlannedRun) -> Result:
        a, b, n = (float(order.values[name]) for name in "abn")
        margin = (a - 3.3) ** 2 + (b + 7.1) ** 2 + abs(n - 4) - self.depth
        return Result(order, RunOutcome.FAILED if margin < 0 else RunOutcome.PASSED, margin=margin)


def test_the_margin_leads_to_the_failure() -> None:
    bowl = Bowl(depth=0.01)  # 0.0008 % of the space
    Falsify(3000).search(VARIABLES, 1, bowl.perform)
    assert any(bowl.result(order).outcome is RunOutcome.FAILED for order in bowl.done)
    assert len(bowl.done) < 3000


def test_the_search_is_repeatable_and_numbers_its_runs() -> None:
    first, second = Bowl(0.01), Bowl(0.01)
    for bowl in (first, second):
        Falsify(500).search(VARIABLES, 1, bowl.perform)
    assert first.done == second.done
    assert [order.number for order in first.done] == list(range(len(first.done)))


def test_it_ends_where_nothing_fails() -> None:
    bowl = Bowl(depth=-1)
    Falsify(300).search(VARIABLES, 1, bowl.perform)
    assert 300 <= len(bowl.done) < 450


def test_without_variables_there_is_nothing_to_search() -> None:
    with pytest.raises(CampaignError, match="name the variables"):
        Falsify().search({}, 1, Bowl(0).perform)
