import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.process.report import heaps_report
from plcsim.program.c.language import C_LANGUAGE
from plcsim.program.declarations import Declarations
from plcsim.program.language import ProgramSource
from plcsim.program.layout import folder_layout
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.program.variables import variables_of

MS = 1_000_000

VARIABLES = """
VAR
    counter : UDINT := 7;
    timer : TON;
    done : BOOL;
    text : STRING[20] := 'abc';
    wild : REFERENCE TO UDINT;
    left : BOOL;
END_VAR
VAR CONSTANT
    LIMIT : UINT := 5;
END_VAR
"""

MAIN = """
#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif
#include <string.h>

UDINT plain = 3;
static UDINT calls;
static void fill(char *to) { strcat(to, "!"); }
void (*action)(char *) = fill;

void _INIT ProgramInit(void)
{
	counter += plain++;
}

void _CYCLIC ProgramCyclic(void)
{
	counter++;
	timer.PT = 20;
	timer.IN = 1;
	TON(&timer);
	done = timer.Q;
	if (strlen(text) < LIMIT)
		action(text);
	if (++calls == 50)
		*wild = 1;
}

void _EXIT ProgramExit(void) { left = 1; }
"""


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


@pytest.fixture
def load(tmp_path):
    """``load({"Main.c": "..."})``: the code of a program."""

    def load(files):
        folder = tmp_path / "conveyor"
        folder.mkdir(exist_ok=True)
        for name, text in files.items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_text(text)
        layout = folder_layout(tmp_path, ["conveyor"])
        units = C_LANGUAGE.units(layout.programs["conveyor"].own.files)
        declarations = Declarations(layout, "package")
        scope, shared = declarations.scope_of("conveyor"), variables_of("globals", ())
        source = ProgramSource("conveyor", folder, units, declarations, scope, shared)
        return C_LANGUAGE.load(source)

    return load


@pytest.fixture
def controller(load):
    """``controller(files, "a", "b")``: one with the program as these tasks in a 1 ms class."""

    def controller(files, *names, clock=None):
        code = load(files)
        programs = [ProgramSetup(name, code) for name in names or ["conveyor"]]
        setup = Setup([TaskClassSetup(1, MS, programs)])
        return make_controller(setup, clock=clock or VirtualClock())

    return controller


def value(plc, path):
    return plc.tags.read(plc.tags.find(path))


FILES = {"Main.c": MAIN, "Variables.var": VARIABLES}


def test_a_program_runs_with_blocks_library_and_pointers(controller):
    plc = controller(FILES)
    plc.boot()
    assert value(plc, "conveyor.counter") == 10
    plc.run(cycles=5)
    assert value(plc, "conveyor.counter") == 15
    assert value(plc, "conveyor.text") == "abc!!"
    assert value(plc, "conveyor.timer.ET") == 4
    plc.run(cycles=20)
    assert value(plc, "conveyor.done") is True
    plc.shutdown()
    assert value(plc, "conveyor.left") is True
    assert plc.state is State.STOPPED


def test_a_wild_pointer_is_service_with_its_line(controller):
    plc = controller(FILES)
    plc.boot()
    plc.run(cycles=100)
    assert (plc.state, value(plc, "conveyor.counter")) == (State.SERVICE, 60)
    fault = plc.fault
    file, _, line = fault.location.rpartition(":")
    assert file.endswith("/conveyor/Main.c")
    assert MAIN.splitlines()[int(line) - 1].strip() == "*wild = 1;"
    assert fault.reason == "page fault: address 16#00000000"
    assert fault.calls == (f"{fault.location} in ProgramCyclic",)


def test_a_restart_begins_with_all_initial_values(controller):
    plc = controller(FILES)
    for _ in range(2):
        plc.boot()
        assert value(plc, "conveyor.counter") == 10
        plc.run(cycles=100)
        assert plc.state is State.SERVICE


