"""What the player beside the scan takes from the master."""

import pytest

from crosnode.plc.play_service import _subscribed

GOOD = [[], [["/in", ["/cell", "/player"]], ["/own", ["/player"]], ["/none", []]], []]


def test_topics_count_that_others_subscribe_to() -> None:
    assert _subscribed(GOOD, "/player") == {"/in"}


@pytest.mark.parametrize(
    "answer",
    [None, 5, "state", [], [[], []], [[], 5, []], [[], [5], []], [[], [["/in"]], []],
     [[], [[5, ["/cell"]]], []], [[], [["/in", 5]], []]],
)  # fmt: skip
def test_an_answer_that_is_none_is_nothing(answer: object) -> None:
    assert _subscribed(answer, "/player") == set()
