"""Controllers from one file of Structured Text."""

import ast
import re
from pathlib import Path

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project
from plcsim.project.structured_text_file import load_file

MS = 1_000_000
PLANT = """
    FUNCTION_BLOCK Counter
        VAR_INPUT step : INT; END_VAR
        VAR_OUTPUT out : INT; END_VAR
        out := out + step;
    END_FUNCTION_BLOCK
    PROGRAM Fill
        VAR_EXTERNAL level : INT; END_VAR
        VAR c : Counter; END_VAR
        c(step := 1);
        Level := Level + 1;
    END_PROGRAM
    PROGRAM Drain
        VAR_EXTERNAL level : INT; END_VAR
        VAR c : Counter; seen : INT; END_VAR
        c(step := 10);
        seen := level;
    END_PROGRAM
    CONFIGURATION plant
        VAR_GLOBAL level : INT := 100; END_VAR
        RESOURCE station ON PLC
            TASK slow (INTERVAL := T#40ms, PRIORITY := 5);
            TASK fast (INTERVAL := T#10ms, PRIORITY := 1);
            PROGRAM drain WITH slow : Drain;
            PROGRAM left WITH fast : Fill;
            PROGRAM right WITH fast : Fill;
        END_RESOURCE
    END_CONFIGURATION
"""


@pytest.fixture
def load_text(project):
    return lambda text, **options: load_file(project({"plant.st": text}) / "plant.st", **options)


def run(application, cycles):
    controller = assemble(application, clock=VirtualClock(), network=None)
    controller.boot()
    controller.run(cycles=cycles)
    return controller, lambda path: controller.tags.read(controller.tags.find(path))


def test_tasks_become_task_classes_by_their_priority(load_text):
    controller, value = run(load_text(PLANT), 8)
    classes = [(c.number, c.cycle_ns, [t.name for t in c.tasks]) for c in controller.classes]
    assert classes == [(1, 10 * MS, ["left", "right"]), (2, 40 * MS, ["drain"])]
    assert value("level") == 116
    assert (value("left.c.out"), value("drain.c.out"), value("drain.seen")) == (8, 20, 112)


WHOLE_FILES = re.findall(
    r"^==== (.*)\n([\s\S]*?)\n----\n([\s\S]*?)\n(?=====|\Z)",
    (Path(__file__).parents[3] / "corpus/structured_text/whole_files.txt").read_text("utf-8"),
    re.MULTILINE,
)
"""What each is about, its text, and its variables afterwards, worked out by hand."""


@pytest.mark.parametrize(
    ("title", "text", "expected"), WHOLE_FILES, ids=[f[0] for f in WHOLE_FILES]
)
def test_a_whole_file_gives_what_was_worked_out_by_hand(load_text, title, text, expected):
    rows = dict(row.split(" = ") for row in expected.splitlines())
    wanted = {name: ast.literal_eval(value) for name, value in rows.items()}
    controller, value = run(load_text(text), wanted.pop("cycles", 1))
    assert controller.fault is None
    assert {name: value(name) for name in wanted} == wanted


def test_what_changes_a_variable_from_outside_goes_to_its_address(load_text):
    text = "PROGRAM p VAR a AT %IW2 : INT; f AT %IX0.1 : BOOL; n : INT; g : BOOL; END_VAR "
    controller, value = run(load_text(f"{text} n := %IW2; g := %IX0.1; END_PROGRAM"), 1)
    controller.tags.write(controller.tags.find("p.a"), 12)
    controller.tags.write(controller.tags.find("p.f"), True)
    controller.run(cycles=2)
    assert (value("p.n"), value("p.g"), value("p.a")) == (12, True, 12)


@pytest.mark.parametrize("address", ["%MW40000", "%MX1.8", "%MW1.2.3", "%MW*", "%XW1"])
def test_addresses_that_lead_nowhere_are_refused_by_name(load_text, address):
    with pytest.raises(ConfigurationError, match="error ST"):
        load_text(f"PROGRAM p VAR n : INT; END_VAR n := {address}; END_PROGRAM")


def test_large_arrays_at_an_address_are_refused(load_text):
    text = "PROGRAM p VAR a AT %MW0 : ARRAY[0..1024] OF INT; END_VAR a[1] := 2; END_PROGRAM"
    with pytest.raises(ConfigurationError, match="a has more than 1024 values: not supported AT"):
        load_text(text)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("VAR p : UDINT; END_VAR p := __NEW(INT);", "ST4001: __NEW is not supported"),
        ("VAR n : UDINT; b : BOOL; END_VAR n := BITADR(b);", "ST4001: BITADR is not supported"),
        ("VAR b : BOOL; END_VAR LD b", "hint: Instruction List has files of its own: .il"),
        ("VAR n : INT; END_VAR __TRY n := 1;", "hint: __TRY of CODESYS is not supported"),
        ("VAR f : G; END_VAR f();", "ST4001: VAR_GENERIC is not supported"),
        ("VAR b : BOOL; END_VAR b := a(b);", "ST4001: x is of type ANY, which is not supported"),
    ],
)
def test_what_only_codesys_has_is_refused_by_name(load_text, text, told):
    others = """
        FUNCTION_BLOCK G VAR_GENERIC CONSTANT n : UDINT := 5; END_VAR END_FUNCTION_BLOCK
        FUNCTION a : BOOL VAR_INPUT x : ANY; END_VAR a := x = 1; END_FUNCTION"""
    with pytest.raises(ConfigurationError) as raised:
        load_text(f"PROGRAM p {text} END_PROGRAM {others}")
    assert told in str(raised.value)


