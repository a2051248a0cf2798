"""Names that are not there, and names that take no value, found before anything runs."""

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
    unit = "def init(self): ...\n"
    for method in ("def cyclic(me):", "@traced\ndef cyclic(me):", unit + "def helper(me, x):"):
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
        "def helper(*all): all[0].x = 1\ndef exit(self): ...",
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


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("if self.timer.q: pass", "TON has no q; did you mean Q?"),
        ("self.timer.pt = 5", "TON has no pt; did you mean PT?"),
        ("self.timer(PTT=5)", "TON has no PTT; did you mean PT?"),
        ("self.timer(True, 5)", "TON takes its inputs by name, IN=..."),
    ],
)
def test_members_and_inputs_of_blocks_are_looked_at(load, line, error):
    assert wrong(load, f"def cyclic(self):\n    {line}") == f"main.py:{FIRST + 1}: {error}"


@pytest.mark.parametrize(
    ("attribute", "line", "error"),
    [
        ("red = False", "self.red = True", "red is no variable; declare it: red = var(BOOL)"),
        ("n = 1", "self.n += 1", "n is no variable; declare it: n = var(DINT)"),
        ("x = 1.5", "self.n, self.x = 1, 2", "Main has no n"),
        ("text = ''", "self.text = 'a'", "text is no variable; declare it: text = var(STRING(80))"),
        ("both = []", "self.both = []", "both is no variable; declare it: both = var(...)"),
        ("", "self.init = 5", "init is a method and takes no value"),
    ],
)
def test_a_forgotten_var_is_found_where_it_is_given_a_value(load, attribute, line, error):
    found = wrong(load, f"{attribute}\ndef cyclic(self):\n    {line}").split("\n")[0]
    assert found == f"main.py:{FIRST + 2}: {error}"


def test_a_constant_of_the_class_and_a_property_are_right(load):
    body = """
        LIMIT = 5

        @property
        def both(self): return self.count

        @both.setter
        def both(self, value): self.count = value

        def cyclic(self):
            self.both = self.LIMIT
            inputs = {"IN": True}
            self.timer(**inputs)
    """
    assert load(body).__name__ == "Main"
