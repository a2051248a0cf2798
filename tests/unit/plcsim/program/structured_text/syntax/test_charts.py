"""Parsing the elements of charts: what is wrong in them."""

import pytest

from .shapes import findings

PAIR = "INITIAL_STEP A: END_STEP STEP B: END_STEP"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("INITIAL_STEP A: act(L); END_STEP", ["2:21 the qualifier L has no time"]),
        ("INITIAL_STEP A act(N); END_STEP", ["2:16 expected ':' after the name of a step"]),
        (f"{PAIR} TRANSITION FROM A TO B := END_TRANSITION", ["2:69 expected a value"]),
        (f"{PAIR} TRANSITION FROM A := TRUE; END_TRANSITION", ["2:61 expected 'TO' behind"]),
        (f"{PAIR} TRANSITION FROM (A B) TO A := TRUE; END_TRANSITION", ["2:62 expected ')'"]),
        (
            f"{PAIR} TRANSITION t (PRIORITY := x) FROM A TO B := TRUE; END_TRANSITION",
            ["2:70 expected a number as PRIORITY"],
        ),
        ("INITIAL_STEP A: n := 1;", ["3:1 expected END_STEP of the INITIAL_STEP in line 2"]),
        (f"{PAIR} TRANSITION FROM A TO B := TRUE;", ["3:1 expected 'END_TRANSITION'"]),
    ],
)
def test_what_is_wrong(text: str, expected: list[str]) -> None:
    found = findings(f"PROGRAM p\n{text}\nEND_PROGRAM")
    assert len(found) == len(expected), found
    for each, start in zip(found, expected, strict=True):
        assert each.startswith(start), found


def test_a_chart_stands_in_a_unit() -> None:
    found = findings("INITIAL_STEP A: END_STEP\nTRANSITION FROM A TO A := TRUE; END_TRANSITION")
    assert found == [
        "1:1 a INITIAL_STEP stands in a PROGRAM or a FUNCTION_BLOCK",
        "2:1 a TRANSITION stands in a PROGRAM or a FUNCTION_BLOCK",
    ]
