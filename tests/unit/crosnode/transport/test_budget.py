from hypothesis import given
from hypothesis import strategies as st

from crosnode.transport.budget import (
    ALONE_WORK,
    ANSWER_WORK,
    CALL_WORK,
    CONNECT_WORK,
    MESSAGE_WORK,
    POLL_WORK,
    REQUEST_WORK,
    START_WORK,
    UNPACED,
    StepBudget,
    StepLimits,
)

PRICES = (MESSAGE_WORK, REQUEST_WORK, CONNECT_WORK, CALL_WORK, ANSWER_WORK, ALONE_WORK)


def test_a_budget_starts_with_all_limits() -> None:
    budget = StepBudget(StepLimits())
    assert {name: getattr(budget, name) for name in StepLimits._fields} == StepLimits()._asdict()
    assert not budget.is_short


def test_unpaced_is_more_of_everything() -> None:
    assert all(most > some for most, some in zip(UNPACED, StepLimits(), strict=True))


@given(st.integers(1, 1 << 20), st.lists(st.sampled_from(PRICES), max_size=40))
def test_any_work_may_begin_a_step_and_at_most_one_piece_goes_beyond(
    work: int, prices: list[int]
) -> None:
    budget = StepBudget(StepLimits(work=work))
    assert budget.affords(max(PRICES))
    spent = []
    for price in prices:
        if budget.affords(price):
            budget.work -= price
            spent.append(price)
    assert sum(spent[:-1]) <= work
    assert sum(spent) - work <= max(PRICES)
    assert budget.is_short == (len(spent) < len(prices))


def test_what_is_to_be_alone_begins_where_nothing_but_looks_was_done() -> None:
    budget = StepBudget(StepLimits())
    for _ in range(5):
        budget.polls -= 1
        budget.work -= POLL_WORK
    assert budget.affords(ALONE_WORK)
    budget.work -= MESSAGE_WORK
    assert not budget.affords(ALONE_WORK)
    assert budget.is_short
    of_ten_milliseconds = StepBudget(StepLimits(work=10 * ALONE_WORK))
    of_ten_milliseconds.work -= MESSAGE_WORK
    assert of_ten_milliseconds.affords(ALONE_WORK)


def test_bytes_stop_where_the_work_ends() -> None:
    budget = StepBudget(StepLimits(work=100))
    assert budget.at_most(1_000) == 100
    assert not budget.is_short
    budget.work = -5
    assert budget.at_most(1_000) <= 0
    assert budget.is_short


def test_starting_a_connection_takes_its_price() -> None:
    budget = StepBudget(StepLimits(calls=2))
    assert [budget.start_call() for _ in range(3)] == [True, True, False]
    assert budget.work == StepLimits().work - 2 * START_WORK
