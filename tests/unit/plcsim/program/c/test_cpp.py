"""Units in C++: new and delete, templates, virtual functions, static construction."""

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State

MAIN = """
#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif
#include <stdint.h>
#include <stddef.h>
#include <string.h>
#include <math.h>

unsigned long bur_heap_size = 0xFFFF;

struct Shape {
	virtual ~Shape() {}
	virtual double area() const = 0;
};
struct Square : Shape {
	double a;
	explicit Square(double x) : a(x) {}
	double area() const override { return a * a; }
};
template <typename T, int N> struct Ring {
	T values[N];
	int count = 0;
	void put(T v) { values[count++ % N] = v; }
	T sum() const { T s = 0; for (int i = 0; i < N && i < count; i++) s += values[i]; return s; }
};
class Counter {
public:
	Counter() : n(40) {}
	~Counter() { n = 0; }
	int n;
};
static Counter counter;
static Ring<long, 4> ring;
static void *volatile seen; // so that no compiler leaves the new out

void _INIT ProgramInit(void) { counter.n++; }
void _CYCLIC ProgramCyclic(void)
{
	static Counter once;
	Shape *shape = new Square(1.5);
	int *many = new int[10]();
	seen = many;
	ring.put(counter.n);
	total = ring.sum() + once.n + many[3];
	area = sqrt(shape->area());
	on = true;
	delete shape;
	delete[] many;
}
"""


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


def test_a_unit_in_cpp_runs_and_starts_anew(run, value):
    files = {
        "main/Main.cpp": MAIN,
        "main/V.var": "VAR total : DINT; area : LREAL; on : BOOL; END_VAR",
    }
    controller = run(files, cycles=3)
    assert (controller.state, controller.fault) == (State.RUN, None)
    assert value(controller, "main.total") == 3 * 41 + 40
    assert value(controller, "main.area") == 1.5
    assert value(controller, "main.on") is True


def test_new_without_room_is_a_fault_with_its_line(run):
    text = MAIN.replace("0xFFFF", "0x28")
    controller = run(
        {"main/Main.cpp": text, "main/V.var": "VAR total : DINT; area : LREAL; on : BOOL; END_VAR"},
        cycles=3,
    )
    line = next(n for n, each in enumerate(text.splitlines(), 1) if "new int[10]" in each)
    assert controller.fault.location.endswith(f"main/Main.cpp:{line}")
    assert controller.fault.reason == "the heap has no room for what new asks for"


LIBRARY = """
#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif
#include <memory>
#include <string>
#include <unordered_map>

unsigned long bur_heap_size = 0xFFFF;
static int alive;
struct Part {
	Part() { alive++; }
	~Part() { alive--; }
};

void _INIT ProgramInit(void)
{
	std::unordered_map<std::string, int> found;
	for (int i = 0; i < 100; i++)
		found[std::to_string(i)] = i;
	sum = found["7"] + found["99"] + (int)found.size();
	std::string told = std::to_string(-4.5) + " " + std::to_string(0xFFFFFFFFu);
	told.copy(text, sizeof text - 1);
	size_t read;
	number = std::stoi("12 parts", &read) + 100 * (int)read;
	real = std::stod("2.5e2") + std::stoul("ff", nullptr, 16);

	std::weak_ptr<Part> watch;
	{
		auto one = std::make_shared<Part>();
		auto other = one;
		watch = other;
		one.reset();
		held = watch.lock() != nullptr && alive == 1;
	}
	gone = watch.lock() == nullptr && alive == 0;
}
void _CYCLIC ProgramCyclic(void) { number = std::stoi("none"); }
"""
LIBRARY_VARIABLES = """
VAR
	sum : DINT; text : STRING[40]; number : DINT; real : LREAL; held : BOOL; gone : BOOL;
END_VAR
"""


def test_containers_texts_and_owners_of_the_standard_library(run, value):
    if not find_toolchain().cpp_options:
        pytest.skip("this compiler has no standard library of C++")
    files = {"main/Main.cpp": LIBRARY, "main/V.var": LIBRARY_VARIABLES}
    controller = run(files, cycles=2)
    assert controller.state is State.SERVICE
    assert "none is no number" in str(controller.fault)
    names = ("sum", "text", "number", "real", "held", "gone")
    assert [value(controller, f"main.{name}") for name in names] == [
        *(206, "-4.500000 4294967295", 212, 505.0),
        *(True, True),
    ]
