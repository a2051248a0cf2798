"""C and C++ as Automation Studio's GCC takes it and clang does not: it runs, and gives the same."""

import pytest

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.toolchain import find_toolchain, system_clang, zig
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.machine import CodeCache
from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project

VARIABLES = "VAR result : ARRAY[0..9] OF DINT; flag : BOOL; END_VAR"


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


PLC = """
[c]
options = [%s]
[task_class.1]
cycle = "10ms"
programs = ["main"]
"""


@pytest.fixture
def results(run, value):
    """``results({"Main.c": text}, 2)``: two elements of the array ``result`` after some cycles."""

    def call(files, count):
        here = {f"main/{name}": text for name, text in files.items()}
        controller = run({"main/V.var": VARIABLES, **here})
        assert (controller.state, controller.fault) == (State.RUN, None)
        return [value(controller, f"main.result[{n}]") for n in range(count)]

    return call


def _with_head(text):
    return f"#include <bur/plctypes.h>\n#include <AsDefault.h>\n{text}"


def test_variables_without_a_value_have_one(results):
    text = _with_head("""
struct point { int x; char name[10]; };
static int classify(int limit)
{
	int level; struct point here; char text[8];
	if (limit > 100) level = 3;
	if (level == 2 || here.name[3] || text[1] > 'x') return 7;
	return level;
}
void _CYCLIC run(void) { result[0] = classify(4) + 40; result[1] = classify(400); }
""")
    assert results({"Main.c": text}, 2) == [40, 3]


def test_functions_of_c_that_end_without_a_return_give_0(results):
    text = _with_head("""
struct pair { short a, b; };
static int state;
static int next(int x) { state = x; }
static struct pair both(int x) { if (x > 3) { struct pair p = {1, 2}; return p; } }
count(x) { if (x) return 3; }
void _CYCLIC run(void)
{
	struct pair p = both(5);
	if (next(5) == 1) result[1] = 99;
	both(1);
	result[0] = state + p.b; result[2] = count(0); result[3] = count(1);
}
""")
    assert results({"Main.c": text}, 4) == [7, 0, 0, 3]


def test_functions_of_cpp_that_end_without_a_return_go_on(results):
    header = """
enum class Mode { Off, On };
class Motor {
	int speed = 0;
public:
	Motor &operator=(const Motor &other) { speed = other.speed; }
	bool start() { speed = 10; }
	int setSpeed(int s) { if (s > 100) return 1; speed = s; }
	const char *name() { if (speed < 0) return "back"; }
	Mode mode() { if (speed == 99) return Mode::On; }
	template <class T> T as() { if (speed > 1000) return T(speed); }
	int get() const { return speed; }
};
"""
    text = _with_head("""#include "Motor.hpp"
static Motor one, two;
Motor copied(const Motor &m) { one = m; }
void _CYCLIC run(void)
{
	two.start(); one = two; result[0] = one.get();
	if (two.setSpeed(30) == 0) result[1] = two.get();
	if (!two.name() && two.mode() == Mode::Off && two.as<double>() == 0) result[2] = 1;
	copied(two); result[3] = one.get();
	auto lambda = [](int x) -> int { if (x) return 5; }; result[4] = lambda(0);
}
""")
    found = results({"Main.cpp": text, "Motor.hpp": header}, 5)
    assert found == [10, 30, 1, 30, 0]


def test_headers_are_found_as_windows_finds_them(results):
    files = {
        "Main.c": _with_head(
            '#include "Sub\\deep.h"\n#include "..\\COMMON\\Types.h"\n#include "../Common/More.H"\n'
            "void _CYCLIC run(void) { result[0] = DEEP; result[1] = TYPES; result[2] = MORE; }\n"
        ),
        "sub/Deep.h": '#include ".\\inner\\Value.h"\n#define DEEP (VALUE + 1)\n',
        "sub/Inner/value.h": "#define VALUE 3\n",
        "../common/types.h": '#include "Beside.h"\n#define TYPES BESIDE\n',
        "../common/beside.h": "#define BESIDE 20\n",
        "../common/more.h": "#define MORE 30\n",
    }
    assert results(files, 3) == [4, 20, 30]


