"""Each pause is twice the one before, up to the longest."""

from plcsim.core.backoff import Backoff


def test_pauses_grow_to_the_longest() -> None:
    backoff = Backoff(20, 100)
    assert backoff.is_due(0)
    now_ns, pauses = 0, []
    for _ in range(5):
        backoff.failed(now_ns)
        pause = next(ns for ns in range(1, 1_000) if backoff.is_due(now_ns + ns))
        pauses.append(pause)
        now_ns += pause
    assert pauses == [20, 40, 80, 100, 100]


def test_after_a_success_it_is_the_first_pause_again() -> None:
    backoff = Backoff(20, 100)
    backoff.failed(0)
    backoff.failed(20)
    backoff.succeeded()
    assert backoff.is_due(21)
    backoff.failed(21)
    assert not backoff.is_due(40)
    assert backoff.is_due(41)
