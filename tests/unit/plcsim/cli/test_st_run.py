"""``plcsim st run``."""

import json

import pytest

from plcsim.cli import st
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import PlcError

COUNTER = """
    PROGRAM counter
        VAR n : UDINT; step : UDINT := 1; time : TIME; t : TON; END_VAR
        n := n + step;
        t(IN := TRUE, PT := T#30ms);
        time := t.ET;
        IF n = 1000 THEN n := n / (n - n); END_IF
    END_PROGRAM
"""


@pytest.fixture
def run(capsys, project):
    """``run(arguments)``: exit code, stdout and stderr for a counter."""

    def run(*arguments, text=COUNTER):
        parser = CommandParser()
        st.register(parser.add_subparsers(required=True))
        file = project({"counter.st": text}) / "counter.st"
        options = parser.parse_args(["st", "run", str(file), *arguments])
        code = options.func(options)
        return (code, *capsys.readouterr())

    return run


def test_a_trace_has_a_row_for_each_cycle(run):
    code, out, err = run("--cycles", "3", "--trace", "n,time", "--format", "csv")
    assert (code, err) == (0, "")
    assert out.splitlines() == [
        "cycle,time,counter.n,counter.time",
        "1,5 ms,1,T#0ms",
        "2,15 ms,2,T#10ms",
        "3,25 ms,3,T#20ms",
    ]


def test_variables_are_set_after_init(run):
    arguments = "--cycles=2", "--set", "step=16#10", "--trace=counter.n", "--format=json"
    code, out, _ = run(*arguments, "--cycle", "100ms")
    assert code == 0
    assert json.loads(out) == [
        {"cycle": "1", "time": "50 ms", "counter.n": "16"},
        {"cycle": "2", "time": "150 ms", "counter.n": "32"},
    ]


def test_without_a_trace_the_last_values_are_shown(run):
    code, out, _ = run("--cycles=7")
    assert code == 0
    assert out.splitlines()[1].split() == ["counter.n", "7"]
    assert "T#30ms" in out


def test_a_fault_ends_the_run_with_its_place(run):
    code, out, err = run("--set=n=998", "--trace=n", "--format=csv")
    assert code == 3
    assert out.splitlines() == ["cycle,time,counter.n", "1,5 ms,999"]
    assert "division by zero" in err
    assert "counter.st:7" in err


@pytest.mark.parametrize(
    ("argument", "told"),
    [
        ("--set=m=1", "no variable is called m"),
        ("--set=n", "--set n: NAME=VALUE was expected"),
        ("--set=n=x", "--set n=x: "),
        ("--trace=stop", "no variable is called stop; did you mean step?"),
        ("--cycle=5", "--cycle 5: "),
    ],
)
def test_what_is_wrong_in_the_arguments_is_told(run, argument, told):
    with pytest.raises(PlcError) as raised:
        run(argument)
    assert told in str(raised.value)


def test_cycles_are_a_number_above_0(run):
    with pytest.raises(SystemExit):
        run("--cycles=0")


def test_warnings_go_to_stderr(run):
    text = "PROGRAM p VAR n : INT; END_VAR\nn = 1;\nEND_PROGRAM\n"
    _, _, err = run(text=text)
    assert "warning ST5" in err
