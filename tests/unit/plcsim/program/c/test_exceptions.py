"""Exceptions of C++ and types at run time; gcc makes the same of these sources."""

import pytest

from plcsim.ansi_c.toolchain import find_toolchain, system_clang
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State

VARIABLES = "VAR result : ARRAY[0..9] OF DINT; told : STRING[200]; END_VAR"
HEAD = """#include <bur/plctypes.h>
#include <AsDefault.h>
#include <string.h>
#include <stdexcept>
#include <string>
#include <vector>
static void tell(const char *text) { strcat((char *)told, text); }
"""


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        if not find_toolchain().throwing:
            pytest.skip("this compiler has no exceptions")
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


@pytest.fixture
def ran(run):
    """``ran(text)``: the controller after one cycle of the unit with this text."""

    def call(text, more=""):
        unit = f"void _CYCLIC cyclic(void) {{ {text} }}\n"
        files = {"main/V.var": VARIABLES, "main/Main.cpp": f"{HEAD}{more}{unit}"}
        return run(files, cycles=1)

    return call


@pytest.fixture
def told(ran, value):
    """``told(text)``: what the unit has told, one cycle long, and no fault."""

    def call(text, more=""):
        controller = ran(text, more)
        assert (controller.state, controller.fault) == (State.RUN, None)
        return value(controller, "main.told")

    return call


THROWERS = """
struct Res { const char *name; ~Res() { tell(name); } };
struct Oops : std::runtime_error { int code; Oops(int c) : runtime_error("oops"), code(c) {} };
static int thrower(int k)
{
	Res r{"~r "};
	if (k == 1) throw 5;
	if (k == 2) throw std::runtime_error("run");
	if (k == 3) throw Oops(7);
	if (k == 4) throw "text";
	if (k == 5) throw std::string("any");
	return k;
}
static void caught(int k)
{
	try { Res h{"~h "}; thrower(k); tell("through "); }
	catch (int i) { tell(i == 5 ? "int " : "?"); }
	catch (const Oops &o) { tell(o.code == 7 ? "Oops " : "?"); }
	catch (std::exception &e) { tell(e.what()); tell(" "); }
	catch (const char *text) { tell(text); tell(" "); }
	catch (...) { tell("all "); }
}
"""


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        *[(0, "~r through ~h "), (1, "~r ~h int "), (2, "~r ~h run "), (3, "~r ~h Oops ")],
        *[(4, "~r ~h text "), (5, "~r ~h all ")],
    ],
)
def test_the_nearest_handler_that_can_catch_it_does(told, kind, expected):
    assert told(f"caught({kind});", THROWERS) == expected


def test_one_that_is_thrown_again_from_a_handler_and_one_in_a_destructor(told):
    more = (
        THROWERS + 'struct Inner { ~Inner() { try { throw 1; } catch (int) { tell("in "); } } };\n'
    )
    text = """
    try { try { throw Oops(1); } catch (std::runtime_error &) { tell("first "); throw; } }
    catch (Oops &o) { tell(o.code == 1 ? "second " : "?"); }
    try { Inner i; throw 8; } catch (int n) { tell(n == 8 ? "8 " : "?"); }
    try { try { throw 2; } catch (int) { throw 3; } } catch (int n) { tell(n == 3 ? "3" : "?"); }
    """
    assert told(text, more) == "first second in 8 3"


def test_what_the_library_of_cpp_throws(told):
    text = """
    try { std::vector<int> v(3); v.at(7) = 1; } catch (const std::out_of_range &) { tell("at "); }
    try { (void)std::stoi("abc"); } catch (std::invalid_argument &) { tell("stoi "); }
    try { (void)std::string("abc").substr(9); } catch (std::logic_error &) { tell("substr"); }
    """
    assert told(text) == "at stoi substr"


def test_thousands_leave_nothing_on_the_heap(ran, value):
    text = """
    for (int i = 0; i < 300; i++)
        try { if (i % 3) throw std::string(60, 'x'); } catch (std::string &s) { result[0]++; }
    """
    controller = ran(text)
    assert value(controller, "main.result[0]") == 200
    assert value(controller, "main.plc_heap.Used") == 0


def test_types_at_run_time(told):
    more = """
    struct Base { virtual ~Base() {} }; struct Left : virtual Base { int l = 1; };
    struct Right : virtual Base { int r = 2; }; struct Join : Left, Right {};
    """
    text = """
    Join join; Left alone; Base *base = &join; Left *left = dynamic_cast<Left *>(base);
    if (left == &join && dynamic_cast<Right *>(left)->r == 2) tell("across ");
    if (!dynamic_cast<Right *>(&alone)) tell("not ");
    if (typeid(*base) == typeid(Join) && typeid(alone) != typeid(Join)) tell("typeid ");
    try { (void)dynamic_cast<Right &>((Base &)alone); } catch (std::bad_cast &) { tell("bad"); }
    """
    assert told(text, f"#include <typeinfo>\n{more}") == "across not typeid bad"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("caught(1);\nthrower(2);", "that nobody catches: runtime_error: run (Main.cpp:"),
        ("thrower(1);", "that nobody catches: 5 (Main.cpp:14)"),
        ("try { throw 1; } catch (char) {}", "that nobody catches: 1 (Main.cpp:30)"),
        ("[]() noexcept { throw 1; }();", "that nobody may let pass: std::terminate"),
        ("try { *(volatile int *)4 = 1; } catch (...) { tell(0); }", "page fault"),
    ],
)
def test_what_nobody_catches_is_a_fault_where_it_was_thrown(ran, text, reason):
    controller = ran(text, THROWERS)
    assert controller.state is State.SERVICE
    where = str(controller.fault).replace("\\", "/").rpartition("(")
    short = f"{where[0]}({where[2].rpartition('/')[2]}"
    assert reason in short


def test_a_loop_in_a_try_ends_by_its_budget(ran):
    controller = ran("static volatile int n; try { for (;;) n++; } catch (...) { tell(0); }")
    assert controller.state is State.SERVICE


def test_the_systems_compiler_says_what_it_takes(run, monkeypatch):
    if (clang := system_clang()) is None:
        pytest.skip("this compiler is not installed")
    monkeypatch.setattr("plcsim.program.c.sources.find_toolchain", lambda: clang)
    text = "#include <AsDefault.h>\nvoid _CYCLIC cyclic(void) { try { } catch (int) { } }\n"
    with pytest.raises(ConfigurationError, match=r"Main.cpp:2:29: .*need the compiler of plcsim"):
        run({"main/Main.cpp": text})
