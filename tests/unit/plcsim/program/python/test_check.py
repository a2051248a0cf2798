"""Units that would never run and names that are not there, found before anything runs."""

import textwrap

import pytest

from plcsim.core.errors import ConfigurationError
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
        return ProgramLoader(folder, ["main"]).load()["main"].program

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


def test_a_unit_in_a_file_of_its_own_is_checked_too(load):
    error = wrong(load, "", exit="def exit():\n    pass\n")
    assert error == "exit.py:1: exit takes self and nothing else"


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("self.cuont = 1", "Main has no cuont; did you mean count?"),
        ("self.cuont += 1", "Main has no cuont; did you mean count?"),
        ("x = self.cuont", "Main has no cuont; did you mean count?"),
        ("self.count, self.xyz = 1, 2", "Main has no xyz"),
        ("if self.tmer.Q: pass", "Main has no tmer; did you mean timer?"),
        ("self.nod.close()", "Main has no nod; did you mean node?"),
        ("print(f'{self.cuont}')", "Main has no cuont; did you mean count?"),
    ],
)
def test_a_misspelt_name_is_named_with_its_line(load, line, error):
    for method in ("def cyclic(me):", "@traced\ndef cyclic(me):", "def helper(me, x):"):
        text = f"{method}\n    pass\n    {line}\n".replace("self", "me")
        place = f"main.py:{FIRST + text.count(chr(10)) - 1}"
        assert wrong(load, text) == f"{place}: {error}"


def test_a_misspelt_name_in_a_unit_of_its_own_file(load):
    error = wrong(load, "", cyclic="def cyclic(self):\n    self.cuont += 1\n")
    assert error == "cyclic.py:2: Main has no cuont; did you mean count?"


@pytest.mark.parametrize(
    "body",
    [
        "Exit = var(UINT)",
        "def init(self): self.Init()\ndef Init(self): ...",
        "def init(self): self.node = self.context.release_ns",
        "def cyclic(self): self.count = self.timer.ET + self.helper()\ndef helper(self): return 1",
        "def cyclic(self): return lambda self: self.anything",
        "def cyclic(self):\n    class Other:\n        def f(self): self.x = 1",
        "def cyclic(self): self.__class__.__name__",
        "@staticmethod\ndef helper(other): other.x = 1",
        "@classmethod\ndef helper(cls): cls.x = 1",
        "def helper(*all): all[0].x = 1",
        "def __getattr__(self, name): return 1\ndef cyclic(self): self.anything",
        "cyclic = lambda self: self.anything",
        "exec('def cyclic(self): self.anything')",
    ],
)
def test_what_is_right_or_cannot_be_told_is_loaded(load, body):
    assert load(body).__name__ == "Main"


def test_a_program_with_attributes_of_python_may_have_any(load):
    head = HEAD.replace("class Main(Program)", "class Free: ...\n\nclass Main(Free, Program)")
    assert load("def cyclic(self): self.anything = 1", head).__name__ == "Main"
