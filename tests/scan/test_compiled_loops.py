"""Real scan processes whose program never leaves compiled code, where no signal handler runs."""

import os
from pathlib import Path

import pytest

from plcsim.core.system import State
from plcsim.process import watchdog as watchdog_module
from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project

MS = 1_000_000

SOURCE = """
from plcsim import Program
from plcsim.core.system_area import BUDGET
from plcsim.core.memory import SYSTEM_AREA
from plcsim.machine import CodeCache, Machine
from plcsim.machine import opcodes as op
from plcsim.machine.encoder import NO_ARGUMENTS, ModuleWriter, memarg, sleb, uleb

def endless_of(context):
    writer = ModuleWriter("main")
    writer.import_memory("env", "memory")
    endless = writer.function(NO_ARGUMENTS, "endless")
    budget = op.I32_CONST + sleb(SYSTEM_AREA) + op.I64_LOAD + memarg(8 * BUDGET)
    poll = budget + op.I64_CONST + sleb(0) + op.I64_LT_S
    writer.body(
        endless,
        op.LOOP + op.EMPTY + poll + op.IF + op.EMPTY + op.UNREACHABLE + op.END
        + op.BR + uleb(0) + op.END,
    )
    writer.export_function("endless", endless)
    machine = Machine(context.memory, cache=CodeCache(None))
    return machine.instantiate(machine.compile(writer.encode().wasm), {}).function("endless")

class Main(Program):
    __slots__ = ("endless",)
    def init(self):
        self.endless = endless_of(self.context)
"""


@pytest.fixture
def run(project_of, monkeypatch):
    """``run(unit="cyclic", stops=0, ...)``: the result of a run whose unit does not return.

    It is never killed: how long the interruption takes is up to the host.
    """
    monkeypatch.setattr(watchdog_module, "PATIENCE_NS", 100_000 * MS)

    def run(unit="cyclic", realtime="off", watchdog="100ms", settings="", stops=0, **options):
        source = SOURCE
        if unit != "init":
            source += f"    def {unit}(self):\n"
        source += "        self.endless()\n"
        plc = f'init_timeout = "2s"\nwatchdog = "{watchdog}"\nrealtime = "{realtime}"'
        folder = project_of(source, plc=plc, settings=settings)
        asked = []

        def look(supervised):
            page = supervised.page
            is_stuck = page.state is State.RUN and page.active is not None
            if is_stuck and len(asked) < stops:
                asked.append(supervised.stop())

        with Supervisor(read_project(folder), **options) as supervised:
            return supervised.wait(lambda: look(supervised))

    return run


@pytest.mark.parametrize("virtual", [False, True], ids=["real clock", "virtual clock"])
def test_a_cyclic_that_never_leaves_compiled_code_is_a_violation(run, virtual):
    result = run(virtual=virtual)
    fault = result["fault"]
    assert (result["state"], fault["kind"]) == ("SERVICE", "cycle_time_violation")
    assert "program main did not return" in fault["text"]
    file, _, line = fault["location"].rpartition(":")
    assert Path(file).read_text().splitlines()[int(line) - 1].strip() == "self.endless()"


@pytest.mark.parametrize("unit", ["init", "exit"])
def test_an_init_or_exit_that_never_leaves_compiled_code_is_ended(run, unit):
    fault = run(unit, cycles=1)["fault"]
    assert (fault["program"], fault["unit"]) == ("main", unit.upper())
    assert fault["text"] == "the program did not return"


def test_where_it_is_only_logged_the_next_cycle_runs(run):
    result = run(settings='on_violation = "log"', cycles=3)
    assert (result["state"], result["fault"]) == ("STOPPED", None)
    assert result["task_classes"][0]["violations"]["program"] == 3


def test_a_second_request_to_stop_ends_it(run):
    result = run(watchdog="1h", stops=2, settings='on_violation = "log"')
    assert result["state"] == "STOPPED"
    assert result["task_classes"][0]["cycles"] == 1


@pytest.mark.skipif(os.geteuid() != 0, reason="real-time rights are for root")
def test_real_time_rights_do_not_keep_the_watchdog_out(run):
    result = run(realtime="require")
    assert any(right.startswith("SCHED_FIFO") for right in result["realtime_rights"])
    assert result["fault"]["kind"] == "cycle_time_violation"
    assert result["fault"]["response_ns"] > 100 * MS
