"""Tests written in Structured Text: each a program of its own, on a controller of its own.

A test is a PROGRAM or a FUNCTION_BLOCK whose name begins with ``test``. It sees what the project
around its file declares, and the assertions of `plcsim.testing.assertions`. It runs for one cycle,
or, where it calls ``TEST_FINISHED``, until it does.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.clock import VirtualClock
from plcsim.core.system import State
from plcsim.library.library import check_scope
from plcsim.network import VirtualNetwork
from plcsim.program.layout import folder_layout, outside_libraries
from plcsim.program.loader import ProgramLoader
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup
from plcsim.program.structured_text.check.programs import MeantProgram
from plcsim.program.structured_text.code import compile_program
from plcsim.program.structured_text.dialect import is_standard
from plcsim.program.structured_text.sources import UnitFile, check_syntax, read_files
from plcsim.program.structured_text.syntax.tree import FunctionBlockUnit, ProgramUnit
from plcsim.project.assembly import VIRTUAL_IP, Application, assemble
from plcsim.project.plc_toml import read_project
from plcsim.project.project_file import project_file
from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC
from st_types.resolve.scope import Scope
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.context import Context
    from plcsim.core.errors import ProgramError
    from plcsim.core.task import Violation
    from plcsim.program.layout import SourceLayout

PREFIX: Final = "TEST"
CYCLE_NS: Final = 10_000_000
MOST_CYCLES: Final = 60_000
"""Ten minutes of the virtual clock; a test that goes on has failed."""

ASSERTIONS: Final = Path(__file__).parent / "assertions"
FINISHED: Final = "TEST_FINISHED"
_CALLER: Final = "plcsim_test"


class TestState:
    """What a test has said of itself.

    Attributes:
        is_finished: it has called TEST_FINISHED.
    """

    __test__ = False  # pytest collects no class here

    def __init__(self, _context: Context) -> None:
        self.is_finished = False


class StructuredTextTest(NamedTuple):
    """One test.

    Attributes:
        name: of its PROGRAM or FUNCTION_BLOCK.
        line: of that, from 1.
        is_block: it is a FUNCTION_BLOCK.
    """

    name: str
    line: int
    is_block: bool


class Failure(Exception):  # noqa: N818  # what a test ends with
    """A test that failed; the text says where and why."""


def tests_in(file: Path) -> list[StructuredTextTest]:
    """Return the tests of a file, in order.

    Raises:
        ConfigurationError: it cannot be read, or has errors in its syntax.
    """
    (found,) = read_files([file])
    check_syntax([found])
    tests = []
    for unit in found.parsed.units:
        is_block = isinstance(unit, FunctionBlockUnit)
        if isinstance(unit, FunctionBlockUnit):
            name = unit.declaration.name
        elif isinstance(unit, ProgramUnit):
            name = unit.name
        else:
            continue
        if name.upper().startswith(PREFIX):
            line = found.parsed.location(unit).line
            tests.append(StructuredTextTest(name, line, is_block))
    return tests


def run_test(file: Path, test: StructuredTextTest) -> None:
    """Run a test.

    Raises:
        Failure: an assertion does not hold, or the test ended in SERVICE or not at all.
        ConfigurationError: it cannot be compiled; all findings are told.
    """
    loader = ProgramLoader(_layout(file))
    try:
        application, goes_on = _application(file, test, loader)
        _run(application, test, goes_on=goes_on)
    finally:
        loader.unload()


def _layout(file: Path) -> SourceLayout:
    """Return the layout of the project around a test, without programs, with the assertions."""
    folder = next((f for f in file.parents if project_file(f) is not None), None)
    if folder is None:
        return folder_layout(file.parent, (), [ASSERTIONS])
    layout = read_project(folder).layout
    libraries = (*layout.libraries, *outside_libraries([ASSERTIONS]))
    return replace(layout, programs={}, libraries=libraries)


def _application(
    file: Path, test: StructuredTextTest, loader: ProgramLoader
) -> tuple[Application, bool]:
    """Return what runs a test, and whether it runs until it says that it is finished."""
    loader.load()
    files = read_files([file])
    declared = [files[0].declarations()]
    dialect = IEC if is_standard(files[0].parsed) else AUTOMATION_STUDIO
    outer = (loader.declarations.scope,)
    scope = Scope(file.stem, declared, outer, dialect=dialect, strict=True)
    check_scope(scope)
    program = test.name
    if test.is_block:
        program = _CALLER
        text = "\n" * (test.line - 1)  # so that the call seems to come from its first line
        text += f"PROGRAM {_CALLER} VAR test : {test.name}; END_VAR test(); END_PROGRAM"
        files.append(UnitFile(Source(str(file), text)))
    catalogue = loader.declarations.catalogue
    code = compile_program(test.name, files, scope, loader.shared, catalogue, MeantProgram(program))
    classes = [TaskClassSetup(1, CYCLE_NS, [ProgramSetup(test.name, code)])]
    has_shared = any(kind.members for kind in loader.shared)
    setup = Setup(classes, shared=loader.shared if has_shared else None, catalogue=catalogue)
    return Application(test.name, setup), FINISHED in code.imported


def _run(application: Application, test: StructuredTextTest, *, goes_on: bool) -> None:
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host(VIRTUAL_IP)
    controller = assemble(application, clock=clock, network=network)
    controller.boot()
    for _ in range(MOST_CYCLES if goes_on else 1):
        if controller.run(cycles=1) is not State.RUN:
            raise Failure(_told(controller.fault))
        if not goes_on or controller.context.library(TestState).is_finished:
            controller.shutdown()
            return
    raise Failure(f"{test.name} has not called {FINISHED} in {MOST_CYCLES} cycles")


def _told(fault: ProgramError | Violation | None) -> str:
    """Return what a fault means, with the line and the calls that led there."""
    reason = getattr(fault, "reason", "") or str(fault)
    location = getattr(fault, "location", "")
    calls: Sequence[str] = getattr(fault, "calls", ())
    lines = [f"{location}: {reason.removeprefix('AssertionError: ')}"]
    number = location.rpartition(":")[2]
    file = Path(location.rpartition(":")[0])
    if number.isdecimal() and file.is_file():
        text = file.read_text("utf-8", "replace").splitlines()
        lines += [f"> {text[int(number) - 1].strip()}"] if int(number) <= len(text) else []
    lines += [f"  {call}" for call in calls[:-1]]
    return "\n".join(lines)
