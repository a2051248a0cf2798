"""Source line, text and calls of what a program raised."""

import json
import sysconfig
import textwrap

import pytest

import plcsim
from plcsim.core.duration import parse_duration_ns
from plcsim.core.errors import PageFault
from plcsim.program.fault import LONGEST_TEXT, describe, fault_of, location_of
from st_types import REAL, Struct, var
from st_types.errors import ValueRangeError


def raised_by(source, path, **names):
    """Return what ``source``, as the file ``path``, raises."""
    try:
        exec(compile(textwrap.dedent(source), path, "exec"), names)
    except BaseException as error:
        return error
    raise AssertionError("nothing was raised")


FAILS_IN_LINE_3 = """
def cyclic():
    raise ValueError
cyclic()
"""


@pytest.mark.parametrize(
    "path",
    [
        "/home/somebody/my_plc/main/main.py",
        "/usr/src/app/main/main.py",
        sysconfig.get_path("data") + "/my_plc/main.py",
        sysconfig.get_path("stdlib") + "-projects/main.py",
        plcsim.__path__[0] + "_projects/main.py",
        plcsim.__path__[0] + "/_examples/blinky/blinky/main.py",
    ],
)
def test_the_line_of_the_program_is_found_wherever_the_project_lies(path):
    assert location_of(raised_by(FAILS_IN_LINE_3, path)) == f"{path}:3"


def test_the_caller_is_named_where_a_library_raises():
    path = "/home/somebody/main.py"
    assert location_of(raised_by("\njson.loads('[')", path, json=json)) == f"{path}:2"
    parse = raised_by("\n\nparse('x')", path, parse=parse_duration_ns)
    assert location_of(parse) == f"{path}:3"


def test_the_caller_of_code_in_a_string_is_named():
    path = "/home/somebody/main.py"
    assert location_of(raised_by("\nexec('1//0')", path)) == f"{path}:2"
    assert location_of(raised_by("\neval('1 +')", path)) == f"{path}:2"


def test_a_syntax_error_in_a_file_gives_the_line_it_was_found_at():
    assert location_of(raised_by("x = 1\ny = (", "/home/a/main.py")) == "/home/a/main.py:2"


def test_without_a_frame_of_a_program_there_is_no_line():
    assert location_of(ValueError()) == ""
    assert location_of(raised_by("1//0", "<string>")).startswith(f"{__file__}:")


class SilentError(Exception):
    def __str__(self):
        raise RuntimeError("no text")


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (ZeroDivisionError("integer division or modulo by zero"), "division by zero"),
        (PageFault(0, 4), "page fault: 4 bytes at address 16#00000000"),
        (ValueRangeError("too much"), "too much"),
        (ValueError("two\n lines"), "ValueError: two lines"),
        (KeyError("x"), "KeyError: 'x'"),
        (AssertionError(), "AssertionError"),
        (SilentError(), "SilentError"),
    ],
)
def test_what_an_exception_means(error, text):
    assert describe(error) == text


class Axis(Struct):
    speed = var(REAL)


class Closed:
    def __dir__(self):
        raise RuntimeError("no names")


@pytest.mark.parametrize(
    ("source", "names", "text"),
    [
        ("axis.sped", {"axis": Axis()}, "; did you mean speed?"),
        ("[].apend(1)", {}, "; did you mean append?"),
        ("def cyclic(limit):\n  return limt\ncyclic(1)", {}, "; did you mean limit?"),
        ("lenn([])", {}, "; did you mean len?"),
        ("axis.zzzzzz", {"axis": Axis()}, "has no attribute 'zzzzzz'"),
        ("zzzzzz", {}, "name 'zzzzzz' is not defined"),
        ("closed.sped", {"closed": Closed()}, "'Closed' object has no attribute 'sped'"),
    ],
)
def test_a_misspelt_name_gets_the_one_that_was_meant(source, names, text):
    assert describe(raised_by(source, "/home/a/main.py", **names)).endswith(text)


def test_an_error_about_a_name_that_a_program_made_itself_is_told_as_it_is():
    assert describe(AttributeError("speed")) == "AttributeError: speed"
    assert describe(NameError("speed", name="speed")) == "NameError: speed"


def test_a_long_text_is_cut():
    assert len(describe(ValueError("x" * 1_000_000))) < LONGEST_TEXT + 30
    assert describe(ValueError("x" * LONGEST_TEXT)) == "ValueError: " + "x" * LONGEST_TEXT


def test_what_a_terminal_would_act_on_is_shown_as_a_number():
    fault = fault_of(ValueError("\x1b[2Jgone\x9b"))
    assert fault.reason == "ValueError: \\x1b[2Jgone\\x9b"


def test_a_fault_tells_the_calls_that_led_to_it():
    source = "def outer():\n  inner()\ndef inner():\n  1 // 0\nouter()"
    fault = fault_of(raised_by(source, "/home/a/main.py"))
    assert (fault.location, fault.reason) == ("/home/a/main.py:4", "division by zero")
    assert fault.calls[-3:] == (
        "/home/a/main.py:5 in <module>",
        "/home/a/main.py:2 in outer",
        "/home/a/main.py:4 in inner",
    )
