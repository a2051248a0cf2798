"""Programs in Structured Text in a project, with declarations, libraries and global variables."""

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

PLC = """
    [task_class.1]
    cycle = "10ms"
    programs = [{programs}]
"""


def program(cyclic, declared="", **files):
    """Return the files of the program ``main``; others by the names of their actions."""
    found = {"main/Cyclic.st": f"PROGRAM _CYCLIC\n{cyclic}\nEND_PROGRAM\n"}
    if declared:
        found["main/Variables.var"] = f"VAR\n{declared}\nEND_VAR\n"
    return found | files


@pytest.fixture
def wrong(project):
    """``wrong(files)``: what is told of a project, without the path of its folder."""

    def wrong(files):
        folder = project({"plc.toml": PLC.format(programs='"main"')} | files)
        with pytest.raises(ConfigurationError) as raised:
            load(read_project(folder))
        return str(raised.value).replace(f"{folder}/", "")

    return wrong


def test_units_in_files_of_their_own_are_one_program(run, value):
    files = program("count := count + step;", "count : UDINT; step : UDINT := 2; left : BOOL;")
    files["main/Init.st"] = "PROGRAM _INIT\ncount := 100;\nEND_PROGRAM\n"
    files["main/Exit.st"] = "PROGRAM _EXIT\nleft := TRUE;\nEND_PROGRAM\n"
    controller = run(files)
    assert value(controller, "main.count") == 106
    assert value(controller, "main.left") is False
    controller.shutdown()
    assert value(controller, "main.left") is True


def test_actions_lie_in_folders_of_the_program(run, value):
    files = program("Double;", "x : UDINT := 1;")
    files["main/actions/more/Double.st"] = "ACTION Double:\nx := x * 2;\nEND_ACTION\n"
    assert value(run(files), "main.x") == 8


def test_types_and_constants_are_those_of_the_program(run, value):
    files = program(
        "state := Busy; name := TITLE; n := LIMIT;", "state : State; name : STRING[10];"
    )
    files["main/Types.typ"] = "TYPE\nState : (Idle, Busy);\nEND_TYPE\n"
    files["main/more.var"] = """
        VAR n : INT; END_VAR
        VAR CONSTANT TITLE : STRING[10] := 'pump'; LIMIT : INT := 7; END_VAR
    """
    controller = run(files)
    assert value(controller, "main.state") == 1
    assert value(controller, "main.name") == "pump"
    assert value(controller, "main.n") == 7
    assert controller.tags.find("main.TITLE").is_constant


def test_variables_may_stand_in_the_file_itself(run, value):
    files = {
        "main/pump.st": """
            TYPE Speed : INT (0..100); END_TYPE
            FUNCTION Clip : INT
                VAR_INPUT x : INT; END_VAR
                Clip := MIN(x, 100);
            END_FUNCTION
            FUNCTION_BLOCK Ramp
                VAR_INPUT step : INT; END_VAR
                VAR_OUTPUT out : INT; END_VAR
                out := Clip(out + step);
            END_FUNCTION_BLOCK
            PROGRAM Pump
                VAR ramp : Ramp; speed : Speed; END_VAR
                VAR CONSTANT STEP : INT := 40; END_VAR
                ramp(step := STEP);
                speed := ramp.out;
            END_PROGRAM
        """
    }
    controller = run(files)
    assert value(controller, "main.speed") == 100
    assert value(controller, "main.ramp.out") == 100


def test_global_variables_are_shared_with_programs_in_python(project, value):
    folder = project(
        {
            "plc.toml": PLC.format(programs='"main", "other"'),
            "Global.var": """
                VAR gCount : UDINT := 5; gTwice : UDINT; END_VAR
                VAR CONSTANT gName : STRING[8] := 'cell'; END_VAR
            """,
            "other/main.py": """
                from plcsim import Program

                class Main(Program):
                    def cyclic(self):
                        self.gTwice = 2 * self.gCount
            """,
        }
        | program(
            "gCount := gCount + 1; seen := gTwice; name := gName;",
            "seen : UDINT; name : STRING[8];",
        )
    )
    controller = _run(folder, 2)
    assert value(controller, "gCount") == 7
    assert value(controller, "gTwice") == 14
    assert value(controller, "main.seen") == 12
    assert value(controller, "main.name") == "cell"


