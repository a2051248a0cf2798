import pytest

from plcsim.program.structured_text.syntax.parser import parse_structured_text
from plcsim.program.structured_text.syntax.tree import ActionUnit
from st_types.syntax.source import Source

from .shapes import findings, parse, shapes


def test_comments_may_be_nested_where_the_file_does_not_parse_otherwise() -> None:
    file = parse("ACTION a:\n(* outer (* inner *) still *)\nx := 1;\nEND_ACTION")
    assert not file.diagnostics.error_count
    (unit,) = file.units
    assert isinstance(unit, ActionUnit)
    assert shapes(unit.body) == "x := 1;"
    assert file.location(unit.body[0]).line == 3


@pytest.mark.parametrize(
    "data",
    [
        bytes(range(256)) * 20,
        "ACTION a: x := 1; END_ACTION".encode("utf-16-le"),
        b"\0" * 100,
    ],
)
def test_what_is_no_text_is_told_in_one_finding(data: bytes) -> None:
    file = parse_structured_text(Source.decode("a.st", data))
    (record,) = file.diagnostics.records
    assert (record.line, record.column, record.message) == (1, 1, "the file is no text")
    assert "encrypted" in record.hint
    assert file.units == []


def test_utf_16_with_a_byte_order_mark_is_text() -> None:
    file = parse_structured_text(Source.decode("a.st", "ACTION a: x; END_ACTION".encode("utf-16")))
    assert not file.diagnostics.records
    assert len(file.units) == 1


def test_a_single_control_character_is_a_finding_at_its_place() -> None:
    assert findings("ACTION a:\nx := 1;\0\nEND_ACTION") == [
        "2:8 expected a statement, found the character U+0000"
    ]


@pytest.mark.parametrize(
    "text",
    [
        "ACTION a: x := '" + "y" * 1_000_000,
        "ACTION a: " + "x := 1; " * 100_000 + "END_ACTION",
        "ACTION a: x := " + "y + " * 200_000 + "1; END_ACTION",
        "ACTION a: x := " + "9" * 1_000_000 + "; END_ACTION",
        "(" * 1_000_000,
        "'" * 1_000_001,
        "(*" * 300_000,
        "#if 1\n" * 100_000,
    ],
    ids=["string", "line", "operators", "digits", "brackets", "quotes", "comments", "directives"],
)
def test_a_megabyte_of_anything_ends(text: str) -> None:
    file = parse(text)
    assert len(file.diagnostics.records) <= 20


def test_half_a_file_is_told_where_it_ends() -> None:
    whole = "PROGRAM _CYCLIC\nIF a THEN\nx := f(1, 2);\nEND_IF\nEND_PROGRAM\n"
    for end in range(9, len(whole) - len("END_PROGRAM\n") + 5):
        assert findings(whole[:end]), whole[:end]
