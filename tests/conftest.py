"""Controllers and projects for the tests, given by fixtures.

Programs are made from functions (`program_of`), put into task classes (`task_class`) and run on a
controller on the virtual clock (`make_controller`). A program of a test says what it costs by
`VirtualClock.spend_ns`, `stall_ns` and `wait_ns`.
"""

import faulthandler
import sys
import textwrap

import pytest
from hypothesis import settings

from plcsim.core.clock import VirtualClock
from plcsim.core.memory import PAGE
from plcsim.host.garbage import collect_while_idle
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup
from plcsim.program.setup import make_controller as controller_of
from tests.processes import processes, told_by

MS = 1_000_000


def pytest_runtest_call():
    """Set the handlers of traps again before each test.

    Machines that a test module makes when it is imported are older than the tests of pytest
    plugins, whose inner runs switch faulthandler off and take the handlers away.
    """
    signals = sys.modules.get("plcsim.machine.signals")
    if signals is not None:
        signals.set_again()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Tell with a failure what its processes did and wrote; they still run."""
    report = yield
    if report.failed:
        for title, text in (
            ("the process", told_by(call.excinfo.value)),
            ("processes", processes()),
        ):
            if text:
                report.sections.append((title, text))
    return report


def pytest_runtest_setup(item):
    """Let no stack be told of a test with a limit of its own before that limit.

    ``faulthandler_timeout`` is one for all; its thread reads frames that change meanwhile, which
    has ended a process by SIGSEGV (CPython 3.11). Where a test hangs that does not matter.
    """
    limit = item.get_closest_marker("timeout")
    told_s = float(item.config.getini("faulthandler_timeout") or 0)
    if limit is not None and limit.args and told_s and limit.args[0] > told_s:
        faulthandler.cancel_dump_traceback_later()


settings.register_profile("plcsim", deadline=None)  # how long it takes is not what tests ask
settings.load_profile("plcsim")


def _program_of(cyclic=None, **body):
    units = {} if cyclic is None else {"cyclic": cyclic}
    return type("TestProgram", (Program,), body | units)


@pytest.fixture(scope="session")
def program_of():
    """``program_of(cyclic, init=..., exit=..., counter=var(UINT))``: a program class."""
    return _program_of


@pytest.fixture(scope="session")
def task_class():
    """``task_class(1, 10, name=program, ...)``: a task class with a cycle time in ms.

    Fields of `TaskClassSetup` in nanoseconds go into ``settings``.
    """

    def task_class(number, cycle_ms, settings=None, /, **programs):
        setups = [ProgramSetup(name, PythonCode(program)) for name, program in programs.items()]
        return TaskClassSetup(number, cycle_ms * MS, setups, **(settings or {}))

    return task_class


@pytest.fixture
def clock():
    """The virtual clock of the test."""
    return VirtualClock()


@pytest.fixture
def make_controller(clock):
    """``make_controller(*classes)``: a controller on the virtual clock, not booted."""

    def make_controller(*classes, **options):
        heartbeat = options.pop("heartbeat", None)
        exception = options.pop("exception_program", None)
        setup = Setup(
            classes,
            memory_size=16 * PAGE,
            exception_program=exception and ProgramSetup("exception", PythonCode(exception)),
        )
        own_clock = options.pop("clock", clock)
        assert not options
        return controller_of(
            setup, network=None, clock=own_clock, heartbeat=heartbeat, idle=collect_while_idle
        )

    return make_controller


@pytest.fixture
def run_for(make_controller):
    """``run_for(50, *classes)``: a controller that has booted and run for some milliseconds."""

    def run_for(duration_ms, *classes, **options):
        controller = make_controller(*classes, **options)
        controller.boot()
        controller.run_for(duration_ms * MS)
        return controller

    return run_for


@pytest.fixture
def project(tmp_path):
    """``project({"plc.toml": "...", "main/main.py": "..."})``: a folder with these files."""

    def project(files):
        folder = tmp_path / "cell"
        for name, text in files.items():
            file = folder / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(textwrap.dedent(text), "utf-8")
        return folder

    return project


@pytest.fixture
def project_of(project):
    """``project_of(main_py)``: a project of one program, ``main``, in a 10 ms task class."""

    def project_of(source, settings="", plc=""):
        head = f'[plc]\n{plc}\n[task_class.1]\ncycle = "10ms"\n{settings}\nprograms = ["main"]\n'
        return project({"plc.toml": head, "main/main.py": source})

    return project_of
