"""The rule: held, mostly held, not held; and whose fault it is."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.doctor.verdict import Comparison, Verdict, explain, judge

RANK = list(Verdict)


@pytest.mark.parametrize(
    ("late", "missed", "expected"),
    [
        (0, 0, Verdict.HELD),
        (10, 0, Verdict.HELD),  # 0.1 % may be late
        (11, 0, Verdict.MOSTLY),
        (0, 1, Verdict.MOSTLY),  # no grid point may be missed
        (100, 10, Verdict.MOSTLY),  # 1 % late, 0.1 % missed
        (101, 0, Verdict.NOT_HELD),
        (0, 11, Verdict.NOT_HELD),
    ],
)
def test_of_ten_thousand_cycles_so_many_may_be_late_or_missed(measured, late, missed, expected):
    lateness_ns = [250_000] * late + [20_000] * (10_000 - late)
    assert judge(measured(lateness_ns, missed)) is expected


@given(st.lists(st.integers(0, 2_000_000), min_size=1, max_size=60), st.integers(0, 5), st.data())
def test_a_later_cycle_or_one_more_missed_never_makes_it_better(
    measured, lateness_ns, missed, data
):
    worse_ns = list(lateness_ns)
    worse_ns[data.draw(st.integers(0, len(worse_ns) - 1))] += data.draw(st.integers(0, 10**6))
    more = missed + data.draw(st.integers(0, 3))
    before, after = judge(measured(lateness_ns, missed)), judge(measured(worse_ns, more))
    assert RANK.index(after) >= RANK.index(before)


def test_a_tick_that_is_held_needs_no_blame(punctual):
    text = explain(punctual)
    assert text.startswith("With real-time rights a tick of 1 ms can be held: 99.9 % of the cycles")
    assert "20 us of their release (limit 200 us)" in text
    assert text.endswith("0 of 10000 grid points were missed.")


def test_the_host_is_to_blame_where_the_floor_did_not_hold_it_either(late):
    assert "cannot be held" in explain(late)
    assert explain(late).endswith("It is the host, for a bare C loop did not hold it either.")


def test_the_host_is_not_blamed_where_the_floor_held_it(punctual, late):
    text = explain(Comparison(punctual.floor, late.scan))
    assert text.endswith("A bare C loop held it: measure longer to know (--seconds 30).")


def test_the_words_tell_which_rights_were_used(measured):
    pair = Comparison(measured([1] * 20, realtime=False), measured([1] * 20, realtime=False))
    assert explain(pair).startswith("Without real-time rights")
