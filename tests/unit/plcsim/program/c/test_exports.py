"""Every function that a library names as a body is in the C library, with its signature."""

from importlib import import_module

import pytest

from plcsim.library.installed import installed
from plcsim.program.compiled_body import CompiledBody
from plcsim.program.loader import installed_catalogue
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller

LIBRARIES = [each for each in installed().values() if (each.folder / "exports.py").is_file()]


class Idle(Program):
    def cyclic(self):
        pass


@pytest.fixture(scope="module")
def context():
    tasks = TaskClassSetup(1, 10_000_000, [ProgramSetup("idle", PythonCode(Idle))])
    return make_controller(Setup([tasks])).context


@pytest.mark.parametrize("library", LIBRARIES, ids=str)
def test_exports_are_there(library, context):
    bodies = installed_catalogue().bodies(library)
    found = {name: body for name, body in bodies.items() if isinstance(body, CompiledBody)}
    exports = import_module(f"{library.package}.exports").EXPORTS
    declared = {each.name for each in (*library.scope.functions, *library.scope.function_blocks)}
    assert found.keys() == declared & exports.keys()
    assert found.keys() == declared or found.keys() < bodies.keys()  # the others are in Python
    for body in found.values():
        assert callable(body.bind(context))
        assert body.extern(context) is not None
        assert body.language == "ANSI C"
