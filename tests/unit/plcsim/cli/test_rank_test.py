"""The rank test against known figures, against counting, and against itself turned round."""

from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.cli.rank_test import EXACT_UP_TO, rank_test


def test_small_samples_are_exact():
    assert rank_test([1, 2, 3], [4, 5, 6]) == (9, 1.0, 1 / 20)
    assert rank_test([4, 5, 6], [1, 2, 3]) == (0, 0.0, 1.0)


def test_exact_probability_is_that_of_counting_all_orders():
    first, second = [3, 5, 9, 12], [4, 10, 11]
    u = rank_test(first, second).u
    pool = sorted(first + second)
    orders = [
        sum(b > a for b in chosen for a in pool if a not in chosen)
        for chosen in combinations(pool, len(second))
    ]
    expected = sum(other >= u for other in orders) / len(orders)
    assert rank_test(first, second).probability == pytest.approx(expected)


def test_ties_count_half():
    assert rank_test([1, 1], [1, 1]).u == 2
    assert rank_test([1, 1], [1, 1]).superiority == 0.5


def test_equal_values_are_no_evidence():
    assert rank_test([7.0] * 30, [7.0] * 30).probability == 1.0


@pytest.mark.parametrize("samples", [([], [1]), ([1], [])])
def test_an_empty_sample_is_refused(samples):
    with pytest.raises(ValueError, match="at least one value"):
        rank_test(*samples)


distinct = st.lists(st.integers(0, 10_000), min_size=2, max_size=40, unique=True)


@given(distinct, st.data())
def test_the_two_directions_add_up(values, data):
    cut = data.draw(st.integers(1, len(values) - 1))
    forward, back = rank_test(values[:cut], values[cut:]), rank_test(values[cut:], values[:cut])
    assert forward.superiority + back.superiority == pytest.approx(1)
    assert 0 <= forward.probability <= 1


@given(distinct, st.data())
def test_only_the_order_counts(values, data):
    cut = data.draw(st.integers(1, len(values) - 1))
    stretched = [value**3 + 5 for value in values]
    assert rank_test(values[:cut], values[cut:]) == rank_test(stretched[:cut], stretched[cut:])


def test_exact_and_normal_probability_agree_at_the_border():
    size = EXACT_UP_TO
    first = [10 * n for n in range(size)]
    second = [10 * n + 33 for n in range(size)]
    exact = rank_test(first, second).probability
    normal = rank_test(first, [*second[:-1], second[-2]]).probability
    assert exact == pytest.approx(normal, abs=0.01)
