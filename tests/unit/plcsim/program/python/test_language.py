"""Programs from folders: one file or three, shared modules, and everything that can be wrong."""

import pytest

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.core.context import Context
from plcsim.core.errors import ConfigurationError, CycleTimeViolation
from plcsim.core.memory import PAGE, Memory
from plcsim.core.task import Unit
from plcsim.program.layout import folder_layout
from plcsim.program.loader import ProgramLoader, installed_catalogue
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.program.site import Site
from st_types import UINT, var

CLASS = """
    from plcsim import Program
    from st_types import UINT, var

    class Main(Program):
        inits = var(UINT)
        cycles = var(UINT)
        exits = var(UINT)
"""

UNITS = {
    f"main/{unit}.py": f"def {unit}(self) -> None:\n    self.{unit}s += 1\n"
    for unit in ("init", "exit")
} | {"main/cyclic.py": "def cyclic(self) -> None:\n    self.cycles += 1\n"}

DECLARED = "from plcsim import Program\nfrom st_types import UINT, var\n\nclass Main(Program):\n"


@pytest.fixture
def load(project):
    """``load(files)``: the class of program ``main``, or of another source."""

    def load(files, source="main"):
        return ProgramLoader(folder_layout(project(files), [source])).load()[source].program

    return load


def counts_of(program, cycles=3):
    """Run a program and return its counters."""
    setup = Setup([TaskClassSetup(1, 10_000_000, [ProgramSetup("main", PythonCode(program))])])
    controller = make_controller(setup, network=None, clock=VirtualClock())
    controller.boot()
    controller.run(cycles=cycles)
    controller.shutdown()
    variables = controller.tasks[0].cyclic.__self__
    return variables.inits, variables.cycles, variables.exits


def test_one_file_with_class_and_units(load):
    units = """
        def init(self) -> None:
            self.inits += 1

        def cyclic(self) -> None:
            self.cycles += 1

        def exit(self) -> None:
            self.exits += 1
"""
    assert counts_of(load({"main/main.py": CLASS + units})) == (1, 3, 1)


@pytest.mark.parametrize("stem", ["main", "variables"])
def test_three_files_with_a_unit_each(load, stem):
    assert counts_of(load({f"main/{stem}.py": CLASS} | UNITS)) == (1, 3, 1)


def test_units_may_be_left_out(load):
    files = {"main/variables.py": CLASS, "main/cyclic.py": UNITS["main/cyclic.py"]}
    assert counts_of(load(files)) == (0, 3, 0)


def test_all_units_may_be_left_out(load):
    assert counts_of(load({"main/main.py": CLASS})) == (0, 0, 0)


def test_variables_in_one_file_and_the_program_in_another(load):
    main = """
        from . import variables

        class Cell(variables.Main):
            def cyclic(self) -> None:
                self.cycles += 2
    """
    program = load({"main/variables.py": CLASS, "main/main.py": main})
    assert program.__name__ == "Cell"
    assert counts_of(program) == (0, 6, 0)


def test_programs_share_a_module(load):
    main = CLASS + "\n    from ..shared import STEP\n\n    Main.cyclic = STEP\n"
    shared = "def STEP(self):\n    self.cycles += 10\n"
    assert counts_of(load({"main/main.py": main, "shared.py": shared})) == (0, 30, 0)


def test_a_program_may_lie_deeper(load):
    files = {"lines/left/main.py": CLASS + "    from ...shared import X\n", "shared.py": "X = 1\n"}
    assert load(files, "lines/left").__name__ == "Main"


def test_helpers_and_imported_programs_are_no_programs_of_the_folder(load):
    main = (
        CLASS
        + """
    from ..other.main import Other

    class Base(Program):
        pass

    class Final(Base):
        pass

    del Main
"""
    )
    other = "from plcsim import Program\nclass Other(Program):\n    pass\n"
    assert load({"main/main.py": main, "other/main.py": other}).__name__ == "Final"


# what can be wrong


def wrong(load, files, source="main"):
    """Return the error without the path of the project before it."""
    with pytest.raises(ConfigurationError) as raised:
        load(files, source)
    return str(raised.value).partition("/cell/")[2]


