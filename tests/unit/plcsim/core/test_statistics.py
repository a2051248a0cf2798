"""The histogram: percentiles against sorted data, fixed size, exact extremes."""

import math
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from plcsim.core.statistics import BUCKETS, LARGEST_NS, SUB_BITS, Histogram

durations = (
    st.integers(0, 200) | st.integers(0, LARGEST_NS) | st.integers(0, 40).map(lambda n: 2**n)
)


def histogram_of(durations_ns):
    histogram = Histogram()
    for duration_ns in durations_ns:
        histogram.record(duration_ns)
    return histogram


@given(
    st.lists(durations, min_size=1, max_size=200),
    st.sampled_from(["0", "1", "50", "90", "99", "99.9", "100"]),
)
@example([*range(1000)], "99.9")
def test_a_percentile_is_exact_to_one_bucket(durations_ns, percent):
    found_ns = histogram_of(durations_ns).percentile_ns(float(percent))
    rank = max(1, math.ceil(len(durations_ns) * Fraction(percent) / 100))
    true_ns = min(sorted(durations_ns)[rank - 1], LARGEST_NS)
    assert true_ns <= found_ns <= true_ns + true_ns // (1 << SUB_BITS)


@given(st.lists(st.sampled_from([-3, 0, 7, 5000, LARGEST_NS + 1]), min_size=1, max_size=50))
def test_one_duration_again_and_again_counts_each_time(durations_ns):
    found = histogram_of(durations_ns)
    apart = [histogram_of([one]) for one in durations_ns]
    assert found.counts == [sum(counts) for counts in zip(*(h.counts for h in apart), strict=True)]
    assert found.total_ns == sum(h.total_ns for h in apart)
    assert found.last_ns == apart[-1].last_ns
    assert found.maximum_ns == max(h.maximum_ns for h in apart)
    assert found.minimum_ns == min(h.minimum_ns for h in apart)
    found.reset()
    found.record(0)
    assert found.count == 1


@given(st.lists(durations, max_size=50))
def test_the_summary_is_exact_but_for_the_percentiles(durations_ns):
    summary = histogram_of(durations_ns).summary()
    count = len(durations_ns)
    assert summary.entries == count
    assert summary.minimum_ns == min(durations_ns, default=0)
    assert summary.maximum_ns == max(durations_ns, default=0)
    assert summary.mean_ns == (sum(durations_ns) // count if count else 0)
    percentiles = [summary.p50_ns, summary.p90_ns, summary.p99_ns, summary.p99_9_ns]
    assert [*percentiles, summary.maximum_ns] == sorted([*percentiles, summary.maximum_ns])


@given(st.integers(0, LARGEST_NS))
def test_every_duration_lies_in_its_own_bucket(duration_ns):
    (entry,) = histogram_of([duration_ns]).buckets()
    largest_ns, count = entry
    assert count == 1
    assert duration_ns <= largest_ns <= duration_ns + duration_ns // (1 << SUB_BITS)


def test_small_durations_are_exact():
    histogram = histogram_of(range(64))
    assert [histogram.percentile_ns(p) for p in (0, 50, 100)] == [0, 31, 63]
    assert histogram.buckets() == [(ns, 1) for ns in range(64)]


@pytest.mark.parametrize("duration_ns", [-1, -(10**12)])
def test_a_negative_duration_counts_as_0(duration_ns):
    assert histogram_of([duration_ns]).summary() == histogram_of([0]).summary()


def test_a_duration_beyond_the_last_bucket_is_counted_in_it():
    histogram = histogram_of([LARGEST_NS + 1, 10 * LARGEST_NS])
    assert histogram.percentile_ns(50) == LARGEST_NS
    assert histogram.maximum_ns == 10 * LARGEST_NS


def test_it_never_grows():
    histogram = histogram_of(range(0, 10**9, 10**5))
    assert len(histogram.counts) == BUCKETS
    assert histogram.count == 10_000
    assert not hasattr(histogram, "__dict__")


def test_a_reset_forgets_everything():
    histogram = histogram_of([5, 10])
    histogram.reset()
    assert histogram.summary() == Histogram().summary()
    assert histogram.percentile_ns(99) == 0
    assert histogram.last_ns == 0
