"""Which files declare something, told without parsing them."""

import pytest

from plcsim.program.structured_text.sources import UnitFile
from st_types.syntax.source import Source


@pytest.fixture(autouse=True)
def cache(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))


def unit_file(text):
    return UnitFile(Source("a.st", text))


@pytest.mark.parametrize(
    ("text", "declares"),
    [
        ("PROGRAM _CYCLIC\nvarX := typeOf; function_1 := 2;\nEND_PROGRAM", False),
        ("PROGRAM p Var x : INT; end_var END_PROGRAM", True),
        ("(* VAR *) // TYPE\n/* FUNCTION */ ACTION a: s := 'VAR'; END_ACTION", False),
        ("ACTION a: s := '$' VAR'; END_ACTION", False),
        ("ACTION a: s := '(*'; END_ACTION\nFUNCTION f : INT END_FUNCTION (* *)", True),
        ("ACTION a: END_ACTION (* not closed VAR", True),
        ("type T : INT; end_type", True),
        ("VAR_GLOBAL x : INT; END_VAR", True),
        ("FUNCTION_BLOCK F END_FUNCTION_BLOCK", True),
        ("CONFIGURATION c END_CONFIGURATION", True),
    ],
)
def test_words_outside_of_comments_and_strings_tell(text, declares):
    assert unit_file(text).may_declare is declares


def test_a_sound_file_that_declares_nothing_is_parsed_once(monkeypatch):
    text = "PROGRAM _CYCLIC\nx := 1;\nEND_PROGRAM\n"
    assert unit_file(text).declarations().items == []
    monkeypatch.setattr(UnitFile, "parsed", None)
    assert unit_file(text).declarations().items == []


def test_errors_are_in_the_declarations_each_time():
    text = "PROGRAM _CYCLIC\nx := ;\nEND_PROGRAM\n"
    for _ in range(2):
        assert unit_file(text).declarations().diagnostics.error_count == 1