def test_a_header_in_another_case_is_nothing_to_warn_of(project):
    files = {
        "plc.toml": PLC % "",
        "main/Main.c": _with_head('#include "MORE.h"\nvoid _CYCLIC run(void) { int x; MORE; }\n'),
        "main/More.h": "#define MORE x++\n#warning seen\n",
    }
    application = load(read_project(project(files)))
    (warning,) = application.warnings
    assert "seen" in warning
    application.unload()


def test_a_header_that_is_not_there_is_told_where_it_is_included(run):
    text = _with_head('#include "..\\Common\\types.h"\nvoid _CYCLIC run(void) {}\n')
    with pytest.raises(ConfigurationError, match=r"Main.c:3:10: '..\\Common\\types.h' file not"):
        run({"main/Main.c": text})


@pytest.mark.parametrize("name", ["Main.c", "Main.cpp"])
def test_trigraphs_mean_what_they_mean_with_its_options(results, name):
    text = _with_head(
        "static int t??(3??) = ??<1, 2, 3??>;\n"
        "void _CYCLIC run(void) ??< result??(0??) = t??(2??); ??>\n"
    )
    assert results({name: text}, 1) == [3]


@pytest.mark.parametrize("find", [zig, system_clang])
def test_what_is_mended_is_told_all_the_same(tmp_path, find):
    if (toolchain := find()) is None:
        pytest.skip("this compiler is not installed")
    file = tmp_path / "Main.c"
    file.write_text(
        "int f(int x)\n{\n\tint l; g(); if (x) l = 3; if (l) return 2;\n}\nvoid g(void) {}\n"
    )
    cache = CodeCache(tmp_path / "cache")
    for _ in range(2):
        built = build(BuildOrder("program", [file], [INCLUDE]), toolchain, cache)
        found = sorted(each.partition(": ")[2].partition("'")[0] for each in built.warnings)
        assert len(found) == 2
        assert "undeclared function" in found[0] or "implicit declaration" in found[0]
        assert any(each.startswith("non-void function does not return a value") for each in found)


def test_a_unit_that_is_there_twice_is_told_with_both_places(run):
    files = {"main/Main.c": _with_head("void _CYCLIC run(void) {}\n")}
    files["main/Old.c"] = _with_head("\nvoid _CYCLIC old(void) {}\n")
    with pytest.raises(ConfigurationError, match=r"main: _CYCLIC .*Main.c:3 and .*Old.c:4"):
        run(files)


def test_a_variable_of_a_header_is_one_for_all_files(results):
    files = {
        "shared.h": "int counter;\nstruct { char a; int b[3]; } whole;\nlong first, last;\n",
        "Main.c": _with_head(
            '#include "shared.h"\nvoid step(void);\nchar text[4];\nint known = 5;\n'
            "void _CYCLIC run(void) { counter++; step(); result[0] = counter; result[1] = known;\n"
            "result[2] = text[3]; result[3] = whole.b[2]; result[4] = first * 10 + last; }\n"
        ),
        "Step.c": _with_head(
            '#include "shared.h"\nint known;\nchar text[60];\nint known, counter;\n'
            "void step(void) { memset(text, 7, sizeof text); whole.b[2] = ++counter;\n"
            "first = 1; last = 2; }\n"
        ),
    }
    assert results(files, 5) == [6, 5, 7, 6, 12]


def test_what_has_a_value_in_two_files_is_refused(run):
    files = {"main/Main.c": _with_head("int x = 1;\nvoid _CYCLIC run(void) {}\n")}
    files["main/More.c"] = "int x = 2;\n"
    with pytest.raises(ConfigurationError, match=r"x is defined at .*Main.c:3 and at .*More.c:1"):
        run(files)


