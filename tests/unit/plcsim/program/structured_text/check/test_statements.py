import pytest

from ..cases import cases
from ..running import checked

DECLARATIONS = """
TYPE Point : STRUCT x : INT; y : INT; END_STRUCT; Colour : (RED, GREEN, BLUE); END_TYPE
VAR CONSTANT LIMIT : INT := 10; END_VAR
FUNCTION_BLOCK TON
    VAR_INPUT IN : BOOL; PT : TIME; END_VAR VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
END_FUNCTION_BLOCK
FUNCTION twice : INT VAR_INPUT x : INT; END_VAR END_FUNCTION
FUNCTION nothing VAR_INPUT x : INT; END_VAR END_FUNCTION
"""


def findings(text: str) -> str:
    _, _, found = checked(f"PROGRAM _CYCLIC {text}\nEND_PROGRAM", DECLARATIONS)
    first = len("PROGRAM _CYCLIC ")
    shown = []
    for each in found:
        line, column, rest = each.split(":", 1)[0], *each.split(":", 1)[1].split(" ", 1)
        shown.append(f"{line}:{int(column) - (first if line == '1' else 0)} {rest}")
    return "\n".join(shown)


@pytest.mark.parametrize(("text", "expected"), cases("findings.txt"))
def test_findings(text: str, expected: str) -> None:
    assert findings(text) == expected
