from hypothesis import given
from hypothesis import strategies as st

from crosnode.node.period import Period


def test_no_period_is_never_due() -> None:
    assert not any(Period(0).is_due(now) for now in range(5))


@given(st.integers(1, 50), st.lists(st.integers(0, 200), min_size=1))
def test_due_once_for_each_point_that_was_seen(period_ns: int, steps: list[int]) -> None:
    period, now_ns, points = Period(period_ns), 1_000, set()
    for step in steps:
        now_ns += step
        if period.is_due(now_ns):
            points.add(now_ns)
    start_ns = 1_000 + steps[0]
    seen, now_ns = {}, 1_000
    for step in steps:
        now_ns += step
        seen.setdefault((now_ns - start_ns) // period_ns, now_ns)
    assert points == set(seen.values())