def test_a_pointer_to_a_function_of_math_is_one_to_that_of_math_h(results):
    text = _with_head("""
#include <math.h>
#include <setjmp.h>
static double (*const table[])(double) = {floor, ceil, sqrt, fabs};
static jmp_buf here;
void _CYCLIC run(void)
{
	int n;
	for (n = 0; n < 4; n++) result[n] = table[n](6.25) * 100;
	if (setjmp(here) == 0) longjmp(here, 1);
	result[4] = fmod(7, 4) + floor(2.5);
}
""")
    assert results({"Main.c": text}, 5) == [600, 700, 250, 625, 5]


@pytest.mark.parametrize(
    "own",
    [
        "typedef enum {FALSE, TRUE} bool;",
        "enum { FALSE = 0, TRUE = !FALSE };\ntypedef int bool;",
        "static const int TRUE = 1, FALSE = 0;\ntypedef long bool;",
        "typedef enum\n{\n\tFALSE,\n\tTRUE\n} bool;",
    ],
)
def test_a_source_may_have_truth_of_its_own(results, own):
    text = _with_head(
        f"{own}\nbool here;\n"
        "void _CYCLIC run(void) { here = TRUE; if (here != FALSE) result[0] = here + 3; }\n"
    )
    assert results({"Main.c": text}, 1) == [4]


NESTED = """
struct point { int x, y; };
static int outer(struct point *p, int n)
{
	int sum = 0, i; struct point here = {1, 2};
	// a nested { function
	void add(int v)
	{
		sum += v * n;
		here.x++;
	}
	static int twice(int v) { return v * 2; }
	char *text(void)
	{ /* } */
		return "}";
	}
	int fibonacci(int k) { return k < 2 ? k : fibonacci(k - 1) + fibonacci(k - 2); }
	int nothing(int k) { if (k > 100) return 1; }
	for (i = 0; i < 3; i++) {
		int j = i;
		int inner(int z) { j += z; return j; }
		add(inner(p->x));
	}
	sum += 1000; add(1);
	return sum + here.x + twice(3) + (text()[0] == '}') + fibonacci(7) + nothing(n);
}
void _CYCLIC run(void)
{
	struct point p = {2, 3};
	result[0] = outer(&p, 10);
	result[1] = __LINE__;
}
"""


def test_functions_in_functions_use_the_variables_around_them(results):
    line = NESTED[: NESTED.index("__LINE__")].count("\n") + 3
    assert results({"Main.c": _with_head(NESTED)}, 2) == [1125, line]


def test_functions_in_functions_use_the_arrays_around_them(results):
    text = _with_head("""
struct box { int list[4]; };
static int outer(int n)
{
	int list[4] = {1, 2, 3, 4};
	int sum = 0;
	char names[2][5] = {"ab", "cde"};
	struct box here = {{10, 20, 30, 40}};
	void add(int i)
	{
		list[i] += 100; /* list */
		sum = list[i] + here.list[i] + sizeof(list) + sizeof list;
	}
	int length(int which) { int k = 0; while (names[which][k]) k++; return k; }
	int own(void) { int list[2] = {7, 8}; return list[1]; }
	add(n);
	return sum * 1000 + list[n] + length(1) + own();
}
void _CYCLIC run(void) { result[0] = outer(2); result[1] = __LINE__; }
""")
    expected = (103 + 30 + 32) * 1000 + 103 + 3 + 8
    assert results({"Main.c": text}, 2) == [expected, text.count("\n")]


@pytest.mark.parametrize(
    ("inner", "use"),
    [
        ("int f(int i) { return 1; }", "taken(f)"),
        ("int f(int i) { return n++; }", "f(1)"),
    ],
)
def test_what_a_nested_function_cannot_do_is_told(run, inner, use):
    text = _with_head(
        f"int taken(int (*take)(int));\nint g(int n)\n{{\n\tint list[3] = {{1, 2, 3}};\n\t{inner}\n"
        f"\treturn {use} + list[0];\n}}\nvoid _CYCLIC run(void) {{ result[0] = g(1); }}\n"
    )
    with pytest.raises(ConfigurationError, match=r"Main.c:[78]:\d+: .*nested function"):
        run({"main/Main.c": text, "main/V.var": VARIABLES})


