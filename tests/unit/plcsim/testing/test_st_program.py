"""Tests in Structured Text, as pytest runs them."""

import pytest

from plcsim.testing import st_program

pytest_plugins = ["pytester"]

PROJECT = {
    "plc.toml": '[task_class.1]\nprograms = ["main"]\n',
    "Global.var": "VAR gOffset : DINT := 2; END_VAR\n",
    "main/Main.st": "PROGRAM _CYCLIC\nEND_PROGRAM\n",
    "util/util.fun": "FUNCTION Twice : DINT VAR_INPUT n : DINT; END_VAR END_FUNCTION\n",
    "util/Twice.st": "FUNCTION Twice\nTwice := 2 * n;\nEND_FUNCTION\n",
}


@pytest.fixture
def outcomes(pytester):
    """``outcomes(text)``: what pytest says of a file with tests in a project, and its output."""

    def outcomes(text, files=PROJECT):
        folder = pytester.path
        for name, content in (files | {"tests/test_it.st": text}).items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_text(content)
        result = pytester.runpytest_inprocess(
            "-q", "-p", "no:cacheprovider", "--rootdir", folder, folder / "tests"
        )
        return result.parseoutcomes(), "\n".join(result.outlines)

    return outcomes


def unit(body, name="test_it", word="PROGRAM", declared=""):
    return f"{word} {name}\nVAR {declared} END_VAR\n{body}\nEND_{word}\n"


def test_programs_and_blocks_are_tests_and_others_are_not(tmp_path):
    file = tmp_path / "test_all.st"
    text = unit("", "test_a") + unit("", "TEST_B", "FUNCTION_BLOCK") + unit("", "Helper")
    file.write_text(f"(* a *)\n{text}")
    assert [(t.name, t.line, t.is_block) for t in st_program.tests_in(file)] == [
        ("test_a", 2, False),
        ("TEST_B", 6, True),
    ]


def test_libraries_and_globals_of_the_project_are_there(outcomes):
    text = unit("AssertEquals_DINT(44, Twice(20 + gOffset));") + unit(
        "x := Twice(4); AssertTrue(x = 8, 'twice');", "test_block", "FUNCTION_BLOCK", "x : DINT;"
    )
    assert outcomes(text)[0] == {"passed": 2}


@pytest.mark.parametrize(
    ("statement", "told"),
    [
        ("AssertTrue(Twice(2) = 5, 'twice');", "twice: expected TRUE, got FALSE"),
        ("AssertFalse(Twice(2) = 4);", "expected FALSE, got TRUE"),
        ("AssertEquals_INT(-3, 4);", "expected -3, got 4"),
        ("AssertEquals_TIME(T#1s, T#2s);", "expected T#1s, got T#2s"),
        ("AssertEquals_STRING('one', 'two');", "expected 'one', got 'two'"),
        ("AssertEquals_REAL(1.0, 1.5, 0.25);", "expected 1.0 within 0.25, got 1.5"),
        ("gOffset := 1 / (gOffset - 2);", "division by zero"),
    ],
)
def test_a_failure_tells_line_and_values(outcomes, statement, told):
    found, out = outcomes(unit(f"\n{statement}"))
    assert found == {"failed": 1}
    assert f"tests/test_it.st:4: {told}" in out
    assert f"> {statement}" in out


@pytest.mark.parametrize(
    "statement",
    [
        "AssertTrue(TRUE);",
        "AssertFalse(FALSE, 'no');",
        "AssertEquals_UDINT(16#FFFF_FFFF, 4294967295);",
        "AssertEquals_STRING('same', 'same', 'texts');",
        "AssertEquals_LREAL(1.0, 1.1, 0.2);",
        "AssertEquals_BOOL(TRUE, TRUE);",
        "AssertEquals_LINT(-1, -1);",
    ],
)
def test_what_holds_passes(outcomes, statement):
    assert outcomes(unit(statement))[0] == {"passed": 1}


def test_a_test_runs_until_it_is_finished(outcomes):
    body = """
        t(IN := TRUE, PT := T#50ms);
        n := n + 1;
        IF t.Q THEN
            AssertEquals_INT(6, n);
            TEST_FINISHED();
        END_IF
    """
    assert outcomes(unit(body, declared="t : TON; n : INT;"))[0] == {"passed": 1}


def test_a_test_that_never_finishes_fails(outcomes, monkeypatch):
    monkeypatch.setattr("plcsim.testing.st_program.MOST_CYCLES", 20)
    found, out = outcomes(unit("IF gOffset = 0 THEN TEST_FINISHED(); END_IF"))
    assert found == {"failed": 1}
    assert "test_it has not called TEST_FINISHED in 20 cycles" in out


def test_errors_of_the_compiler_are_the_failure(outcomes):
    found, out = outcomes(unit("x := 1;"))
    assert found == {"failed": 1}
    assert "test_it.st:3:1: error ST2001: no variable is called x" in out


def test_errors_in_the_syntax_are_told_at_collection(outcomes):
    found, out = outcomes(unit("x := ;"))
    assert found == {"errors": 1}
    assert "test_it.st:3:6: error ST1001" in out


def test_the_calls_that_led_to_a_failure_are_shown(outcomes):
    files = PROJECT | {"util/Twice.st": "FUNCTION Twice\n\nTwice := 2 / n;\nEND_FUNCTION\n"}
    _, out = outcomes(unit("gOffset := Twice(0);", "test_it", "FUNCTION_BLOCK"), files)
    assert "util/Twice.st:3: division by zero" in out
    assert "tests/test_it.st:3 in block test_it" in out


def test_without_a_project_the_standard_library_is_there(outcomes):
    text = unit("r(CLK := TRUE); AssertTrue(r.Q);", declared="r : R_TRIG;")
    assert outcomes(text, {})[0] == {"passed": 1}