def _run(folder, cycles):
    application = load(read_project(folder))
    controller = assemble(application, clock=VirtualClock(), network=None)
    controller.boot()
    controller.run(cycles=cycles)
    application.unload()
    return controller


def test_a_boot_begins_again_with_edges_and_static_variables(run, value):
    files = program(
        "IF EDGEPOS(on) THEN fired := fired + 1; END_IF", "on : BOOL := TRUE; fired : INT;"
    )
    controller = run(files)
    assert value(controller, "main.fired") == 1
    controller.shutdown()
    controller.boot()
    controller.run(cycles=2)
    assert value(controller, "main.fired") == 1


def test_a_program_runs_as_several_tasks(project, value):
    toml = '[task_class.1]\ncycle = "10ms"\nprograms = ["main", {name = "twin", source = "main"}]\n'
    files = program(
        "n := n + 1; IF EDGEPOS(n > limit) THEN high := high + 1; END_IF",
        "n : INT; high : INT; limit : INT := 1;",
    )
    controller = _run(project({"plc.toml": toml} | files), 3)
    controller.tags.write(controller.tags.find("twin.limit"), 100)
    controller.run(cycles=3)
    assert (value(controller, "main.n"), value(controller, "twin.n")) == (6, 6)
    assert (value(controller, "main.high"), value(controller, "twin.high")) == (1, 1)


def test_a_fault_tells_file_line_and_the_chain_of_actions_and_blocks(run):
    files = program("Calculate;", "b : Divider;")
    files["main/Calculate.st"] = "ACTION Calculate:\n\nb();\nEND_ACTION\n"
    files["main/Divider.fun"] = (
        "FUNCTION_BLOCK Divider VAR_INPUT d : DINT; END_VAR VAR q : DINT; END_VAR "
        "END_FUNCTION_BLOCK\n"
    )
    files["main/Divider.st"] = "FUNCTION_BLOCK Divider\nq := 1 / d;\nEND_FUNCTION_BLOCK\n"
    controller = run(files)
    assert controller.state is State.SERVICE
    fault = controller.fault
    assert fault.reason == "division by zero"
    assert fault.location.endswith("main/Divider.st:2")
    assert [call.rpartition("/")[2] for call in fault.calls] == [
        "Cyclic.st:2 in cyclic",
        "Calculate.st:3 in action Calculate",
        "Divider.st:2 in block Divider",
    ]


def test_an_endless_loop_ends_on_the_virtual_clock(run, monkeypatch):
    monkeypatch.setattr("plcsim.machine.machine.UNIT_FUEL", 1_000_000)
    controller = run(program("WHILE TRUE DO\nn := n + 1;\nEND_WHILE", "n : UDINT;"))
    assert controller.state is State.SERVICE
    assert "Cyclic.st:" in controller.fault.location


def test_all_findings_of_all_files_are_told(wrong):
    files = program("a := 1;\nb := TRUE + 1;", "b : INT;")
    files["main/Other.st"] = "ACTION Unused:\nEND_ACTION\nACTION Calc:\nc := 1;\nEND_ACTION\n"
    files["main/Init.st"] = "PROGRAM _INIT\nCalc;\nEND_PROGRAM\n"
    told = wrong(files)
    assert "main/Cyclic.st:2:1: error ST2001: no variable is called a" in told
    assert "main/Other.st:4:1: error ST2001: no variable is called c" in told


def test_syntax_errors_are_told_with_errors_in_declarations(wrong):
    files = program("a := ;", "a : INT;")
    files["main/more.var"] = "VAR x : Nonsense; END_VAR\n"
    told = wrong(files)
    assert "main/Cyclic.st:2:6: error ST1001" in told
    assert "main/more.var:1:9: error" in told


def test_warnings_go_with_those_of_declarations(project):
    files = program("A := 1;", "a : INT;")
    application = load(read_project(project({"plc.toml": PLC.format(programs='"main"')} | files)))
    assert any("warning ST5001: A is declared as a" in each for each in application.warnings)


def test_what_has_no_body_is_told_before_the_run(wrong):
    files = program("x(); y := f(1);", "x : Empty; y : INT;")
    files["lib/lib.fun"] = (
        "FUNCTION_BLOCK Empty VAR_INPUT a : INT; END_VAR END_FUNCTION_BLOCK\n"
        "FUNCTION f : INT VAR_INPUT a : INT; END_VAR END_FUNCTION\n"
    )
    no_body = "has no body: it is declared, and nothing executes it"
    assert wrong(files).splitlines() == [
        f"main: FUNCTION_BLOCK Empty {no_body}",
        f"main/Cyclic.st:2:11: error: FUNCTION f {no_body}",
    ]