def test_two_tasks_of_one_program_share_nothing(controller):
    plc = controller(FILES, "one", "two")
    plc.boot()
    plc.run(cycles=3)
    assert value(plc, "one.counter") == value(plc, "two.counter") == 13
    assert value(plc, "one.text") == value(plc, "two.text") == "abc!!"


def test_an_exception_in_a_block_leads_to_the_call_in_c(controller, monkeypatch):
    from plcsim.library.brsystem import RTInfo

    def execute(_self):
        raise KeyError("in Python")

    monkeypatch.setattr(RTInfo, "execute", execute)
    include = "#include <bur/plctypes.h>\n#include <AsDefault.h>\n"
    text = f"{include}void _CYCLIC run(void)\n{{\n  RTInfo(&info);\n}}\n"
    plc = controller({"Main.c": text, "Variables.var": "VAR info : RTInfo; END_VAR"})
    plc.boot()
    plc.run(cycles=1)
    assert plc.fault.reason == "KeyError: 'in Python'"
    assert plc.fault.calls[0].endswith("Main.c:5 in run")


def test_an_endless_loop_is_ended_on_the_virtual_clock(controller, monkeypatch):
    monkeypatch.setattr("plcsim.machine.machine.UNIT_FUEL", 100_000)
    text = "#include <bur/plctypes.h>\nvoid _CYCLIC run(void)\n{\n  while (1);\n}\n"
    plc = controller({"Main.c": text})
    plc.boot()
    plc.run(cycles=1)
    (violation,) = plc.violations
    assert violation.location.endswith("Main.c:4")


def test_errors_are_told_with_their_places(load):
    files = {"Main.c": "int f(void) { return x; }", "Part.c": "#include <nowhere.h>\n"}
    with pytest.raises(ConfigurationError) as caught:
        load(files)
    first, second = caught.value.findings
    assert "conveyor/Main.c:1:22: use of undeclared identifier 'x'" in first
    assert "conveyor/Part.c:1:10: 'nowhere.h' file not found" in second


def test_a_program_without_a_unit_is_refused(load):
    with pytest.raises(ConfigurationError, match="no function of the program is marked _INIT"):
        load({"Main.c": "void cyclic(void) {}"})


def test_what_is_nowhere_is_told_when_the_task_is_made(controller):
    text = "#include <bur/plctypes.h>\nvoid Mp(void*);\nvoid _CYCLIC run(void) { Mp(0); }"
    with pytest.raises(
        ConfigurationError, match=r"Main.c:\d+: conveyor uses function Mp, which is nowhere"
    ):
        controller({"Main.c": text})


HEAP = """
#include <AsDefault.h>
#include <stdlib.h>
unsigned long bur_heap_size = 4096;
static char *kept;
void _INIT init(void) { kept = malloc(1000); all = kept && !malloc(4000); }
void _CYCLIC cyclic(void)
{
	kept = realloc(kept, 1500);
	free(malloc(100));
	if (twice)
		free(kept), free(kept);
}
"""


def test_a_program_has_a_heap_of_the_size_that_it_wants(controller):
    plc = controller({"Main.c": HEAP, "V.var": "VAR all, twice : BOOL; END_VAR"}, "a", "b")
    for _ in range(2):
        plc.boot()
        plc.run(cycles=1)
        assert value(plc, "a.all") is value(plc, "b.all") is True
        plc.run(cycles=100)
        assert plc.state is State.RUN
        plc.tags.write(plc.tags.find("a.twice"), value=True)
        plc.run(cycles=1)
        assert plc.fault.reason == "an area of the heap is freed that was freed before"
        assert plc.fault.location.endswith("Main.c:12")


def test_headers_are_found_in_any_case(controller):
    files = {
        "Main.c": '#include <bur/PlcTypes.h>\n#include "ASDEFAULT.H"\n#include "Sub/Own.h"\n'
        '#include <String.h>\nvoid _CYCLIC run(void) { x = OWN + strlen("ab"); }\n',
        "sub/own.h": "#define OWN 5\n",
        "V.var": "VAR x : INT; END_VAR",
    }
    plc = controller(files)
    plc.boot()
    plc.run(cycles=1)
    assert value(plc, "conveyor.x") == 7


