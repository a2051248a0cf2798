"""Steps and transitions: what a cycle does."""

import pytest

from plcsim.program.structured_text.languages.charts import with_charts
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from st_types.syntax.source import Source

from .chart_run import RunningChart, chart


def test_initial_step_runs_a_whole_cycle_whatever_its_transition_says() -> None:
    run = chart(
        """INITIAL_STEP A: n := n + 1; END_STEP
        TRANSITION FROM A TO B := TRUE END_TRANSITION
        STEP B: m := m + 1; END_STEP""",
        "VAR n, m : INT; END_VAR",
    )
    assert run.active("A", "B") == ""
    assert (run.cycles().active("A", "B"), run["n"], run["m"]) == ("A", 1, 0)
    assert (run.cycles().active("A", "B"), run["n"], run["m"]) == ("B", 1, 1)
    assert (run.cycles().active("A", "B"), run["n"], run["m"]) == ("B", 1, 2)


def test_a_chain_goes_on_by_one_step_a_cycle() -> None:
    run = chart(
        """INITIAL_STEP A: END_STEP STEP B: END_STEP STEP C: END_STEP
        TRANSITION FROM A TO B := TRUE; END_TRANSITION
        TRANSITION FROM B TO C := TRUE; END_TRANSITION
        TRANSITION FROM C TO A := TRUE; END_TRANSITION"""
    )
    assert [run.cycles().active("A", "B", "C") for _ in range(5)] == ["A", "B", "C", "A", "B"]


def test_the_first_of_two_transitions_fires() -> None:
    text = """INITIAL_STEP A: END_STEP STEP B: END_STEP STEP C: END_STEP
        TRANSITION t1 {first} FROM A TO B := x; END_TRANSITION
        TRANSITION t2 {second} FROM A TO C := y; END_TRANSITION"""
    declared = "VAR x, y : BOOL; END_VAR"

    def reached(x, y, first="", second=""):
        run = chart(text.format(first=first, second=second), declared).cycles()
        run["x"], run["y"] = x, y
        return run.cycles().active("A", "B", "C")

    assert reached(x=False, y=False) == "A"
    assert reached(x=True, y=False) == "B"
    assert reached(x=False, y=True) == "C"
    assert reached(x=True, y=True) == "B"
    by_number = {"first": "(PRIORITY := 2)", "second": "(PRIORITY := 1)"}
    assert reached(x=True, y=True, **by_number) == "C"
    assert reached(x=True, y=False, **by_number) == "B"


def test_simultaneous_sequences_begin_and_end_together() -> None:
    run = chart(
        """INITIAL_STEP A: END_STEP
        TRANSITION FROM A TO (B, C) := go; END_TRANSITION
        STEP B: END_STEP STEP C: END_STEP STEP D: END_STEP STEP E: END_STEP
        TRANSITION FROM C TO D := on; END_TRANSITION
        TRANSITION FROM (B, D) TO E := TRUE; END_TRANSITION""",
        "VAR go, on : BOOL; END_VAR",
    )
    steps = "ABCDE"
    assert run.cycles(3).active(*steps) == "A"
    run["go"] = True
    assert run.cycles().active(*steps) == "B C"
    assert run.cycles(3).active(*steps) == "B C"  # the end waits for D, whatever its condition
    run["on"] = True
    assert run.cycles().active(*steps) == "B D"
    assert run.cycles().active(*steps) == "E"


def test_conditions_see_what_the_cycle_before_left_active() -> None:
    run = chart(
        """INITIAL_STEP A: END_STEP INITIAL_STEP C: END_STEP STEP B: END_STEP STEP D: END_STEP
        TRANSITION FROM A TO B := TRUE; END_TRANSITION
        TRANSITION FROM C TO D := B.X; END_TRANSITION"""
    )
    found = [run.cycles().active("A", "B", "C", "D") for _ in range(3)]
    assert found == ["A C", "B C", "B D"]


def test_a_step_that_is_left_and_entered_at_once_stays_active() -> None:
    run = chart(
        """INITIAL_STEP A: END_STEP ENTRY_ACTION n := n + 1; END_ACTION
        EXIT_ACTION m := m + 1; END_ACTION
        TRANSITION FROM A TO A := TRUE; END_TRANSITION""",
        "VAR n, m : INT; END_VAR",
    )
    run.cycles(4)
    assert (run["n"], run["m"], run["A.T"]) == (1, 0, 30)


