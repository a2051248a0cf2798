"""Which PROGRAMs others name."""

import pytest

from plcsim.program.structured_text.program_uses import program_uses

OTHER = "PROGRAM Two VAR n : INT; END_VAR n := 1; END_PROGRAM\n"


def uses(body: str, other: str = OTHER) -> tuple[list[str], list[str]]:
    found = program_uses([f"PROGRAM one VAR x : INT; {body} END_PROGRAM", other])
    return sorted(found.called), sorted(found.named)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("END_VAR two(n := 1);", (["TWO"], ["TWO"])),
        ("END_VAR Two ;", (["TWO"], ["TWO"])),
        ("END_VAR CASE x OF 1: Two(); END_CASE", (["TWO"], ["TWO"])),
        ("END_VAR x := two.n;", ([], ["TWO"])),
        ("END_VAR x := 1; ONE.x := 2;", ([], [])),
        ("END_VAR (* Two(); *) // Two();\n x := 'Two();';", ([], [])),
        ("two : TON; END_VAR two(IN := TRUE); x := two.Q;", ([], [])),
        ("END_VAR x.two := 1; s.Two();", ([], [])),
        ("END_VAR END_PROGRAM ACTION Two.run: x := 1; END_ACTION PROGRAM three", ([], [])),
    ],
)
def test_names_before_calls_and_members_count(body, expected):
    assert uses(body) == expected


def test_a_program_may_stand_right_behind_another():
    text = "PROGRAM a END_PROGRAM\nPROGRAM b VAR n : INT; END_VAR END_PROGRAM\nPROGRAM c b();"
    assert program_uses([text]).called == {"B"}


def test_a_configuration_names_tasks_of_programs():
    text = (
        "CONFIGURATION c PROGRAM i WITH t : Two; PROGRAM j WITH t : Two(n := 1); END_CONFIGURATION"
    )
    assert uses("END_VAR", OTHER + text) == ([], [])


@pytest.mark.parametrize("part", ["METHOD m : INT END_METHOD", "VAR_IN_OUT a : INT; END_VAR"])
def test_what_only_function_blocks_have_makes_one_of_a_program(part):
    assert program_uses([f"PROGRAM one {part} END_PROGRAM"]).named == {"ONE"}
    assert program_uses([f"FUNCTION_BLOCK f {part} END_FUNCTION_BLOCK {OTHER}"]).named == set()


def test_function_blocks_name_programs_too():
    text = "FUNCTION_BLOCK f VAR n : INT; END_VAR n := Two.n; END_FUNCTION_BLOCK\n"
    assert program_uses([OTHER, "PROGRAM One END_PROGRAM", text]).named == {"TWO"}


def test_units_of_automation_studio_are_no_programs():
    texts = ["PROGRAM _INIT END_PROGRAM", "PROGRAM _CYCLIC _init(); END_PROGRAM"]
    assert program_uses(texts).named == set()