OPEN = """
FUNCTION first : INT VAR_IN_OUT a : ARRAY[*] OF INT; i : INT; END_VAR first := a[i]; END_FUNCTION
PROGRAM p VAR a : ARRAY[2..4] OF INT; m : ARRAY[1..2, 1..2] OF INT; n, i : INT; END_VAR
n := {};
END_PROGRAM
"""


OPEN_BLOCK = """
FUNCTION_BLOCK S VAR_IN_OUT m : ARRAY[*] OF INT; END_VAR m[0] := 1; END_FUNCTION_BLOCK
PROGRAM p VAR s : S; r : ARRAY[0..1] OF REAL; i : ARRAY[0..1] OF INT; END_VAR
{};
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (OPEN.format("first(m, i)"), "4:12: error ST3003: a takes an array of 1 dimension"),
        (OPEN.format("first(n, i)"), "4:12: error ST3003: a takes an array of 1 dimension"),
        (OPEN.format("first(i := i)"), "error ST3003: a takes an array of 1 dimension"),
        (OPEN.format("LOWER_BOUND(m, 3)"), "4:17: error ST3014: ARRAY[1..2, 1..2] OF INT has no"),
        (OPEN.format("UPPER_BOUND(m)"), "error ST3003: UPPER_BOUND takes an array and the number"),
        ("PROGRAM p VAR a : ARRAY[*] OF INT; END_VAR END_PROGRAM", "error ST1002: ARRAY[*] is"),
        (OPEN_BLOCK.format("s(m := r)"), "4:8: error ST3001: ARRAY[0..1] OF REAL does not go into"),
        (OPEN_BLOCK.format("s()"), "4:2: error ST3003: m takes an array of 1 dimension"),
        (OPEN_BLOCK.format("s"), "4:1: error ST3003: m takes an array of 1 dimension"),
        (OPEN_BLOCK.format("s(m := i)").replace("m[0]", "m[5]"), "index 5 is outside 0..1"),
        ("PROGRAM p VAR a : ARRAY[*,2] OF INT; END_VAR END_PROGRAM", "error ST1001: expected '*'"),
    ],
)
def test_arrays_of_any_bounds_are_parameters(load_text, text, told):
    with pytest.raises(ConfigurationError) as raised:
        load_text(text)
    assert told in str(raised.value)


def test_an_index_outside_the_bounds_of_what_was_given_ends_the_program(load_text):
    controller, _ = run(load_text(OPEN.format("first(a, i)")), 1)
    assert "plant.st:2" in str(controller.fault)


def test_without_a_configuration_every_program_runs_in_class_1(load_text):
    text = PLANT[: PLANT.index("CONFIGURATION")] + "VAR_GLOBAL level : INT; END_VAR\n"
    controller, value = run(load_text(text, cycle_ns=5 * MS), 2)
    assert [(c.number, c.cycle_ns) for c in controller.classes] == [(1, 5 * MS)]
    assert [task.name for task in controller.tasks] == ["Fill", "Drain"]
    assert value("level") == 2


def test_files_of_automation_studio_belong_together(project):
    folder = project(
        {
            "pump/Cyclic.st": "PROGRAM _CYCLIC\nx := LIMIT;\nEND_PROGRAM\n",
            "pump/Init.st": "PROGRAM _INIT\ny := 5;\nEND_PROGRAM\n",
            "pump/a.var": "VAR x : INT; y : INT; END_VAR VAR CONSTANT LIMIT : INT := 3; END_VAR",
        }
    )
    _, value = run(load_file(folder / "pump" / "Cyclic.st"), 1)
    assert (value("pump.x"), value("pump.y")) == (3, 5)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (
            "INTERVAL := T#10ms, ",
            "",
            "plant.st:23:9: error: TASK fast has no INTERVAL; tasks that wait",
        ),
        ("T#10ms", "T#0ms", "plant.st:23:9: error: INTERVAL of TASK fast must be above 0"),
        ("WITH fast : Fill", "WITH quick : Fill", "error: PROGRAM left: there is no TASK quick"),
        ("WITH fast : Fill", "WITH fast : Mix", "PROGRAM left: the file has no PROGRAM Mix"),
        (
            "fast : Fill;",
            "fast : Fill(a := 1);",
            "plant.st:25:39: error ST3004: Fill has no input a",
        ),
        ("Level + 1", "Leve + 1", "error ST2001: no variable is called Leve"),
        ("PROGRAM Fill", "PROGRAM", "error ST1001"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(load_text, old, new, told):
    with pytest.raises(ConfigurationError) as raised:
        load_text(PLANT.replace(old, new, 1))
    assert told in str(raised.value)


def test_nine_tasks_are_too_many(load_text):
    tasks = "".join(f"TASK t{n} (INTERVAL := T#10ms, PRIORITY := {n});" for n in range(9))
    programs = "".join(f"PROGRAM p{n} WITH t{n} : Fill;" for n in range(9))
    head = PLANT[: PLANT.index("RESOURCE")]
    with pytest.raises(ConfigurationError, match="9 tasks; a controller has 8 task classes"):
        load_text(f"{head}{tasks}{programs}END_CONFIGURATION\n")


def test_sources_in_c_beside_a_file_are_no_part_of_it(tmp_path):
    (tmp_path / "Main.st").write_text("PROGRAM _CYCLIC\nn := n + 1;\nEND_PROGRAM\n")
    (tmp_path / "Main.var").write_text("VAR n : INT; END_VAR\n")
    (tmp_path / "kernel.c").write_text("void _CYCLIC run(void) {}\n")
    (program,) = load_file(tmp_path / "Main.st").setup.classes[0].programs
    assert list(program.code.warnings) == []


def test_a_file_without_a_program_has_nothing_to_run(load_text):
    with pytest.raises(ConfigurationError, match="no PROGRAM is in it"):
        load_text("FUNCTION f : INT VAR_INPUT x : INT; END_VAR f := x; END_FUNCTION\n")


PARTS = {
    "blocks.st": PLANT[: PLANT.index("PROGRAM Fill")],
    "programs.st": PLANT[PLANT.index("PROGRAM Fill") : PLANT.index("CONFIGURATION")],
    "plant.st": PLANT[PLANT.index("CONFIGURATION") :],
}


def test_the_files_beside_a_plc_toml_without_task_classes_are_the_project(project):
    application = load(read_project(project({"plc.toml": '[plc]\nname = "plant"\n', **PARTS})))
    controller, value = run(application, 8)
    assert [(c.number, [t.name for t in c.tasks]) for c in controller.classes] == [
        (1, ["left", "right"]),
        (2, ["drain"]),
    ]
    assert (value("level"), value("left.c.out"), value("drain.seen")) == (116, 8, 112)


def test_task_classes_of_plc_toml_name_programs_that_share_files(project):
    toml = '[task_class.1]\nprograms = ["Fill", {name = "d", source = "drain"}, "other"]\n'
    other = "PROGRAM _CYCLIC x := level; END_PROGRAM"
    files = {"plc.toml": toml, **PARTS, "other/c.st": other, "other/v.var": "VAR x : INT; END_VAR"}
    _, value = run(load(read_project(project(files))), 3)
    assert (value("level"), value("d.c.out"), value("other.x")) == (103, 30, 103)


def test_a_program_that_no_file_holds_is_named(project):
    toml = '[task_class.1]\nprograms = ["Full"]\n'
    with pytest.raises(ConfigurationError, match=r"no PROGRAM Full.*did you mean Fill"):
        load(read_project(project({"plc.toml": toml, **PARTS})))


@pytest.mark.parametrize(("dialect", "seen"), [("", 30000), ("iec", -2768)])
def test_plc_toml_says_the_dialect_of_a_project(project, dialect, seen):
    files = {
        "plc.toml": f'[plc]\ndialect = "{dialect}"\n[task_class.1]\nprograms = ["p"]\n',
        "p/c.st": "PROGRAM _CYCLIC c := (a + b) / 2; END_PROGRAM",
        "p/v.var": "VAR a, b : INT := 30000; c : INT; END_VAR",
    }
    _, value = run(load(read_project(project(files))), 1)
    assert value("p.c") == seen


def test_a_file_of_a_project_sees_what_the_project_declares(project):
    files = {
        "plc.toml": '[task_class.2]\ncycle = "40ms"\nprograms = ["p", "q"]\n',
        "Global.var": "VAR level : INT := 7; END_VAR",
        "mylib/l.fun": "FUNCTION twice : INT VAR_INPUT x : INT; END_VAR END_FUNCTION",
        "mylib/l.st": "FUNCTION twice twice := 2 * x; END_FUNCTION",
        "p/c.st": "PROGRAM _CYCLIC a := twice(level); END_PROGRAM",
        "p/v.var": "VAR a : INT; END_VAR",
        "q/c.st": "PROGRAM _CYCLIC broken broken; END_PROGRAM",
    }
    folder = project(files)
    controller, value = run(load_file(folder / "p" / "c.st"), 1)
    assert (value("p.a"), [c.cycle_ns for c in controller.classes]) == (14, [40 * MS])
    controller, _ = run(load_file(folder / "p" / "c.st", cycle_ns=5 * MS), 1)
    assert [c.cycle_ns for c in controller.classes] == [5 * MS]
