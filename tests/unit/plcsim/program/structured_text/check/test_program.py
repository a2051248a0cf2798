import pytest

from plcsim.program.structured_text.codes import Code

from ..cases import cases
from ..running import checked


@pytest.mark.parametrize(("text", "expected"), cases("unit_findings.txt"))
def test_findings(text: str, expected: str) -> None:
    assert "\n".join(checked(text)[2]) == expected


def test_warnings_can_be_hidden() -> None:
    text = "PROGRAM _CYCLIC VAR i : INT; d : DINT; END_VAR i := d; i; END_PROGRAM"
    assert len(checked(text)[2]) == 2
    assert len(checked(text, hidden=[Code.NARROWED])[2]) == 1


def test_variables_that_nothing_uses_are_told_on_demand() -> None:
    text = """
FUNCTION_BLOCK B VAR_INPUT i : INT; END_VAR VAR n, zzEdge00000 : BOOL; END_VAR END_FUNCTION_BLOCK
FUNCTION f : INT VAR x, y : INT; END_VAR f := x; END_FUNCTION
PROGRAM p VAR a, b : INT; c : B; END_VAR VAR CONSTANT K : INT := 1; END_VAR a := 1; END_PROGRAM
"""
    assert checked(text, hidden=[])[2] == [
        "2:49 ST5002 nothing uses n",
        "3:25 ST5002 nothing uses y",
        "4:18 ST5002 nothing uses b",
        "4:27 ST5002 nothing uses c",
        "4:55 ST5002 nothing uses K",
    ]
