"""Variables by name."""

import pytest

from plcsim.library.runtime import ERR_OK
from plcsim.library.sys_lib import ERR_BUR_ILLPTR, ERR_BUR_NOENTRY, ERR_BUR_TOOLONG_PVNAME
from plcsim.library.sys_lib.variables import type_code
from st_types import ARRAY, DINT, LREAL, STRING, TIME, WSTRING
from st_types.types.derived import EnumerationType


@pytest.mark.parametrize(
    "path", ["mix.calls", "mix.steps[3].level", "fill.weights[2]", "mix.first", "mix.name"]
)
def test_address_and_length(tasks, path):
    found = tasks.controller.tags.find(path)
    name = tasks.text(path.replace(".", ":", 1))
    assert tasks.function("PV_xgetadr")(name, tasks.out, tasks.out + 4) == ERR_OK
    assert (tasks.number(), tasks.number(4)) == (found.address, found.data_type.size)


@pytest.mark.parametrize("name", ["calls", "mix:nothing", "mix:steps[5]", "", ":", "mix:", "a:b:c"])
def test_no_such_variable(tasks, name):
    status = tasks.function("PV_xgetadr")(tasks.text(name), tasks.out, tasks.out + 4)
    assert status == ERR_BUR_NOENTRY


def test_null_pointers_and_names_too_long(tasks):
    name, out = tasks.text("mix:calls"), tasks.out
    assert tasks.function("PV_xgetadr")(0, out, out) == ERR_BUR_ILLPTR
    assert tasks.function("PV_xgetadr")(name, 0, out) == ERR_BUR_ILLPTR
    assert tasks.function("PV_ninfo")(name, out, out, 0) == ERR_BUR_ILLPTR
    assert tasks.function("PV_item")(name, 0, 0) == ERR_BUR_ILLPTR
    long = tasks.text("x" * 256)
    assert tasks.function("PV_xgetadr")(long, out, out + 4) == ERR_BUR_TOOLONG_PVNAME


@pytest.mark.parametrize(
    ("name", "code", "length", "dimension"),
    [
        ("mix:calls", 6, 2, 1),
        ("mix:on", 1, 1, 1),
        ("mix:name", 9, 21, 1),
        ("mix:first", 0, 8, 2),
        ("mix:steps", 15, 8, 5),
        ("mix:steps[1]", 0, 8, 2),
        ("mix:steps[1].level", 8, 4, 1),
        ("mix:weights", 6, 2, 3),
    ],
)
def test_type_length_and_dimension(tasks, name, code, length, dimension):
    out = tasks.out
    assert tasks.function("PV_ninfo")(tasks.text(name), out, out + 4, out + 8) == ERR_OK
    assert (tasks.number(), tasks.number(4), tasks.number(8, 2)) == (code, length, dimension)


def test_type_of_nothing(tasks):
    out = tasks.out
    status = tasks.function("PV_ninfo")(tasks.text("mix:x"), out, out + 4, out + 8)
    assert status == ERR_BUR_NOENTRY


def test_members(tasks):
    item = tasks.function("PV_item")
    assert item(tasks.text("mix:first"), 1, tasks.out) == ERR_OK
    assert tasks.string() == "level"
    assert item(tasks.text("mix:first"), 2, tasks.out) == ERR_BUR_NOENTRY
    assert item(tasks.text("mix:calls"), 0, tasks.out) == ERR_BUR_NOENTRY
    assert item(tasks.text("mix:x"), 0, tasks.out) == ERR_BUR_NOENTRY


@pytest.mark.parametrize(
    ("data_type", "code"),
    [
        (DINT, 4),
        (LREAL, 14),
        (TIME, 12),
        (STRING(5), 9),
        (WSTRING(5), 21),
        (ARRAY(LREAL, (0, 1)), 14),
        (EnumerationType("Mode", {"OFF": 0}), 4),
    ],
)
def test_numbers_of_types(data_type, code):
    assert type_code(data_type) == code
