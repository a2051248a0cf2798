"""The cell of cell.py, loaded once, and a project of it on disk."""

import importlib.util
from pathlib import Path

import pytest

_spec = importlib.util.spec_from_file_location("cell", Path(__file__).with_name("cell.py"))
cell = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(cell)

from plcsim.program.python.language import PythonCode  # noqa: E402  # after the cell
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup  # noqa: E402  # after the cell
from plcsim.project.assembly import Application  # noqa: E402  # after the cell
from plcsim.testing.plc import Plc  # noqa: E402  # after the cell

MS = 1_000_000


def make_setup(*cycles_ms, programs=None, **options):
    """Return a setup with task classes 1, 2, ... of these cycle times."""
    program = cell.Cell
    return Setup(
        [
            TaskClassSetup(
                number,
                cycle_ms * MS,
                [ProgramSetup(f"Cell{number}" if number > 1 else "Cell", PythonCode(program))],
                tolerance_ns=cycle_ms * MS,
                **options,
            )
            for number, cycle_ms in enumerate(cycles_ms, 1)
        ],
        memory_size=64 * 1024,
    )


@pytest.fixture
def cell_plc():
    """A booted controller with Cell in a 10 ms task class."""
    plc = Plc(Application("cell", make_setup(10)))
    plc.boot()
    yield plc
    plc.close()


@pytest.fixture
def new_plc():
    """``new_plc(10, 50)``: a booted controller with a cell in each task class."""
    made = []

    def new(*cycles_ms, seed=0, task_class=None, realtime=False, **options):
        plc = Plc(
            Application("cell", make_setup(*cycles_ms, **options)),
            seed=seed,
            task_class=task_class,
            realtime=realtime,
        )
        made.append(plc)
        plc.boot()
        return plc

    yield new
    for plc in made:
        plc.close()


@pytest.fixture
def project(tmp_path):
    """A project on disk with the cell as its only program."""
    folder = tmp_path / "press"
    (folder / "cell").mkdir(parents=True)
    (folder / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["cell"]\n')
    (folder / "cell" / "main.py").write_text(Path(__file__).with_name("cell.py").read_text())
    return folder
