"""Files .sfc of Automation Studio."""

import pytest

from plcsim.program.structured_text.languages.chart_file import parse_chart_file
from plcsim.program.structured_text.languages.charts import with_charts
from plcsim.program.structured_text.syntax.tree import ProgramUnit, StepUnit, TransitionUnit
from st_types.syntax.source import Source

FILE = """\
PROGRAM _CYCLIC
(* @LANGUAGE := 'sfc' *)
INITIAL_STEP Init:
(* @LANGUAGE := 'st' *)
n := 1;
END_STEP
(* @SFCMAXTIME := '' *)
(* @SFCMINTIME := '' *)
(* @SFCCOMMENT := 'says what it does' *)
TRANSITION //All ready? FROM Init TO (Work,Watch):=
(* @LANGUAGE := 'st' *)
ready AND
NOT stop //never
END_TRANSITION
(* @SFCNOJUMP := 'Work' *)
(* @SFCNOJUMP := 'Watch' *)
STEP Work:
END_STEP
ENTRY_ACTION
(* @LANGUAGE := 'st' *)
n := 2;
END_ACTION
EXIT_ACTION
n := 3;
END_ACTION
STEP Watch:
END_STEP
TRANSITION Back FROM the start FROM (Work,Watch) TO Init:=
TRUE
END_TRANSITION
(* @SFCISJUMP := 'Init' *)
END_PROGRAM
"""


def test_the_elements_of_a_file_and_their_lines() -> None:
    file = parse_chart_file(Source("Cyclic.sfc", FILE))
    file.diagnostics.raise_errors()
    (unit,) = file.units
    assert isinstance(unit, ProgramUnit)
    steps = [each for each in unit.parts if isinstance(each, StepUnit)]
    found = [(each.name, file.location(each).line) for each in steps]
    assert found == [("Init", 3), ("Work", 17), ("Watch", 26)]
    assert [len(each.body) for each in steps] == [1, 0, 0]
    assert file.location(steps[1].entry[0]).line == 21
    assert file.location(steps[1].exit[0]).line == 24
    transitions = [each for each in unit.parts if isinstance(each, TransitionUnit)]
    assert [[name.name for name in each.sources] for each in transitions] == [
        ["Init"],
        ["Work", "Watch"],
    ]
    assert str(file.location(transitions[0].targets[1])) == "Cyclic.sfc:10:44"


def test_the_state_is_declared_and_no_var_block_of_the_file() -> None:
    file = with_charts(parse_chart_file(Source("Cyclic.sfc", FILE)))
    names = [each.name for block in file.hidden for each in block.declarations]
    assert names == ["Init", "Work", "Watch", "zzSfc_CYCLIC"]
    (unit,) = file.units
    assert isinstance(unit, ProgramUnit)
    assert not unit.blocks


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("MINTIME := ''", "MINTIME := 't#5s'", "8:1 the least time of a step, t#5s"),
        ("MAXTIME := ''", "MAXTIME := 't#5s'", "7:1 the most time of a step, t#5s"),
        ("'st' *)\nready", "'ld' *)\nready", "11:1 a body in the language ld"),
        ("SFCNOJUMP := 'Work'", "SFCMACRO := 'Work'", "15:1 @SFCMACRO is not known"),
        ("TO Init", "Init", "28:26 expected 'TO' behind the steps of a transition"),
        ("ready AND", "AND", "12:1 expected a value"),
        ("NOT stop //never", "NOT", "14:1 expected a value"),
        ("STEP Work:", "STEP 5:", "17:6 expected ':=' or ';'"),
    ],
)
def test_what_is_wrong_in_a_file(old: str, new: str, expected: str) -> None:
    assert FILE.count(old) == 1
    file = parse_chart_file(Source("Cyclic.sfc", FILE.replace(old, new)))
    records = file.diagnostics.records
    found = [f"{each.line}:{each.column} {each.message}" for each in records]
    assert any(each.startswith(expected) for each in found), found
