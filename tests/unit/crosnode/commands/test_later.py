"""An act is loaded when it is called, and its errors are those of plcsim."""

import argparse
import sys
from pathlib import Path

import pytest

from crosnode.commands.later import act_of
from plcsim.core.errors import PlcError

MODULE = """
from crosnode.errors import UnknownTypeError

def fine(options):
    pass

def found(options):
    return options.code

def wrong(options):
    raise UnknownTypeError("No such type.")
"""


@pytest.fixture
def module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    (tmp_path / "acts_of_this_test.py").write_text(MODULE)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "acts_of_this_test", raising=False)
    return "acts_of_this_test"


def test_loaded_with_its_first_call(module: str) -> None:
    act = act_of(module, "found")
    assert module not in sys.modules
    assert act(argparse.Namespace(code=3)) == 3
    assert act_of(module, "fine")(argparse.Namespace()) == 0


def test_errors_of_crosnode_are_told_as_those_of_plcsim(module: str) -> None:
    with pytest.raises(PlcError, match=r"^No such type\.$"):
        act_of(module, "wrong")(argparse.Namespace())
