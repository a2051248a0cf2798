"""Which variable refused a value is told, and of which type it is."""

import linecache
import textwrap

import pytest

from plcsim.program.fault import fault_of
from st_types import ARRAY, BOOL, REAL, TIME, UINT, Struct, var


class Point(Struct):
    x = var(REAL)


class Cell(Struct):
    __slots__ = ("free",)
    n = var(UINT)
    t = var(TIME)
    points = var(ARRAY(Point, (1, 2)))
    bits = var(ARRAY(BOOL, (0, 3)))


def reason(line, **names):
    """Return what is told of a line that raises."""
    source = f"def run(self, i=1, **names):\n    {line}\n"
    name = "/programs/main.py"
    linecache.cache[name] = (len(source), None, source.splitlines(keepends=True), name)
    found = {}
    exec(compile(source, name, "exec"), found)
    with pytest.raises(Exception) as raised:  # noqa: PT011  # whatever it is
        found["run"](Cell(), **names)
    return fault_of(raised.value).reason


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("self.n = str(i)", "self.n is UINT and cannot be a str"),
        ("x = 'ä'; self.n = x", "self.n is UINT and cannot be a str"),
        ("self.n = i / 2", "self.n is UINT and cannot be a float"),
        ("self.n, self.t = 1, names", "self.t is TIME and cannot be a dict"),
        ("self.points[i].x = str(i)", "self.points[i].x is REAL and cannot be a str"),
        ("point = self.points[1]; point.x = b''", "point.x is REAL and cannot be a bytes"),
        ("self.t += None or 0.5", "self.t is TIME and cannot be a float"),
    ],
)
def test_a_refused_store_is_told_in_words_of_the_declaration(line, told):
    assert reason(line) == told


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("self.n = 1 + str(i)", "TypeError: unsupported operand type(s) for +: 'int' and 'str'"),
        ("i.x = 5", "AttributeError: 'int' object has no attribute 'x'"),
        ("i[0] = 5", "TypeError: 'int' object does not support item assignment"),
        ("names['a'][i] = 'x'", "KeyError: 'a'"),
        ("bytearray(4)[0] = 'x'", "TypeError: 'str' object cannot be interpreted as an integer"),
        ("self.bits[0] = 'x'", "'x' is not a BOOL."),
        ("self.points[1] = 5", "TypeError: Point cannot take 5."),
    ],
)
def test_anything_else_is_told_as_it_is(line, told):
    assert reason(line) == told


def test_a_file_that_is_another_one_by_now(tmp_path):
    file = tmp_path / "main.py"
    file.write_text(
        textwrap.dedent("""
        def run(self):
            self.n = "x"
    """)
    )
    found = {}
    exec(compile(file.read_text(), str(file), "exec"), found)
    file.write_text("\n\n??????????????????\n")
    linecache.checkcache()
    with pytest.raises(TypeError) as raised:
        found["run"](Cell())
    assert "TypeError: 'str' object cannot be interpreted" in fault_of(raised.value).reason
