"""A library that ends failed actions by longjmp, Duktape, inside a unit.

This interpreter of JavaScript (MIT licence, 100,000 lines of C) is part of the source distribution
of dukpy, which is taken from the package index. Each error in a script is a longjmp to the call
that was to run it, out of as many functions as were active.
"""

import shutil

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.system import State
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

pytestmark = pytest.mark.timeout(900)  # a download, and 100,000 lines are compiled

PACKAGE = "dukpy==0.5.0"
PLC = """
[plc]
memory = "32MiB"
init_timeout = "300s"
[task_class.1]
cycle = "1ms"
programs = ["main"]
[c]
heap = "8MiB"
include = ["include"]
"""
UNIT = """
#include <bur/plctypes.h>
#include <string.h>
#include "duktape.h"

char script[200];
char answer[200];
DINT failed;
static duk_context *context;

void _INIT begin(void) { context = duk_create_heap_default(); }

void _CYCLIC run(void)
{
	if (!script[0])
		return;
	failed = duk_peval_string(context, script);
	strncpy(answer, duk_safe_to_string(context, -1), sizeof answer - 1);
	duk_pop(context);
	duk_gc(context, 0);
	script[0] = 0;
}
"""
SCRIPTS = {
    "1 + 1": (0, "2"),
    "try { null.x } catch (e) { e.name }": (0, "TypeError"),
    "throw new Error('no')": (1, "Error: no"),
    "syntax error": (1, "SyntaxError: unterminated statement (line 1, end of input)"),
    "var n = 0; for (var i = 1000; i; i--) try { throw i } catch (e) { n += e } n": (
        0,
        "500500",
    ),
    "(function f(n) { return f(n + 1) + 1 })(0)": (1, "RangeError: callstack limit"),
    "[1, 2, 3].map(function (x) { if (x == 2) throw 'in the middle'; return x })": (
        1,
        "in the middle",
    ),
    "JSON.stringify({a: [1, 2.5, 'x']}) + Math.sin(1)": (0, '{"a":[1,2.5,"x"]}0.8414709848078965'),
    "'abc'.replace(/b/, 'X')": (0, "aXc"),
}


@pytest.fixture
def controller(sources_of, tmp_path, monkeypatch):
    (duktape,) = sources_of(PACKAGE).glob("*/src/duktape")
    shutil.copytree(duktape, tmp_path / "include", ignore=shutil.ignore_patterns("*.c"))
    (tmp_path / "main").mkdir()
    shutil.copy(duktape / "duktape.c", tmp_path / "main")
    (tmp_path / "main" / "unit.c").write_text(UNIT)
    (tmp_path / "plc.toml").write_text(PLC)
    monkeypatch.setattr("plcsim.machine.machine.UNIT_FUEL", 1 << 40)
    controller = assemble(load(read_project(tmp_path)), clock=VirtualClock(), network=None)
    controller.boot()
    return controller


def test_scripts_and_their_errors(controller):
    tag = {name: controller.tags.find(f"main.{name}") for name in ("script", "answer", "failed")}
    heap = controller.tags.find("main.plc_heap.Used")
    used = []
    for _ in range(3):
        for script, (failed, answer) in SCRIPTS.items():
            controller.tags.write(tag["script"], value=script)
            controller.run(cycles=1)
            assert controller.state is State.RUN, controller.fault
            found = controller.tags.read(tag["failed"]), controller.tags.read(tag["answer"])
            assert found == (failed, answer), script
        used.append(controller.tags.read(heap))
    assert used[2] <= used[1] + 1000  # Duktape keeps tables of its own
