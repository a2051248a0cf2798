import pytest

from plcsim.program.structured_text.syntax.condition import ConditionError, evaluate_condition

MACROS = {"N": "5", "EMPTY": "", "SUM": "N + 1", "LOOP": "LOOP"}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1", True),
        ("0", False),
        ("N", True),
        ("UNKNOWN", False),
        ("EMPTY", False),
        ("SUM == 6", True),
        ("0x1F == 31", True),
        ("(N > 4) && !(N >= 6) || 0", True),
        ("1 + 2 * 3 == 7 && 7 % 4 == 3 && 7 / 2 == 3", True),
        ("-1 < 0 && ~0 == -1 && +1", True),
        ("(6 & 3) == 2 && (6 | 1) == 7 && (6 ^ 2) == 4", True),
        ("2 != 2 || 3 <= 2", False),
        ("defined(N) && defined EMPTY && !defined(UNKNOWN)", True),
        ("1 || 0 && 0", True),
    ],
)
def test_conditions(text: str, expected: bool) -> None:
    assert evaluate_condition(text, MACROS.get) is expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected a value"),
        ("1 2", "expected an operator in the condition, found '2'"),
        ("(1", r"expected '\)'"),
        ("1 / 0", "division by zero"),
        ("a $ b", r"'\$' does not belong"),
        ("defined(", "expected a name after defined"),
        ("LOOP", "the macro LOOP leads back to itself"),
        ("(" * 100 + "1" + ")" * 100, "nested more than 32 levels"),
        ("!" * 1000 + "1", "nested more than 32 levels"),
    ],
)
def test_what_is_no_condition(text: str, message: str) -> None:
    with pytest.raises(ConditionError, match=message):
        evaluate_condition(text, MACROS.get)
