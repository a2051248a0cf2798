import pytest

from st_types.syntax.trivia import (
    comments_before,
    comments_behind,
    notes_before,
    notes_behind,
    open_comment,
    pragmas_behind,
    pragmas_in,
)

TRIVIA = " (*speed*) (*#CMD*) {P}\r\n\t// next\n\t(* of two\n lines *)\n\t{Q} "


def test_comments_on_the_same_line_stand_behind() -> None:
    assert comments_behind(TRIVIA) == ("(*speed*)", "(*#CMD*)")
    assert comments_before(TRIVIA) == ("// next", "(* of two\n lines *)")


def test_pragmas_are_notes_too() -> None:
    assert notes_behind(TRIVIA) == ("(*speed*)", "(*#CMD*)", "{P}")
    assert notes_before(TRIVIA) == ("// next", "(* of two\n lines *)", "{Q}")
    assert pragmas_behind(TRIVIA) == ("{P}",)


def test_blanks_hold_no_comment() -> None:
    assert comments_behind(" \n\t") == comments_before(" \n\t") == ()


def test_pragmas_outside_comments() -> None:
    assert pragmas_in(TRIVIA + "(*{no}*) // {no}") == ("{P}", "{Q}")
    assert pragmas_in(" (*x*)") == ()


@pytest.mark.parametrize(
    ("trivia", "place"),
    [
        ("", None),
        ("(* x *)", None),
        ("// (* x", None),
        (" (* x", 1),
        ("(*)", 0),
        ("/* x */ /*", 8),
        ("/*/", 0),
        ("(* x *) {y} ", None),
    ],
)
def test_open_comments(trivia: str, place: int | None) -> None:
    assert open_comment(trivia) == place
