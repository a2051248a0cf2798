"""Packages of projects and libraries: what can be imported from where."""

import sys
import textwrap

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.program.layout import folder_layout
from plcsim.program.loader import ProgramLoader
from plcsim.program.python.modules import load_module

MAIN = """
    {imports}
    from plcsim import Program

    class Main(Program):
        pass
"""


@pytest.fixture
def loaded(project, ramp):
    """``loaded(imports, **files)``: the module of the program ``main``."""
    loaders = []

    def loaded(imports, files=None, libraries=()):
        text = MAIN.format(imports=imports)
        folder = project(ramp | {"main/main.py": text} | (files or {}))
        loader = ProgramLoader(folder_layout(folder, ["main"], libraries))
        loaders.append(loader)
        loader.load()
        return sys.modules[f"{loader.package}.main.main"]

    yield loaded
    for loader in loaders:
        loader.unload()
        assert not [name for name in sys.modules if name.startswith(loader.package)]


def test_bodies_constants_and_functions_come_from_the_folder_of_a_library(loaded):
    module = loaded("from ..ramps import STEP, Ramp, double")
    assert (module.STEP, module.double(None, 4)) == (3, 8)
    assert module.Ramp.execute.__name__ == "execute"


def test_a_library_outside_the_project_is_imported_alike(loaded, tmp_path, ramp):
    outside = tmp_path / "elsewhere"
    outside.mkdir()
    for name, text in ramp.items():
        file = outside / name.partition("/")[2].replace("ramp", "other")
        file.write_text(textwrap.dedent(text).replace("Ramp", "Other"))
    module = loaded("from ..elsewhere import Other; from ..ramps import Ramp", libraries=[outside])
    assert module.Other.__name__ == "Other"
    assert module.Ramp is not module.Other


def test_what_is_wrong_in_a_library_is_told_once(loaded):
    with pytest.raises(ConfigurationError) as raised:
        loaded("from ..ramps import Ramp", {"ramps/ramp.py": "1 // 0\n"})
    (finding,) = raised.value.findings
    assert finding.endswith("/cell/ramps/ramp.py:1: division by zero")


def test_a_module_of_a_library_can_be_imported_by_itself(loaded):
    module = loaded("from ..ramps.ramp import Ramp")
    assert module.Ramp.__module__.endswith(".ramps.ramp")


def test_an_interface_file_is_used_where_there_is_one(loaded):
    text = """
        from plcsim import FunctionBlock
        from plcsim.library.face import declared_beside

        class Ramp(FunctionBlock):
            _plc_type = declared_beside(__name__)["Ramp"]
            WRITTEN = True
    """
    assert loaded("from ..ramps import Ramp", {"ramps/interface.py": text}).Ramp.WRITTEN


def test_types_and_constants_of_project_and_program(loaded):
    files = {
        "Global.typ": "TYPE Axis : STRUCT speed : REAL := 2.5; END_STRUCT; END_TYPE",
        "Global.var": "VAR CONSTANT LIMIT : UDINT := 7; END_VAR",
        "main/Local.typ": "TYPE Mode : (OFF, ON); END_TYPE",
    }
    module = loaded("from .. import LIMIT, Axis; from . import Mode", files)
    assert (module.LIMIT, module.Axis().speed, module.Mode.ON) == (7, 2.5, 1)


def test_a_name_that_is_nowhere_is_named(loaded):
    text = r"main/main\.py:2: ImportError: cannot import name 'Rmp' from 'cell\.ramps'"
    with pytest.raises(ConfigurationError, match=text):
        loaded("from ..ramps import Rmp")
    with pytest.raises(ConfigurationError, match="cannot import name 'LIMIT' from 'cell'"):
        loaded("from .. import LIMIT")


def test_a_module_that_cannot_be_imported(tmp_path):
    with pytest.raises(ConfigurationError, match="ModuleNotFoundError: No module named 'no_such_"):
        load_module("no_such_module_anywhere", tmp_path)
