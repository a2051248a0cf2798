"""Units that would never run, found before anything runs; and that all findings are told."""

import textwrap

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.program.layout import folder_layout
from plcsim.program.loader import ProgramLoader

HEAD = """\
import functools

from plcsim import Program
from plcsim.library.standard import TON
from st_types import UINT, var


def traced(method):
    @functools.wraps(method)
    def traced(self):
        return method(self)

    return traced


class Main(Program):
    __slots__ = ("node",)
    count = var(UINT)
    timer = var(TON)
"""

FIRST = len(HEAD.splitlines()) + 1
"""Line of the first method."""


@pytest.fixture
def load(project):
    """``load(body, head, **files)``: the class Main with this body, loaded from its folder."""

    def load(body, head=HEAD, **files):
        text = head + textwrap.indent(textwrap.dedent(body), "    ")
        others = {f"main/{stem}.py": content for stem, content in files.items()}
        folder = project({"main/main.py": text} | others)
        return ProgramLoader(folder_layout(folder, ["main"])).load()["main"].program

    return load


def wrong(load, body, **files):
    """Return the error without the path of the program before it."""
    with pytest.raises(ConfigurationError) as raised:
        load(body, **files)
    return str(raised.value).partition("/cell/main/")[2]


@pytest.mark.parametrize(
    ("unit", "error"),
    [
        ("def Cyclic(self): ...", "the unit Cyclic is spelt cyclic"),
        ("def INIT(self): ...", "the unit INIT is spelt init"),
        ("def cyclic(): ...", "cyclic takes self and nothing else"),
        ("def exit(self, code): ...", "exit takes self and nothing else"),
        ("async def cyclic(self): ...", "cyclic neither awaits nor yields"),
        ("def cyclic(self): yield", "cyclic neither awaits nor yields"),
    ],
)
def test_a_unit_that_would_not_run_is_an_error(load, unit, error):
    assert wrong(load, unit).startswith(f"main.py:{FIRST}: {error}")


@pytest.mark.parametrize(
    ("methods", "error"),
    [
        ("def cycle(self): ...", "cycle is no unit, and Main has none of init, cyclic, exit; did"),
        ("def x(self): ...\ndef main(self): ...", "x is no unit, and Main has none of init, cyc"),
    ],
)
def test_a_program_that_would_run_none_of_its_methods_is_an_error(load, methods, error):
    assert wrong(load, methods).startswith(f"main.py:{FIRST}: {error}")


def test_a_program_may_have_variables_only(load):
    assert load("").__name__ == "Main"


def test_everything_is_told_in_one_go(load):
    with pytest.raises(ConfigurationError) as raised:
        load("def Init(self): ...\ndef cyclic(self, x):\n    self.cuont += 1\n    self.timr.Q\n")
    assert [text.rpartition("main.py:")[2] for text in raised.value.findings] == [
        f"{FIRST}: the unit Init is spelt init",
        f"{FIRST + 1}: cyclic takes self and nothing else",
        f"{FIRST + 2}: Main has no cuont; did you mean count?",
        f"{FIRST + 3}: Main has no timr; did you mean timer?",
    ]


def test_a_unit_in_a_file_of_its_own_is_checked_too(load):
    error = wrong(load, "", exit="def exit():\n    pass\n")
    assert error == "exit.py:1: exit takes self and nothing else"
