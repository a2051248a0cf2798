import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.program.structured_text.syntax.tree import ProgramUnit

from ..cases import cases
from .shapes import body, body_findings, parse


@pytest.mark.parametrize(("text", "expected"), cases("statements.txt"))
def test_statements(text: str, expected: str) -> None:
    assert body(text) == expected


@pytest.mark.parametrize(("text", "expected"), cases("statement_errors.txt"))
def test_errors(text: str, expected: str) -> None:
    assert "\n".join(body_findings(text)) == expected


def test_after_an_error_the_other_statements_are_there() -> None:
    file = parse("PROGRAM _CYCLIC\na := ;\nb := 1;\nIF c d THEN\ne := 2;\nEND_IF\nf;\nEND_PROGRAM")
    (unit,) = file.units
    assert isinstance(unit, ProgramUnit)
    assert len(unit.body) == 3
    assert file.diagnostics.error_count == 2


@pytest.mark.parametrize(
    "text",
    [
        "IF a THEN ",
        "CASE a OF 1: ",
        "FOR i := 1 TO 2 DO ",
        "REPEAT ",
        "WHILE a DO\n",
        "a := (",
        "a[",
        "f(",
        "a := NOT ",
        "CASE x OF y[1",
        "END_IF ",
        "a := b := ",
        "a.",
    ],
)
def test_deep_nesting_is_an_error_and_takes_linear_time(text: str) -> None:
    found = body_findings(text * 10_000)
    assert found  # no RecursionError: that would be a crash
    assert len(found) <= 20


PIECES = [
    *("IF", "THEN", "ELSE", "ELSIF", "END_IF", "CASE", "OF", "END_CASE", "FOR", "TO", "BY", "DO"),
    *("END_FOR", "WHILE", "END_WHILE", "REPEAT", "UNTIL", "END_REPEAT", "EXIT", "RETURN", "ACCESS"),
    *("PROGRAM", "END_PROGRAM", "ACTION", "END_ACTION", "VAR", "END_VAR", "TYPE", "END_TYPE"),
    *("FUNCTION_BLOCK", "END_FUNCTION_BLOCK", "STRUCT", "END_STRUCT", "METHOD", "STEP", "AND"),
    *("a", "b.c", "1", "2.5", "'x'", "'", "T#1s", ":", ":=", ";", ",", "..", "(", ")", "[", "]"),
    *("+", "-", "=", "=>", "^", "#", "#if 1", "#endif", "#else", "(*", "*)", "//", "\n", "\0", "é"),
]


@given(st.lists(st.sampled_from(PIECES), max_size=60))
def test_any_text_gives_a_tree_and_findings_inside_it(pieces: list[str]) -> None:
    text = " ".join(pieces)
    file = parse(text)
    lines = text.count("\n") + 1
    assert all(1 <= record.line <= lines for record in file.diagnostics.records)
