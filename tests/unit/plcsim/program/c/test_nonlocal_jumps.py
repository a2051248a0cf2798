"""setjmp and longjmp in a unit, by each compiler: C11 7.13, and what a controller adds."""

import pytest

from plcsim.ansi_c.toolchain import system_clang, zig
from plcsim.core.errors import ProgramError
from plcsim.core.system import State

JUMPS = r"""
#include <AsDefault.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

DINT result[12];
LREAL real;
static jmp_buf outer, inner, stale;
static volatile int zero;

static void __attribute__((noinline)) deep(int n, int value)
{
	volatile char room[64];
	room[0] = (char)n;
	if (n == 0)
		longjmp(outer, value);
	deep(n - 1, value);
	room[1] = room[0];
}

static int __attribute__((noinline)) told(int value) /* what setjmp says in a switch */
{
	switch (setjmp(outer)) {
	case 0: deep(0, value);
	case 1: return 101;
	case 7: return 107;
	default: return -1;
	}
}

static int __attribute__((noinline)) kept(void)
{
	volatile int counted = 1;
	int untouched = result[0] + 5;
	while (setjmp(outer) < 3) {
		counted += 10;
		deep(20, counted / 10);
	}
	return counted + untouched;
}

static int __attribute__((noinline)) nested(void)
{
	volatile int way = 0;
	if (setjmp(outer) == 0) {
		if (setjmp(inner) == 0) {
			way = way * 10 + 1;
			longjmp(inner, 1);
		}
		way = way * 10 + 2;
		longjmp(outer, 2);
	}
	return way * 10 + 3;
}

static void __attribute__((noinline)) middle(void) /* waits itself, but not for this jump */
{
	if (setjmp(inner) == 0)
		deep(5, 9);
	result[8] = -1;
}

static int __attribute__((noinline)) passed(void)
{
	int told = setjmp(outer);
	if (told == 0)
		middle();
	return told;
}

typedef struct { double values[4]; long long sum; } Large;
static Large __attribute__((noinline)) large(Large given, float f, double d, long long l)
{
	if (l < 0)
		longjmp(outer, 4);
	given.sum = l + (long long)given.values[3];
	given.values[0] = f + d;
	return given;
}

static long long __attribute__((noinline)) typed(long long l)
{
	Large given = {{1, 2, 3, 4}, 5};
	if (setjmp(outer))
		return -44;
	Large (*volatile call)(Large, float, double, long long) = large;
	given = call(given, 0.5f, 0.25, l);
	real = given.values[0];
	return given.sum;
}

static void __attribute__((noinline)) leave(void) { if (setjmp(stale) == 0) result[9]++; }

static int compare(const void *a, const void *b)
{
	if (*(const int *)a == 3 || *(const int *)b == 3)
		longjmp(outer, 6);
	return *(const int *)a - *(const int *)b;
}

static int __attribute__((noinline)) out_of_the_library(void)
{
	int numbers[] = {5, 4, 3, 2, 1};
	int told = setjmp(outer);
	if (told == 0)
		qsort(numbers, 5, sizeof *numbers, compare);
	return told;
}

static int __attribute__((noinline)) again(int rounds)
{
	volatile int sum = 0;
	for (volatile int i = 0; i < rounds; i++) {
		char *area = malloc(100);
		memset(area, i, 100);
		int told = setjmp(outer);
		if (told == 0)
			deep(3, i + 1);
		sum += told == i + 1;
		free(area);
	}
	return sum;
}

static int recursive(int n)
{
	jmp_buf here;
	return setjmp(here) ? 0 : 1 + recursive(n + 1);
}

void _CYCLIC run(void)
{
	result[0] = told(7) + told(0); /* 0 becomes 1 */
	result[1] = kept();
	result[2] = nested();
	result[3] = passed();
	result[4] = (DINT)typed(3);
	result[5] = (DINT)typed(-3);
	result[6] = out_of_the_library();
	result[7] = again(ROUNDS);
	switch (wanted) {
	case 1:
		leave();
		longjmp(stale, 1); /* undefined in C: the function has returned */
	case 2:
		if (setjmp(outer) == 0)
			result[10] = 5 / zero;
		break;
	case 3:
		if (setjmp(outer) == 0)
			for (;;)
				zero++;
		break;
	case 4: {
		jmp_buf unset;
		memset(unset, 0, sizeof unset);
		longjmp(unset, 1);
	}
	case 5:
		result[10] = recursive(0);
	}
}
"""
VARIABLES = "VAR wanted : INT; END_VAR"
ROUNDS = "#define ROUNDS 30\n"


@pytest.fixture(params=[zig, system_clang], ids=["zig", "clang"])
def jumping(request, run, monkeypatch):
    """``jumping(cycles)``: the controller of the program."""
    if request.param() is None:
        pytest.skip("this compiler is not installed")
    monkeypatch.setattr("plcsim.program.c.sources.find_toolchain", request.param)

    def jumping(cycles=1, head=ROUNDS):
        return run({"main/Main.c": head + JUMPS, "main/V.var": VARIABLES}, cycles)

    return jumping


def line_of(mark):
    """Return the line of the program in which something stands."""
    return 1 + next(n for n, x in enumerate((ROUNDS + JUMPS).splitlines()) if mark in x)


def test_calls_come_back_where_setjmp_was_called(jumping, value):
    controller = jumping(cycles=3)
    assert controller.state is State.RUN, controller.fault
    assert list(value(controller, "main.result"))[:10] == [
        *(107 + 101, 1 + 30 + 208 + 5, 123, 9, 3 + 4, -44, 6, 30, 0, 0)
    ]
    assert value(controller, "main.real") == 0.75


def test_a_thousand_jumps_leave_nothing_behind(jumping, value):
    controller = jumping(head="#define ROUNDS 1000\n")
    assert value(controller, "main.result[7]") == 1000
    heap = value(controller, "main.plc_heap")
    assert (heap["Used"], heap["Areas"]) == (0, 0)
    assert heap["Most"] < 1000


def test_two_runs_take_equally_many_instructions(jumping):
    first, second = (jumping(cycles=5) for _ in range(2))
    assert first.tasks[0].instructions() == second.tasks[0].instructions() > 1000


@pytest.mark.parametrize(
    ("number", "mark", "reason", "times"),
    [
        (1, "undefined in C", "longjmp to a function that has returned", 3),
        (2, "5 / zero", "division by zero", 3),
        (4, "longjmp(unset", "longjmp to a function that has returned", 3),
        (5, "1 + recursive(n + 1)", "stack overflow", 2),
    ],
)
def test_a_fault_passes_all_that_wait_for_jumps(jumping, value, number, mark, reason, times):
    controller = jumping()
    for _ in range(times):
        controller.tags.write(controller.tags.find("main.wanted"), value=number)
        controller.run(cycles=1)
        assert controller.state is State.SERVICE
        assert isinstance(controller.fault, ProgramError)
        assert controller.fault.location.endswith(f"main/Main.c:{line_of(mark)}")
        assert reason in controller.fault.reason
        controller.boot()
    controller.run(cycles=1)
    assert value(controller, "main.result[2]") == 123


def test_an_endless_loop_behind_setjmp_is_ended(jumping, monkeypatch):
    monkeypatch.setattr("plcsim.machine.machine.UNIT_FUEL", 60_000_000)
    controller = jumping()
    controller.tags.write(controller.tags.find("main.wanted"), value=3)
    controller.run(cycles=1)
    (violation,) = controller.violations[-1:]
    assert violation.location.endswith(f"main/Main.c:{line_of('zero++')}")
    assert controller.state is State.SERVICE
