import pytest

from plcsim.program.structured_text.check.program import check_program
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source

from ..cases import cases
from ..running import checked


@pytest.mark.parametrize(("text", "expected"), cases("unit_findings.txt"))
def test_findings(text: str, expected: str) -> None:
    assert "\n".join(checked(text)[2]) == expected


def test_warnings_can_be_hidden() -> None:
    text = "PROGRAM _CYCLIC VAR i : INT; d : DINT; END_VAR i := d; i; END_PROGRAM"
    assert len(checked(text)[2]) == 2
    assert len(checked(text, hidden=[FindingCode.NARROWED])[2]) == 1


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


def test_what_is_near_hides_what_is_far_variables_and_values_of_enumerations_alike() -> None:
    outer = parse_declarations(
        Source("outer.var", "VAR CONSTANT IDLE : INT := 7; END_VAR VAR START : INT; END_VAR")
    )
    inner = parse_declarations(
        Source("inner.typ", "TYPE Step : (IDLE, START); END_TYPE VAR s : Step; END_VAR")
    )
    file = parse_structured_text(
        Source("a.st", "PROGRAM _CYCLIC CASE s OF IDLE: ; 7: ; START: ; END_CASE END_PROGRAM")
    )
    scope = Scope("program", [inner], [Scope("project", [outer])])
    program = check_program("program", [file], scope)
    assert not file.diagnostics.records
    (case,) = program.bodies[0].statements
    assert [element.ranges for element in case.elements] == [[(0, 0)], [(7, 7)], [(1, 1)]]


def test_actions_of_a_block_may_stand_in_a_file_of_their_own() -> None:
    declared = parse_declarations(
        Source(
            "a.fun",
            "".join(
                f"FUNCTION_BLOCK {name} VAR n : INT; END_VAR END_FUNCTION_BLOCK " for name in "ABC"
            ),
        )
    )
    bodies = "FUNCTION_BLOCK A count; END_FUNCTION_BLOCK FUNCTION_BLOCK B count; END_FUNCTION_BLOCK"
    files = [
        parse_structured_text(Source(name, text))
        for name, text in {
            "a.st": bodies,
            "actions.st": "ACTION count: n := n + 1; twice; END_ACTION "
            "ACTION twice: n := n + 2; END_ACTION ACTION never: END_ACTION",
        }.items()
    ]
    program = check_program("library", files, Scope("library", [declared]))
    assert [(body.kind, body.name, body.block and body.block.name) for body in program.bodies] == [
        ("block", "A", "A"),
        ("action", "count", "A"),
        ("action", "twice", "A"),
        ("block", "B", "B"),
        ("action", "count", "B"),
        ("action", "twice", "B"),
    ]
    assert [record.message for file in files for record in file.diagnostics.records] == [
        "nothing calls the action never; it is not compiled"
    ]


def test_an_action_behind_a_program_belongs_to_it_whatever_stands_before() -> None:
    text = """
FUNCTION_BLOCK B VAR n : INT; END_VAR END_FUNCTION_BLOCK
PROGRAM _CYCLIC count; END_PROGRAM
ACTION count: n := n + 1; END_ACTION
VAR n : INT; END_VAR
"""
    assert not checked(text)[2]
