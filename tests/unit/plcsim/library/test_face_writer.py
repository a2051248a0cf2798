"""``interface.py``: fresh in this package, and what is written for any library."""

import importlib.util
import sys

import pytest

from plcsim.library.face_writer import interface_source
from plcsim.library.installed import installed
from st_types.types.views import type_of

OWN = [each for each in installed().values() if each.package.startswith(("plcsim.", "crosnode."))]


@pytest.mark.parametrize("library", OWN, ids=str)
def test_the_faces_of_the_controller_libraries_are_fresh(library):
    file = library.folder / "interface.py"
    assert file.read_text("utf-8") == interface_source(library), (
        f"plcsim types library {library.folder} writes it anew"
    )


def test_a_face_tells_types_and_comments(library):
    text = interface_source(library)
    assert text.startswith('"""Library ramps as Python sees it.\n')
    for part in (
        'STEP: Final = 3\n"""Of a ramp."""\n',
        "NAME: Final = 'ramp'\n",
        'class Axis(Struct):\n    """One axis."""\n\n    _plc_type = _DECLARED["Axis"]\n\n',
        '    speed: float\n    """M/s."""\n\n    pName: int\n',
        "class Mode(IntEnum):\n",
        "    RUNNING = 5\n\n\n_DECLARED.enumeration(Mode)\n",
        'class Ramp(FunctionBlock):\n    """Goes up."""\n',
        '    Enable: bool\n    """Run."""\n',
        '    Out: Array[int]\n    """Where it is."""\n',
        "    mode: Mode\n",
        "    axis: Axis\n",
        "    timer: TON\n",
        "    name: str\n",
        "    level: float\n",
        "from plcsim.library.standard import TON\n",
        '__all__ = ["NAME", "STEP", "Axis", "Mode"]\n',
    ):
        assert part in text


def test_what_is_written_is_the_face_at_run_time(library, monkeypatch):
    file = library.folder / "interface.py"
    file.write_text(interface_source(library))
    spec = importlib.util.spec_from_file_location("ramp_lib.interface", file)
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "ramp_lib.interface", module)
    spec.loader.exec_module(module)
    assert type_of(module.Ramp) is library.scope.find_type("Ramp")
    view = module.Ramp()
    view.mode = module.Mode.RUNNING
    assert view.mode is module.Mode.RUNNING


def test_names_that_python_has_already(files, library):
    text = "FUNCTION_BLOCK B VAR int : BOOL; bool : INT; from : BOOL; END_VAR END_FUNCTION_BLOCK"
    files({"ramps.fun": text})
    source = interface_source(library)
    assert "    int: builtins.bool\n" in source
    assert "    bool: builtins.int\n" in source
    assert "import builtins\n" in source
    assert "from:" not in source
    compile(source, "interface.py", "exec")