def test_entry_body_and_exit_run_in_order() -> None:
    run = chart(
        """INITIAL_STEP A: log := log * 10 + 2; END_STEP
        ENTRY_ACTION log := log * 10 + 1; END_ACTION
        EXIT_ACTION log := log * 10 + 3; END_ACTION
        TRANSITION FROM A TO B := go; END_TRANSITION
        STEP B: log := log * 10 + 5; END_STEP
        ENTRY_ACTION log := log * 10 + 4; END_ACTION
        EXIT_ACTION log := log * 10 + 6; END_ACTION
        TRANSITION FROM B TO A := TRUE; END_TRANSITION""",
        "VAR log : DINT; go : BOOL; END_VAR",
    )
    assert run.cycles(2)["log"] == 122
    run["go"], run["log"] = True, 0
    assert run.cycles()["log"] == 345
    assert run.cycles()["log"] == 345612


def test_time_of_a_step() -> None:
    run = chart(
        """INITIAL_STEP A: END_STEP STEP B: END_STEP
        TRANSITION FROM A TO B := A.T >= T#30ms; END_TRANSITION
        TRANSITION FROM B TO A := B.T >= T#10ms; END_TRANSITION"""
    )
    found = [(run.cycles().active("A", "B"), run["A.T"], run["B.T"]) for _ in range(7)]
    assert found == [
        ("A", 0, 0),
        ("A", 10, 0),
        ("A", 20, 0),
        ("B", 30, 0),
        ("A", 0, 10),
        ("A", 10, 10),
        ("A", 20, 10),
    ]


def test_return_leaves_one_body_only() -> None:
    run = chart(
        """INITIAL_STEP A: IF TRUE THEN RETURN; END_IF n := 1; END_STEP
        INITIAL_STEP B: m := m + 1; END_STEP
        TRANSITION FROM A TO C := TRUE; END_TRANSITION
        STEP C: END_STEP""",
        "VAR n, m : INT; END_VAR",
    )
    assert run.cycles(2).active("A", "B", "C") == "B C"
    assert (run["n"], run["m"]) == (0, 2)


def test_statements_before_a_chart_and_calls_of_actions_beside_it() -> None:
    run = RunningChart(
        """PROGRAM _CYCLIC
        before := before + 1;
        INITIAL_STEP A: Beside; END_STEP
        END_PROGRAM
        ACTION Beside: IF A.X THEN beside := beside + 1; END_IF END_ACTION""",
        "VAR before, beside : INT; END_VAR",
    )
    run.cycles(3)
    assert (run["before"], run["beside"]) == (3, 3)


def test_each_instance_of_a_block_has_a_chart_of_its_own() -> None:
    run = RunningChart(
        """FUNCTION_BLOCK Door
        VAR_INPUT open : BOOL; END_VAR
        VAR_OUTPUT is_open : BOOL; END_VAR
        INITIAL_STEP Closed: is_open := FALSE; END_STEP
        STEP Opened: is_open := TRUE; END_STEP
        TRANSITION FROM Closed TO Opened := open; END_TRANSITION
        TRANSITION FROM Opened TO Closed := NOT open; END_TRANSITION
        END_FUNCTION_BLOCK
        PROGRAM _CYCLIC
        left(open := TRUE); right(open := FALSE);
        END_PROGRAM""",
        "VAR left, right : Door; END_VAR",
    )
    run.cycles(2)
    assert (run["left.is_open"], run["right.is_open"]) == (True, False)
    assert run.active("left.Closed", "left.Opened", "right.Closed") == "left.Opened right.Closed"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("STEP A: END_STEP", "1:9 the chart has no INITIAL_STEP"),
        ("TRANSITION FROM A TO A := TRUE; END_TRANSITION", "1:9 the chart has no INITIAL_STEP"),
        (
            "INITIAL_STEP A: END_STEP TRANSITION FROM A TO B := TRUE; END_TRANSITION",
            "2:47 there is no step B",
        ),
        ("INITIAL_STEP A: END_STEP STEP A: END_STEP", "2:31 the step A is there twice"),
    ],
)
def test_what_is_no_chart(text: str, expected: str) -> None:
    source = Source("a.st", f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM")
    file = with_charts(parse_structured_text(source))
    found = [f"{each.line}:{each.column} {each.message}" for each in file.diagnostics.records]
    assert expected in found


def test_a_transition_that_cannot_be_read_leaves_the_rest() -> None:
    text = "PROGRAM p INITIAL_STEP A: END_STEP TRANSITION ( FROM A; END_TRANSITION END_PROGRAM"
    file = with_charts(parse_structured_text(Source("a.st", text)))
    assert file.diagnostics.records


def test_many_transitions_take_memory_in_proportion() -> None:
    transition = "TRANSITION FROM A TO A := x; END_TRANSITION\n"

    def count(number: int) -> int:
        text = f"PROGRAM p INITIAL_STEP A: END_STEP {transition * number} END_PROGRAM"
        file = with_charts(parse_structured_text(Source("a.st", text)))
        return repr(file.units).count("Name(")

    assert count(200) < 2.5 * count(100)
