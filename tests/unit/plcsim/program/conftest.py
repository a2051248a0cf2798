"""Projects with declarations and libraries."""

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

PLC = """
    [task_class.1]
    cycle = "10ms"
    programs = ["main"]
"""

RAMP = {
    "ramps/ramps.fun": """
        FUNCTION_BLOCK Ramp
            VAR_INPUT
                Enable : BOOL;
                Step : UDINT := STEP;
            END_VAR
            VAR_OUTPUT
                Out : UDINT;
            END_VAR
        END_FUNCTION_BLOCK
        FUNCTION twice : UDINT
            VAR_INPUT
                x : UDINT;
            END_VAR
        END_FUNCTION
    """,
    "ramps/ramps.var": "VAR CONSTANT STEP : UDINT := 3; END_VAR\n",
    "ramps/ramp.py": """
        from plcsim.library.executable import function

        from . import interface

        class Ramp(interface.Ramp):
            def execute(self):
                if self.Enable:
                    self.Out += self.Step

        @function("twice")
        def double(context, x):
            return 2 * x
    """,
}


@pytest.fixture
def ramp():
    """The files of a library with one block and one function, both in Python."""
    return dict(RAMP)


@pytest.fixture
def run(project):
    """``run(files, cycles=3)``: the controller of a project after some cycles."""
    loaded = []

    def run(files, cycles=3):
        application = load(read_project(project({"plc.toml": PLC} | files)))
        loaded.append(application)
        controller = assemble(application, clock=VirtualClock(), network=None)
        controller.boot()
        controller.run(cycles=cycles)
        return controller

    yield run
    for application in loaded:
        application.unload()


@pytest.fixture
def value():
    """``value(controller, path)``: of a tag."""
    return lambda controller, path: controller.tags.read(controller.tags.find(path))
