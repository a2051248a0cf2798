"""Everything that C does wrong is a fault with its line; the process lives, a thousand times."""

import gc
from pathlib import Path

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError, ProgramError
from plcsim.core.system import State

HEAD = """#include <AsDefault.h>
#include <assert.h>
#include <stdlib.h>
#include <string.h>
static volatile int zero;
static char area[8];
static void (*volatile action)(void);
static int (*volatile other)(int, int);
static int eat(int n) { volatile char room[1000]; room[0] = (char)n; return eat(n + 1) + room[0]; }
static void nothing(void) {}
"""
WRONG = {
    "*(volatile int *)0 = 1;": "page fault: address 16#00000000",
    "zero = *(volatile int *)0xFFFFFFFC;": "page fault: address 16#FFFFFFFC",
    "*(volatile char *)0x7FFF0000 = 1;": "page fault: address 16#7FFF0000",
    "memcpy(area, area + 1, (size_t)-1);": "page fault",
    "strcpy((char *)4, area);": "page fault: address 16#00000004",
    "zero = 5 / zero;": "division by zero",
    "zero = eat(0);": "stack overflow",
    "action();": "nil",
    "other = (int (*)(int, int))nothing; zero = other(1, 2);": "of another type",
    "{ char *p = malloc(8); free(p); free(p); }": "freed before",
    "{ char *p = malloc(8); free(malloc(8)); memset(p, 9, 20); free(p); }": "the heap is damaged",
    "{ int *p = malloc(40); free(p); p[0] = 1; free(malloc(40)); }": "into a freed one",
    "{ int *p = malloc(40); free(p); p[7] = 1; free(malloc(40)); }": "area of the heap that was",
    "assert(zero == 1);": "assertion failed: zero == 1",
    "abort();": "abort was called",
    "while (1);": "more instructions than allowed",
}
CASES = "\n".join(f"\tcase {n}: {text} break;" for n, text in enumerate(WRONG))
MAIN = f"{HEAD}void _CYCLIC run(void)\n{{\n\tswitch (wanted) {{\n{CASES}\n\t}}\n}}\n"
FIRST_CASE = HEAD.count("\n") + 4


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


@pytest.fixture
def controller(run, monkeypatch):
    """A controller with the program, before its first fault."""
    monkeypatch.setattr("plcsim.machine.machine.UNIT_FUEL", 60_000_000)
    return run({"main/Main.c": MAIN, "main/V.var": "VAR wanted : INT := -1; END_VAR"}, cycles=1)


def made(controller, number):
    """Let the program do something wrong; return its location and what was told of it."""
    controller.tags.write(controller.tags.find("main.wanted"), value=number)
    controller.run(cycles=1)
    if isinstance(controller.fault, ProgramError):
        return controller.fault.location, controller.fault.reason
    (violation,) = controller.violations[-1:]
    return violation.location, "more instructions than allowed"


@pytest.mark.parametrize("number", range(len(WRONG)))
def test_it_is_told_with_its_line_and_what_it_is(controller, number):
    location, reason = made(controller, number)
    text, expected = list(WRONG.items())[number]
    inner = HEAD.splitlines().index(next(x for x in HEAD.splitlines() if "eat(int" in x)) + 1
    line = inner if "eat" in text else FIRST_CASE + number
    assert location.endswith(f"main/Main.c:{line}")
    assert expected in reason or not reason
    assert controller.state is State.SERVICE


def test_a_thousand_faults_leave_nothing_behind(controller):
    def state():
        return controller.memory.used, len(list(Path("/proc/self/fd").iterdir()))

    def resident():
        return int(Path("/proc/self/statm").read_text().split()[1]) * 4

    numbers = [n for n, text in enumerate(WRONG) if "while" not in text]
    for n in numbers:
        made(controller, n)
        controller.boot()
    gc.collect()  # what others left open is not counted
    before, size = state(), resident()
    for count in range(1000):
        made(controller, numbers[count % len(numbers)])
        assert controller.state is State.SERVICE
        controller.boot()
        assert controller.state is State.RUN
    assert state() == before
    growth = resident() - size
    print(f"1,000 faults: {size} KiB before, {size + growth} KiB after")
    assert growth < 4000