def test_names_of_a_project_go_before_those_that_are_new_in_cpp_17(results):
    text = _with_head("""#include <memory>
#include <functional>
#include <algorithm>
#include <vector>
using namespace std;
typedef unsigned char byte;
static int data = 3, size = 4, wide = 300;
static byte one = 7, list[] = {wide, 2};
static int thrower() throw(int);
struct Falling : std::binary_function<int, int, bool> {
	bool operator()(int a, int b) const { return a > b; }
};
void _CYCLIC run(void)
{
	std::auto_ptr<int> owner(new int(3));
	vector<int> v; v.push_back(1); v.push_back(5); sort(v.begin(), v.end(), Falling());
	result[0] = data + size + one + *owner; result[1] = list[0]; result[2] = v[0];
	result[3] = count_if(v.begin(), v.end(), bind2nd(greater<int>(), 2));
}
""")
    assert results({"Main.cpp": text}, 4) == [17, 44, 5, 1]


def test_options_that_mean_nothing_here_are_left_out(results):
    options = '"-std=gnu++11", "-msse2", "-O0", "-Werror", "-fcommon", "-DOWN=4"'
    files = {
        "../plc.toml": PLC % options,
        "Main.c": _with_head("int more(void);\nvoid _CYCLIC run(void) { result[0] = more(); }\n"),
        "More.cpp": '#include <string>\nextern "C" int more()\n'
        '{ return OWN + std::string("a text of some length, so it is no short one").size(); }\n',
    }
    assert results(files, 1) == [48]


def test_an_inline_function_is_one_for_other_files_with_gcc_4(run, value):
    plc = PLC % '"-fgnu89-inline"'
    files = {
        "plc.toml": plc,
        "main/V.var": VARIABLES,
        "main/Main.c": _with_head(
            "int deep(int);\nvoid _CYCLIC run(void) { result[0] = deep(4); }\n"
        ),
        "main/Deep.c": "inline int deep(int n)\n{ return n < 1 ? 1 : n * deep(n - 1); }\n",
    }
    assert value(run(files), "main.result[0]") == 24


def test_long_double_has_its_functions(results):
    text = _with_head("""
#include <math.h>
#include <stdio.h>
void _CYCLIC run(void)
{
	volatile long double x = 6.25L; long double whole; int exponent; char text[20];
	result[0] = 100 * sqrtl(x) + fabsl(-x) * 4; result[1] = powl(x, 2) * 16;
	result[2] = 100 * modfl(x, &whole) + whole; result[3] = 100 * frexpl(x, &exponent);
	result[4] = exponent + lroundl(x) + snprintf(text, sizeof text, "%.3Lf", sinl(x));
}
""")
    assert results({"Main.c": text}, 5) == [275, 625, 31, 78, 3 + 6 + 6]


@pytest.mark.parametrize(("name", "line"), [("Main.c", 9), ("Main.cpp", 10)])
def test_a_missing_brace_before_a_unit_is_told_where_the_unit_begins(run, name, line):
    text = _with_head("static int f(int x)\n{\n\tif (x) {\n\t\tx++;\n\treturn x;\n}\n")
    with pytest.raises(ConfigurationError) as refused:
        run({f"main/{name}": f"{text}void _CYCLIC run(void)\n{{\n\tf(1);\n}}\n"})
    (told,) = [each for each in refused.value.findings if "inside another function" in each]
    assert f"/main/{name}:{line}:" in told
    assert "a } is missing somewhere before it" in told
    assert not any("export_name" in each for each in refused.value.findings)
