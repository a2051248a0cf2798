import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.resolve.constants import EvaluationError, evaluate
from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.expressions import ExpressionParser
from st_types.syntax.lexer import Tokens
from st_types.syntax.literals import Constant
from st_types.syntax.source import Source

KNOWN = {
    "MAX": Constant("UINT", 10),
    "RATE": Constant("REAL", 0.5),
    "NAME": Constant("STRING", "x"),
    "ON": Constant("BOOL", value=True),
    "COLOUR.RED": Constant("Colour", 3),
}


class Known:
    level = 0

    def constant(self, name: str, at: int) -> Constant | None:
        assert at >= 0
        return KNOWN.get(name.upper())


def value_of(text: str) -> Constant:
    source = Source("a", text)
    expression = ExpressionParser(Tokens(source), DiagnosticLog(source)).expression()
    return evaluate(expression, Known())


@pytest.mark.parametrize(
    ("text", "type_name", "value"),
    [
        ("5", "ANY_INT", 5),
        ("-5", "ANY_INT", -5),
        ("+5", "ANY_INT", 5),
        ("Max - 1", "UINT", 9),
        ("1 - MAX", "UINT", -9),
        ("2 * MAX + 1", "UINT", 21),
        ("7 / 2", "ANY_INT", 3),
        ("-7 / 2", "ANY_INT", -3),
        ("-7 MOD 2", "ANY_INT", -1),
        ("7 MOD 0", "ANY_INT", 0),
        ("7 / 2.0", "ANY_REAL", 3.5),
        ("7 * RATE", "REAL", 3.5),
        ("2 ** 10", "ANY_INT", 1024),
        ("2 ** -1", "ANY_REAL", 0.5),
        ("2.0 ** 3", "ANY_REAL", 8.0),
        ("16#F0 AND 16#3C", "ANY_INT", 0x30),
        ("16#F0 OR 1", "ANY_INT", 0xF1),
        ("5 XOR 1", "ANY_INT", 4),
        ("NOT 0", "ANY_INT", -1),
        ("NOT ON", "BOOL", False),
        ("ON AND FALSE", "BOOL", False),
        ("MAX > 3", "BOOL", True),
        ("1 = 1.0", "BOOL", True),
        ("Colour.red", "Colour", 3),
        ("Colour#red + 1", "Colour", 4),
        ("NAME", "STRING", "x"),
        ("T#1s * 2", "TIME", 2000),
        ("T#1m - T#1s", "TIME", 59_000),
    ],
)
def test_values(text: str, type_name: str, value: object) -> None:
    found = value_of(text)
    assert found == Constant(type_name, value)
    assert type(found.value) is type(value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 / 0", "division by zero"),
        ("1.0 / 0", "division by zero"),
        ("0 ** -1", "cannot be worked out"),
        ("1 + NAME", "cannot be applied to a string"),
        ("-NAME", "- cannot be applied to 'x'"),
        ("-ON", "- cannot be applied to True"),
        ("NOT 1.5", "NOT cannot be applied to 1.5"),
        ("1.5 AND 2", "cannot be worked out"),
        ("1.5 MOD 2", "cannot be worked out"),
        ("2 ** 64", "out of range"),
        ("2 ** 2 ** 30 ** 30", "cannot be worked out|out of range"),
        ("16#FFFF_FFFF_FFFF_FFFF * 2", "out of range"),
        ("1.0E308 * 10", "out of range"),
        ("ADR(x)", "a constant was expected"),
        ("a[1]", "a constant was expected"),
        ("%IX0.0", "a constant was expected"),
    ],
)
def test_errors(text: str, message: str) -> None:
    with pytest.raises(EvaluationError, match=message):
        value_of(text)


def test_an_unknown_name_is_told_apart() -> None:
    with pytest.raises(EvaluationError, match="no constant is called LIMIT") as caught:
        value_of("MAX + LIMIT")
    assert (caught.value.unknown_name, caught.value.at) == ("LIMIT", 2)


@given(st.integers(-(2**63), 2**63), st.integers(-(2**31), 2**31), st.sampled_from("+-*/"))
def test_integers_are_exact_or_refused(a: int, b: int, sign: str) -> None:
    exact = {"+": a + b, "-": a - b, "*": a * b, "/": abs(a) // abs(b) if b else 0}[sign]
    if sign == "/" and (a < 0) != (b < 0):
        exact = -exact
    try:
        assert value_of(f"({a}) {sign} ({b})").value == exact
    except EvaluationError:
        assert not -(2**63) <= min(a, exact) <= max(a, exact) < 2**64 or (sign, b) == ("/", 0)
