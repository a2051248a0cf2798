import pytest

from plcsim.testing import PlcTestError
from plcsim.testing.instructions import exceeded, summary_of

COUNTED = {"Belt": [100] * 98 + [130, 400], "Lift": [50] * 100}


def test_limits_that_hold():
    assert exceeded(COUNTED, {"worst": 400, "p99": 130, "p50": 100}, "belt", "x") == []
    assert exceeded(COUNTED, {"p50": 100}) == []


def test_what_is_over_is_told_with_its_cycle():
    worst, median = exceeded(COUNTED, {"worst": 399, "p50": 99}, "belt")
    head = "program Belt is over its budget:"
    assert worst == f"{head} worst of 100 cycles is 400 instructions (in cycle 100), limit 399"
    assert median == f"{head} p50 of 100 cycles is 100 instructions, limit 99"
    assert len(exceeded(COUNTED, {"worst": 49})) == 2


@pytest.mark.parametrize(
    ("counted", "limits", "program", "text"),
    [
        (COUNTED, {"worst": 1}, "pump", "x: no instructions are counted of pump; they are of Belt"),
        ({}, {"worst": 1}, "", "x: no instructions are counted of any program: only compiled"),
        (COUNTED, {"best": 1}, "", "x: best: give one of p50"),
        ({"Belt": [1] * 99}, {"p99": 1}, "", "x: p99 needs 100 cycles at least; Belt ran 99"),
        ({"Belt": []}, {"worst": 1}, "", "x: worst needs 1 cycles at least; Belt ran 0"),
    ],
)
def test_what_cannot_be_asked(counted, limits, program, text):
    with pytest.raises(PlcTestError) as caught:
        exceeded(counted, limits, program, "x")
    assert str(caught.value).startswith(text)


def test_the_summary_is_exact():
    found = summary_of(COUNTED["Belt"])
    assert sum(count for _, count in found.pop("histogram")) == 100
    assert found == {
        "total": 10_330,
        "p50": 100,
        "p99": 130,
        "maximum": 400,
        "maximum_cycle": 100,
    }
