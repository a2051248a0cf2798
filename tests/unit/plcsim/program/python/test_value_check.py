"""Values that a variable cannot take, found before anything runs."""

import textwrap

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.program.layout import folder_layout
from plcsim.program.loader import ProgramLoader

HEAD = """\
from enum import IntEnum

from plcsim import Program, var_external
from plcsim.library.standard import TON
from st_types import ARRAY, BOOL, ENUM, REAL, STRING, TIME, UINT, WSTRING, Struct, var


class Mode(IntEnum):
    OFF = 0


class Point(Struct):
    x = var(REAL)


class Main(Program):
    red = var(BOOL)
    n = var(UINT)
    r = var(REAL)
    s = var(STRING(10))
    w = var(WSTRING(10))
    t = var(TIME)
    mode = var(ENUM(Mode))
    a = var(ARRAY(BOOL, (0, 9)))
    points = var(ARRAY(Point, (1, 2)))
    timer = var(TON)

    def cyclic(self):
"""

GLOBAL = "VAR gText : STRING[9]; END_VAR VAR CONSTANT MOST : UINT := 5; END_VAR"

LINE = len(HEAD.splitlines()) + 1

TIME_HINT = "; a TIME is a number of milliseconds, which T('3s') gives"
FRACTION_HINT = "; // divides without a fraction, int(...) cuts one off"


@pytest.fixture
def load(project):
    """``load(*lines)``: load a program with these lines in its cyclic."""

    def load(*lines):
        files = {"main/main.py": HEAD + textwrap.indent("\n".join(lines), " " * 8)}
        files["Global.var"] = (
            "VAR gText : STRING[9]; END_VAR VAR CONSTANT MOST : UINT := 5; END_VAR"
        )
        return ProgramLoader(folder_layout(project(files), ["main"])).load()["main"].program

    return load


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("self.red = 'ja'", "self.red is BOOL and cannot be 'ja'"),
        ("self.red = None", "self.red is BOOL and cannot be None"),
        ("self.red = 5", "self.red is BOOL and cannot be 5"),
        ("self.red = self.s", "self.red is BOOL and cannot be self.s"),
        ("self.a[3] = 'x'", "self.a[3] is BOOL and cannot be 'x'"),
        ("self.n = 'x'", "self.n is UINT and cannot be 'x'"),
        ("self.n = f'{1}'", "self.n is UINT and cannot be f'{1}'"),
        ("self.n = self.gText", "self.n is UINT and cannot be self.gText"),
        ("self.n: int = 'x'", "self.n is UINT and cannot be 'x'"),
        ("self.red, self.n = True, [1]", "self.n is UINT and cannot be [1]"),
        ("self.mode = 'OFF'", "self.mode is Mode and cannot be 'OFF'"),
        ("self.r = str(1)", "self.r is REAL and cannot be str(1)"),
        ("self.s = 5", "self.s is STRING[10] and cannot be 5"),
        ("self.w = b'x'", "self.w is WSTRING[10] and cannot be b'x'"),
        ("self.gText = self.n", "self.gText is STRING[9] and cannot be self.n"),
        ("self.s = self.MOST", "self.s is STRING[10] and cannot be self.MOST"),
        ("self.a = True", "self.a is ARRAY[0..9] OF BOOL and cannot be True"),
        ("self.points[1] = 'x'", "self.points[1] is Point and cannot be 'x'"),
        ("self.points[1].x = 'x'", "self.points[1].x is REAL and cannot be 'x'"),
        ("self.timer.IN = 'x'", "self.timer.IN is BOOL and cannot be 'x'"),
        ("self.timer(IN='x')", "self.timer.IN is BOOL and cannot be 'x'"),
        ("self.timer(PT='3s')", f"self.timer.PT is TIME and cannot be '3s'{TIME_HINT}"),
        ("self.n = 1.5", f"self.n is UINT and cannot be 1.5{FRACTION_HINT}"),
        ("self.n = self.n / 2", f"self.n is UINT and cannot be self.n / 2{FRACTION_HINT}"),
        ("self.n /= 2", f"self.n is UINT and cannot be self.n / 2{FRACTION_HINT}"),
        ("self.n += self.r", f"self.n is UINT and cannot be self.n + self.r{FRACTION_HINT}"),
        ("self.n = -self.r", f"self.n is UINT and cannot be -self.r{FRACTION_HINT}"),
    ],
)
def test_a_value_of_the_wrong_kind_is_told_with_its_line(load, line, error):
    with pytest.raises(ConfigurationError) as raised:
        load("pass", line)
    assert str(raised.value).endswith(f"main.py:{LINE + 1}: {error}")


def test_what_fits_or_is_not_known_is_loaded(load):
    load(
        "x = object()",
        "self.red = 1 if self.n else 0",
        "self.red = self.n == 5 and not self.red",
        "self.red = self.n & 4",
        "self.red |= self.timer.Q",
        "self.n = True",
        "self.n = 70000",
        "self.n = int(self.r) + len(self.s) + self.timer.ET",
        "self.n = x.anything()",
        "self.n = 2 ** self.n",
        "self.r = 5",
        "self.r = self.n / 2",
        "self.mode = Mode.OFF",
        "self.mode = 0",
        "self.s = 'a' + self.s",
        "self.s = '%d' % self.n",
        "self.s = b'bytes'",
        "self.w = 'a'",
        "self.a = [True] * 10",
        "self.a = [True]",
        "self.points[1] = {'x': 1.0}",
        "self.points[1] = self.points[2]",
        "self.points = [self.points[2]]",
        "self.timer(IN=self.red, PT=self.t)",
        "int = str",
        "self.gText = 'a'",
        "self.n, self.red = self.n, self.red",
    )


def test_a_name_of_the_module_hides_that_of_python(project):
    text = HEAD.replace("class Mode", "def len(x): return 'x'\n\nclass Mode")
    folder = project({"main/main.py": text + "        self.s = len(self.a)\n"})
    assert ProgramLoader(folder_layout(folder, ["main"])).load()["main"]