def test_parts_of_a_program_lie_in_several_files_and_folders(controller):
    files = {
        "Main.c": "#include <AsDefault.h>\nint part(int);\n"
        "void _CYCLIC run(void) { x = part(x); }\n",
        "sub/Part.c": "int part(int x) { return x + 2; }\n",
        "V.var": "VAR x : INT; END_VAR",
    }
    plc = controller(files)
    plc.boot()
    plc.run(cycles=3)
    assert value(plc, "conveyor.x") == 6


OWN = """
#include <AsDefault.h>
typedef struct point { char tag; double x; short list[3]; } point;
enum colour { RED = -1, GREEN = 5 };
UINT plain = 3;
static REAL slow = 0.5;
char buffer[20] = "abc";
SINT address[10] = "127.0.0.1";
TON_typ timer_1;
point where = {'p', 2.5, {1, 2, 3}};
enum colour colour = GREEN;
BOOL flag;
LINT grid[2][3];
static void (*action)(void);
UDINT declared;
void _CYCLIC run(void)
{
	static int calls = 40;
	calls++;
	plain++;
	slow *= 2;
	timer_1.PT = 7;
	TON(&timer_1);
	where.list[2] += declared;
	grid[1][2] = calls;
	flag = action == 0;
	strcat(buffer, "!");
}
"""


def test_what_c_defines_itself_are_tags(controller):
    text = OWN.replace("<AsDefault.h>", "<AsDefault.h>\n#include <string.h>")
    plc = controller({"Main.c": text, "V.var": "VAR declared : UDINT := 9; END_VAR"})
    plc.boot()
    plc.run(cycles=2)
    figures = {
        "plain": 5,
        "slow": 2.0,
        "buffer": "abc!!",
        "address[3]": ord("."),
        "timer_1.PT": 7,
        "where.tag": ord("p"),
        "where.x": 2.5,
        "where.list[2]": 3 + 2 * 9,
        "colour": 5,
        "flag": True,
        "grid[1,2]": 42,
        "calls": 42,
        "declared": 9,
    }
    assert {path: value(plc, f"conveyor.{path}") for path in figures} == figures
    plc.tags.write(plc.tags.find("conveyor.plain"), value=100)
    plc.run(cycles=1)
    assert value(plc, "conveyor.plain") == 101


def test_the_use_of_the_heap_is_a_variable_of_the_program(run, value):
    text = (
        "#include <bur/plctypes.h>\n#include <stdlib.h>\nunsigned long bur_heap_size = 4096;\n"
        "void _CYCLIC f(void) { malloc(1000); free(malloc(2000)); }\n"
    )
    controller = run({"main/Main.c": text}, cycles=1)
    use = value(controller, "main.plc_heap")
    assert use == {"Size": 4096, "Used": 1000, "Most": 3000, "Areas": 1, "Refused": 0}
    controller.run(cycles=10)
    assert value(controller, "main.plc_heap.Refused") > 0
    assert controller.state is State.RUN


def test_the_report_tells_what_has_leaked(run):
    text = (
        "#include <bur/plctypes.h>\n#include <stdlib.h>\nunsigned long bur_heap_size = 4096;\n"
        "void *held;\n"
        "void _INIT i(void) { held = malloc(1000); malloc(200); }\n"
        "void _CYCLIC c(void) { free(held); held = 0; }\n"
    )
    controller = run({"main/Main.c": text}, cycles=1)
    (reported,) = heaps_report(controller)
    assert reported == {
        "name": "main",
        "size_bytes": 4096,
        "used_bytes": 200,
        "most_bytes": 1200,
        "areas": 1,
        "refused": 0,
    }
