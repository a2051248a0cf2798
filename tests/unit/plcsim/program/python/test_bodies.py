"""Bodies of libraries in Python: blocks and functions, and what can be wrong with them."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.program.layout import folder_layout
from plcsim.program.loader import ProgramLoader
from plcsim.program.python.bodies import PythonBodies
from plcsim.program.site import Site

MAIN = "from plcsim import Program\nclass Main(Program): ...\n"


@pytest.fixture
def bodies(project, ramp):
    """``bodies(files)``: what executes the library of the project, by name."""

    def bodies(files=None):
        loader = ProgramLoader(folder_layout(project(ramp | (files or {}))))
        (library,) = loader.declarations.own_libraries
        return PythonBodies().bodies(library)

    return bodies


def test_the_classes_and_functions_of_all_modules_are_found(bodies):
    more = """
        from . import interface
        from .ramp import Ramp  # it is the body of one block, however often it is named

        class Helper: ...
        def help(): ...
        LIMIT = 3
    """
    found = bodies({"ramps/more.py": more, "ramps/settings.py": "1 // 0\n"})
    assert sorted(found) == ["Ramp", "twice"]
    assert {each.language for each in found.values()} == {"Python"}


def test_a_block_runs_on_the_data_block_at_an_address(run, value, ramp):
    declared = {"main/Variables.var": "VAR ramp : Ramp := (Enable := TRUE); END_VAR"}
    controller = run(ramp | declared | {"main/main.py": MAIN}, cycles=1)
    catalogue = Site.of(controller.context).catalogue
    library, body = catalogue.find_block("Ramp")
    run_block = body.bind(controller.context)
    address = controller.tags.find("main.ramp").address
    run_block(address)
    run_block(address)
    assert value(controller, "main.ramp.Out") == 6
    assert library.name == "ramps"


def test_a_function_gets_the_context_first(bodies):
    seen = []
    body = """
        from plcsim.library.executable import function

        @function("twice")
        def double(context, x):
            context.append(x)
            return 2 * x
    """
    twice = bodies({"ramps/ramp.py": body})["twice"].bind(seen)
    assert twice(21) == 42
    assert seen == [21]


@pytest.mark.parametrize(
    ("body", "error"),
    [
        ("x = (\n", "ramps/more.py:1: SyntaxError: '(' was never closed"),
        ("import nonsense_\n", "ramps/more.py:1: ModuleNotFoundError: No module named 'nonsense_'"),
        (
            "from . import interface\nclass X(interface.Rmp): ...\n",
            "ramps/more.py:2: AttributeError: ramps declares no Rmp; did you mean Ramp?",
        ),
        (
            "from plcsim.library.executable import function\n@function('twce')\ndef f(c, x): ...\n",
            "ramps/more.py: ramps declares no FUNCTION twce; did you mean twice?",
        ),
        (
            "from . import interface as i\nclass Ramp(i.Ramp):\n    def execute(self): self.Ot = 1",
            "ramps/more.py:3: Ramp has no Ot; did you mean Out?",
        ),
    ],
)
def test_a_wrong_body_is_named_with_file_and_line(bodies, body, error):
    with pytest.raises(ConfigurationError) as raised:
        bodies({"ramps/more.py": body})
    assert str(raised.value).partition("/cell/")[2] == error


def test_what_is_wrong_in_several_modules_is_told_in_one_go(bodies):
    with pytest.raises(ConfigurationError) as raised:
        bodies({"ramps/a.py": "x = (\n", "ramps/b.py": "y = )\n"})
    assert len(raised.value.findings) == 2
