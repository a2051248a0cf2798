"""What a test runs: a project on disk or program classes, loaded afresh for each test."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from plcsim.core.duration import parse_duration_ns
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup
from plcsim.project.assembly import Application, load, runnable
from plcsim.project.plc_toml import read_project
from plcsim.project.project_file import FILE_NAME, project_file
from plcsim.testing import terminal
from plcsim.testing.errors import PlcTestError
from plcsim.testing.plc import Plc

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from plcsim.program.python.program import Program

__tracebackhide__ = True


def find_project(start: Path) -> Path:
    """Return the folder with plc.toml at or above ``start``.

    Raises:
        PlcTestError: there is none.
    """
    for folder in (start, *start.parents):
        if project_file(folder) is not None:
            return folder
    raise PlcTestError(
        f"no {FILE_NAME} in {start} or above it; name the project with "
        '@pytest.mark.plc(project="path/of/the/project") or a program class with '
        "@pytest.mark.plc(program=MyProgram)"
    )


def project_target(
    folder: Path, configuration: str = "", *, keep_going: bool = False
) -> Application:
    """Load a project.

    Args:
        folder: of it.
        configuration: of an Automation Studio project, "" for the one that runs by default.
        keep_going: programs that cannot run are left out, which the logbook tells.

    Raises:
        ConfigurationError: it does not load; file and field are named.
    """
    given = {"as": {"config": configuration}} if configuration else {}
    project = read_project(folder, given)
    return load(runnable(project) if keep_going else project, errors_fd=terminal.errors_fd)


def program_target(
    programs: Sequence[type[Program]], cycle: str = "10ms", task_class: int = 1
) -> Application:
    """Return a controller with one task class that runs program classes.

    Raises:
        PlcTestError: the cycle time is no duration.
    """
    try:
        cycle_ns = parse_duration_ns(cycle)
    except ValueError as err:
        raise PlcTestError(f"cycle: {err}") from None
    setups = [ProgramSetup(program.__name__, PythonCode(program)) for program in programs]
    classes = [TaskClassSetup(task_class, cycle_ns, setups, tolerance_ns=cycle_ns)]
    return Application(programs[0].__name__, Setup(classes))


@contextmanager
def open_plc(
    project: Path | None = None,
    program: type[Program] | Sequence[type[Program]] | None = None,
    *,
    cycle: str = "10ms",
    seed: int = 0,
    config: str = "",
) -> Iterator[Plc]:
    """Open a controller on the virtual clock without the fixture, booted; EXITs run at the end.

    Args:
        project: folder with plc.toml.
        program: a program class, or several, instead of a project.
        cycle: cycle time of program classes.
        seed: of noise and of the virtual network.
        config: configuration of an Automation Studio project, "" for the one that runs by default.

    Raises:
        PlcTestError: neither or both of project and program are given.
        ConfigurationError: the project does not load.
    """
    if (project is None) == (program is None):
        raise PlcTestError("give either a project or a program")
    if project is not None:
        target = project_target(project, config)
    else:
        given = program if isinstance(program, list | tuple) else [program]
        target = program_target([p for p in given if isinstance(p, type)], cycle)
    plc = Plc(target, seed=seed)
    try:
        plc.boot()
        yield plc
    finally:
        plc.close()
        target.unload()
