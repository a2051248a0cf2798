import subprocess
import sys
from importlib.util import find_spec

import pytest

from plcsim.machine import api
from plcsim.machine.errors import MachineError


def test_a_new_wasmtime_is_refused_where_none_is_installed(monkeypatch):
    monkeypatch.setattr(api, "find_spec", lambda _name: None)
    with pytest.raises(MachineError, match="pip install wasmtime"):
        api._file()


def test_a_system_without_a_library_is_named(monkeypatch):
    monkeypatch.setattr(api.platform, "machine", lambda: "armv7l")
    with pytest.raises(MachineError, match="no library for linux-armv7l"):
        api._file()


def test_the_python_package_is_not_imported():
    code = (
        "import sys, plcsim.machine; from plcsim.machine.engine import engine_of\n"
        "engine_of(fuel=False); print('wasmtime' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
    assert find_spec("wasmtime")


def test_the_version_is_that_of_the_prototypes():
    assert api.library_version().startswith("50.")


def test_errors_become_one_line_and_are_freed():
    error = api.library().wasmtime_error_new(b"first line\n\nCaused by:\n    second  line\n")
    with pytest.raises(MachineError, match=r"^what: first line: second line$"):
        api.raise_error(error, "what")
    api.raise_error(None, "nothing")


def test_texts_and_vectors_may_be_empty():
    assert api.text_of(None) == ""
    assert api.items_of(api.ByteVec()) == []
