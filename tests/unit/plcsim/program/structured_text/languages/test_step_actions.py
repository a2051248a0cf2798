"""Actions with qualifiers: in which cycles they run."""

import pytest

from .chart_run import chart

TEXT = """
INITIAL_STEP Idle: END_STEP
TRANSITION FROM Idle TO Work := go; END_TRANSITION
STEP Work: act({qualifier}); END_STEP
TRANSITION FROM Work TO After := NOT go; END_TRANSITION
STEP After: END_STEP
TRANSITION FROM After TO Clear := clear; END_TRANSITION
STEP Clear: act(R); END_STEP
"""


def cycles_of(text: str, declared: str, name: str, count: int = 12) -> str:
    """Run: Work is active in cycles 2 to 6, Clear from cycle 10 on; tell when the action runs."""
    run = chart(text, f"VAR go, clear : BOOL; {declared} END_VAR")
    found = []
    for cycle in range(count):
        run["go"] = 2 <= cycle < 7
        run["clear"] = cycle >= 10
        before = run[name]
        run.cycles()
        value = run[name]
        found.append(value if isinstance(value, bool) else value != before)
    return "".join("x" if each else "." for each in found)


#                     012345678901
BOOLEAN = {
    "N": "..xxxxx.....",
    "S": "..xxxxxxxx..",
    "P": "..x.........",
    "P1": "..x.........",
    "P0": ".......x....",
    "L, T#30ms": "..xxx.......",
    "D, T#20ms": "....xxx.....",
    "SD, T#60ms": "........xx..",
    "DS, T#20ms": "....xxxxxx..",
    "DS, T#90ms": "............",
    "SL, T#60ms": "..xxxxxx....",
    "R": "............",
}


@pytest.mark.parametrize("qualifier", BOOLEAN)
def test_a_variable_gets_q(qualifier: str) -> None:
    text = TEXT.format(qualifier=qualifier)
    assert cycles_of(text, "act : BOOL;", "act") == BOOLEAN[qualifier]


ACTION = {
    "N": "..xxxxxx....",
    "S": "..xxxxxxxxx.",
    "P": "..xx........",
    "P1": "..x.........",
    "P0": ".......x....",
    "L, T#30ms": "..xxxx......",
    "SL, T#60ms": "..xxxxxxx...",
}


@pytest.mark.parametrize("qualifier", ACTION)
def test_an_action_runs_once_more_at_its_end(qualifier: str) -> None:
    action = "ACTION act: n := n + 1; END_ACTION"
    text = TEXT.format(qualifier=qualifier) + action
    assert cycles_of(text, "n : INT;", "n") == ACTION[qualifier]


def test_steps_share_an_action() -> None:
    run = chart(
        """INITIAL_STEP A: lamp(N, seen); horn(P1); END_STEP
        TRANSITION FROM A TO B := TRUE; END_TRANSITION
        STEP B: lamp(N); horn(N); END_STEP
        TRANSITION FROM B TO C := TRUE; END_TRANSITION
        STEP C: END_STEP""",
        "VAR lamp, horn : BOOL; END_VAR",
    )
    found = [(run.cycles()["lamp"], run["horn"]) for _ in range(3)]
    assert found == [(True, True), (True, True), (False, False)]