@pytest.mark.parametrize(
    ("source", "error"),
    [
        ("x = (\n", "main/main.py:1: SyntaxError: '(' was never closed"),
        ("\n\nimport nonsense_\n", "main/main.py:3: ModuleNotFoundError: No module named"),
        (
            "\nfrom ..nothing import X\n",
            "main/main.py:2: ModuleNotFoundError: No module named 'cell.nothing'",
        ),
        ("def f():\n    1 // 0\nf()\n", "main/main.py:2: division by zero"),
        ("raise SystemExit(0)\n", "main/main.py:1: SystemExit: 0"),
        ("\nimport sys\nsys.exit()\n", "main/main.py:3: SystemExit"),
        ("x = 1\n", "main: one subclass of plcsim.Program is expected, found none"),
        (
            "from plcsim import Program\nclass B(Program): ...\nclass A(Program): ...\n",
            "main: one subclass of plcsim.Program is expected, found A, B",
        ),
        (DECLARED + "    x = var('UINT')\n", "main/main.py:5: 'UINT' is not a data type."),
        (DECLARED + "    count = var(UINT, -1)\n", "main/main.py:4: Main.count: -1 is outside"),
        (DECLARED + "    cyclic = var(UINT)\n", "main/main.py:4: Main.cyclic: a method of"),
    ],
)
def test_a_wrong_program_is_named_with_file_and_line(load, source, error):
    assert wrong(load, {"main/main.py": source}).startswith(error)


def test_a_wrong_shared_module_is_named_itself(load):
    files = {"main/main.py": "from ..shared import X\n", "shared.py": "X = 1\nY = X.y\n"}
    assert wrong(load, files).startswith("shared.py:2: AttributeError")
    files = {"main/main.py": "from ..shared import X\n", "shared.py": "X = 1\n\nX = = 2\n"}
    assert wrong(load, files) == "shared.py:3: SyntaxError: invalid syntax"


@pytest.mark.parametrize(
    ("unit", "text", "error"),
    [
        ("init", "x = 1\n", "main/init.py: has no function init"),
        ("exit", "exit = 5\n", "main/exit.py: has no function exit"),
        ("cyclic", "def cyclic(self:\n", "main/cyclic.py:1: SyntaxError"),
        ("cyclic", "\nimport nonsense_\n", "main/cyclic.py:2: ModuleNotFoundError"),
    ],
)
def test_a_wrong_unit_file_is_named(load, unit, text, error):
    assert wrong(load, {"main/variables.py": CLASS, f"main/{unit}.py": text}).startswith(error)


@pytest.mark.parametrize("data", [b"x = '\xe4'\n", b"x = 1\0\n"])
def test_a_file_that_is_no_text_is_named(project, data):
    folder = project({"main/main.py": ""})
    (folder / "main" / "main.py").write_bytes(data)
    with pytest.raises(ConfigurationError) as raised:
        ProgramLoader(folder_layout(folder, ["main"])).load()
    assert str(folder / "main") in str(raised.value)


def test_ctrl_c_while_loading_is_not_taken_for_a_wrong_program(project):
    folder = project({"main/main.py": "raise KeyboardInterrupt\n"})
    with pytest.raises(KeyboardInterrupt):
        ProgramLoader(folder_layout(folder, ["main"])).load()


def test_a_task_runs_the_units_of_its_program_on_its_own_variables():
    class Counter(Program):
        count = var(UINT, 3)

        def cyclic(self) -> None:
            self.count += 1

    memory = Memory(4 * PAGE)
    site = Site(Context(memory, network=None), installed_catalogue())
    first, second = (PythonCode(Counter).place(name, site).task() for name in ("a", "b"))
    assert first.units.keys() == set(Unit)
    first.cyclic()
    first.units[Unit.INIT]()
    first.units[Unit.EXIT]()
    counts = [memory.access(Counter, task.variables.address).count for task in (first, second)]
    assert counts == [4, 3]
    assert first.variables.path == "a"
    assert first.cyclic.__self__.context is site.context


def test_a_task_is_ended_by_an_exception_that_programs_do_not_catch():
    context = Context(Memory(4 * PAGE), network=None)
    task = PythonCode(Program).place("p", Site(context, installed_catalogue())).task()
    with pytest.raises(CycleTimeViolation, match="it did not return"):
        task.interrupt("it did not return")