def test_a_folder_without_a_unit_is_no_program(wrong):
    assert "no PROGRAM is here" in wrong({"main/a.st": "ACTION A:\nEND_ACTION\n"})


def test_blocks_and_functions_of_libraries_in_python_are_called(run, value, ramp):
    cyclic = "r(Enable := TRUE); out := r.Out; two := twice(out);"
    controller = run(ramp | program(cyclic, "r : Ramp; out : UDINT; two : UDINT;"))
    assert (value(controller, "main.out"), value(controller, "main.two")) == (9, 18)


def test_what_a_body_in_python_raises_is_a_fault_at_both_places(run, ramp):
    ramp["ramps/ramp.py"] = ramp["ramps/ramp.py"].replace("return 2 * x", "return 2 // (x - x)")
    controller = run(ramp | program("n := twice(1);", "n : UDINT;"))
    assert controller.fault.reason == "division by zero"
    assert controller.fault.location.rpartition(":")[0].endswith("ramps/ramp.py")
    assert controller.fault.calls[0].endswith("Cyclic.st:2 in cyclic")


def test_the_library_standard_is_there(run, value):
    controller = run(program("t(IN := TRUE, PT := T#15ms); q := t.Q;", "t : TON; q : BOOL;"))
    assert value(controller, "main.q") is True


@pytest.mark.parametrize(
    ("files", "result"),
    [
        (program("n := 30000; wide := n + n;", "n : INT; wide : DINT;"), 60000),
        (
            {
                "main/a.st": "PROGRAM p VAR n : INT; wide : DINT; END_VAR "
                "N := 30000; Wide := n + n; END_PROGRAM"
            },
            -5536,
        ),
    ],
)
def test_a_var_block_in_a_file_makes_it_a_file_of_the_standard(run, value, files, result):
    assert value(run(files), "main.wide") == result


IEC_CHECK = {
    "IecCheck/IecCheck.fun": """
        FUNCTION CheckBounds : DINT
        VAR_INPUT index, lower, upper : DINT; END_VAR VAR own : ARRAY[0..1] OF DINT; END_VAR
        END_FUNCTION
        FUNCTION CheckDivInt : INT VAR_INPUT divisor : INT; END_VAR END_FUNCTION
        FUNCTION CheckDivReal : REAL VAR_INPUT divisor : REAL; END_VAR END_FUNCTION
        """,
    "IecCheck/IecCheck.st": """
        FUNCTION CheckBounds
        own[1] := LIMIT(lower, index, upper);
        CheckBounds := own[1];
        END_FUNCTION
        FUNCTION CheckDivInt
        CheckDivInt := SEL(divisor = 0, divisor, 1);
        END_FUNCTION
        FUNCTION CheckDivReal
        CheckDivReal := divisor;
        IF divisor = 0 THEN CheckDivReal := 2; END_IF
        END_FUNCTION
        """,
}


def test_indices_and_divisors_go_through_the_library_iec_check(run, value):
    text = "list[i] := 5; list[1] := list[-i]; j := 7 / zero; r := 3.0 / q; k := 8 / 2;"
    declared = "list : ARRAY[1..3] OF INT; i : INT := 9; j, k, zero : INT; r, q : REAL; next : INT;"
    controller = run(program(text, declared) | IEC_CHECK)
    assert controller.fault is None
    assert [value(controller, f"main.list[{n}]") for n in (1, 2, 3)] == [0, 0, 5]
    assert [value(controller, f"main.{name}") for name in ("j", "k", "r", "next")] == [7, 4, 1.5, 0]


def test_a_variable_of_a_function_has_a_limit(run):
    files = program("i := f(i);", "i : INT;") | {
        "main/f.st": "FUNCTION f : INT VAR_INPUT x : INT; END_VAR "
        "VAR a : ARRAY[0..9999999] OF INT; END_VAR a[x] := 1; f := a[0]; END_FUNCTION"
    }
    with pytest.raises(ConfigurationError, match="a has 20000000 bytes: too many for a variable"):
        run(files)
