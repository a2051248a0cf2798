from enum import IntEnum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import (
    ARRAY,
    BOOL,
    DINT,
    ENUM,
    INT,
    REAL,
    STRING,
    UINT,
    USINT,
    WSTRING,
    Struct,
    ValueRangeError,
    var,
)
from st_types.types.derived import AliasType
from st_types.types.views import view_of


class Color(IntEnum):
    RED = 1
    GREEN = 5


class Axis(Struct):
    on = var(BOOL)
    speed = var(INT, 7)


def new(data_type):
    """Return an array over zeroed memory of its own."""
    return view_of(data_type, bytearray(data_type.size), 0, 0, None)


def test_indices_are_as_declared():
    array = new(ARRAY(INT, (-1, 1)))
    for index in (-1, 0, 1):
        array[index] = index * 10
    assert [array[-1], array[0], array[1]] == list(array) == [-10, 0, 10]
    assert len(array) == 3


@pytest.mark.parametrize("index", [-2, 2, (0, 0), ()])
def test_an_index_outside_its_bounds_is_refused(index):
    array = new(ARRAY(INT, (-1, 1)))
    with pytest.raises(IndexError, match=r"ARRAY\[-1\.\.1\] OF INT: "):
        array[index]
    with pytest.raises(IndexError, match=r"ARRAY\[-1\.\.1\] OF INT: "):
        array[index] = 1
    assert list(array) == [0, 0, 0]


def test_two_dimensions_run_the_last_index_fastest():
    grid = new(ARRAY(USINT, (1, 2), (0, 2)))
    for i in (1, 2):
        for j in (0, 1, 2):
            grid[i, j] = 10 * i + j
    assert bytes(grid) == bytes([10, 11, 12, 20, 21, 22])
    assert (grid[2, 1], len(grid)) == (21, 6)
    for index in (1, (3, 0), (1, 3), (1, 0, 0)):
        with pytest.raises(IndexError):
            grid[index]


def test_integers_wrap_and_bools_are_true_or_false():
    words = new(ARRAY(UINT, (0, 0)))
    words[0] = 65536 + 5
    flags = new(ARRAY(BOOL, (0, 1)))
    flags[1] = True
    assert (words[0], list(flags)) == (5, [False, True])


def test_enumerations_read_as_members_and_take_names():
    colors = new(ARRAY(ENUM(Color), (1, 3)))
    colors[1], colors[2] = Color.GREEN, "RED"
    assert list(colors) == [Color.GREEN, Color.RED, 0]
    assert colors[1] is Color.GREEN
    with pytest.raises(ValueRangeError, match=r"BLUE is not a value of Color\."):
        colors[1] = "BLUE"


@pytest.mark.parametrize("element", [STRING(3), AliasType("Name", STRING(3)), WSTRING(3)], ids=str)
def test_strings_are_cut_and_do_not_touch_their_neighbours(element):
    names = new(ARRAY(element, (0, 2)))
    names[0], names[2] = "left", "right"
    names[1] = "middle"
    assert list(names) == ["lef", "mid", "rig"]
    names[1] = "x"
    assert list(names) == ["lef", "x", "rig"]


def test_an_assigned_string_leaves_the_bytes_behind_its_terminator():
    names = new(ARRAY(STRING(3), (0, 0)))
    names[0] = "abc"
    names[0] = "x"
    assert bytes(names) == b"x\0c\0"


def test_structs_are_views_each_made_once():
    axes = new(ARRAY(Axis, (1, 2), (0, 1)))
    axes[2, 0].speed = 5
    assert axes[2, 0] is axes[2, 0]
    assert bytes(axes) == bytes(10) + b"\5\0" + bytes(4)
    axes[1, 0] = axes[2, 0]
    axes[2, 0].speed = 6
    assert [axis.speed for axis in axes] == [5, 0, 6, 0]
    axes[1, 1] = {"on": True}
    assert (axes[1, 1].on, axes[1, 1].speed) == (True, 7)
    with pytest.raises(TypeError, match="Axis cannot take 5"):
        axes[1, 1] = 5


def test_arrays_of_arrays_are_views_too():
    rows = new(ARRAY(ARRAY(INT, (1, 2)), (3, 4)))
    rows[4][1] = 7
    rows[3] = [1, 2]
    assert bytes(rows) == bytes([1, 0, 2, 0, 7, 0, 0, 0])


def test_addresses_of_elements_follow_the_array():
    data_type = ARRAY(Axis, (1, 3))
    axes = view_of(data_type, bytearray(20), 8, 0x1008, None)
    assert (axes.address, axes[3]._plc_address) == (0x1008, 0x1010)
    assert new(data_type)[3]._plc_address == 0


def test_assign_takes_an_array_of_the_same_elements_or_a_sequence():
    array, other = new(ARRAY(INT, (1, 3))), new(ARRAY(INT, (0, 2)))
    other.assign([4, 5, 6])
    array.assign(other)
    assert list(array) == [4, 5, 6]
    array.assign([1])
    assert list(array) == [1, 0, 0]
    array.assign(array)
    assert list(array) == [1, 0, 0]


@pytest.mark.parametrize(
    ("source", "target"),
    [
        (ARRAY(INT, (1, 3)), ARRAY(INT, (1, 2))),
        (ARRAY(REAL, (1, 2)), ARRAY(DINT, (1, 2))),
        (ARRAY(INT, (1, 2)), ARRAY(DINT, (1, 1))),
        (ARRAY(ARRAY(UINT, (1, 2)), (1, 2)), ARRAY(ARRAY(INT, (1, 2)), (1, 2))),
    ],
    ids=str,
)
def test_assign_refuses_an_array_of_another_type(source, target):
    with pytest.raises(ValueRangeError) as caught:
        new(target).assign(new(source))
    assert str(caught.value) == f"{target} cannot take {source}."


@pytest.mark.parametrize(
    ("source", "target"),
    [
        (ARRAY(STRING(3), (1, 2)), ARRAY(STRING(3), (0, 1))),
        (ARRAY(AliasType("Speed", INT), (1, 2)), ARRAY(INT, (1, 2))),
        (ARRAY(ARRAY(INT, (1, 2)), (1, 2)), ARRAY(ARRAY(INT, (1, 2)), (1, 2))),
        (ARRAY(Axis, (1, 2)), ARRAY(Axis, (1, 2))),
    ],
    ids=str,
)
def test_assign_takes_equal_types_declared_twice(source, target):
    array, other = new(target), new(source)
    other.write(bytes(range(1, 5)))
    array.assign(other)
    assert bytes(array) == bytes(other)


def test_a_value_that_does_not_fit_changes_nothing():
    array = new(ARRAY(INT, (1, 2)))
    with pytest.raises(ValueRangeError, match=r"\[1\]: 70000 is outside"):
        array.assign([1, 70000])
    assert list(array) == [0, 0]


def test_write_stores_bytes_from_the_first_element_on():
    array = new(ARRAY(UINT, (0, 1)))
    array.write(b"\1\2\3")
    assert list(array) == [0x201, 3]
    with pytest.raises(ValueRangeError, match="5 bytes are too many for ARRAY"):
        array.write(bytes(5))


def test_arrays_compare_by_their_elements():
    array, other = new(ARRAY(INT, (0, 1))), new(ARRAY(INT, (5, 6)))
    assert array == other == [0, 0]
    array[1] = 3
    assert array != other
    assert array == [0, 3]
    assert array != (0, 3)
    assert repr(array) == "ARRAY[0..1] OF INT([0, 3])"
    with pytest.raises(TypeError):
        hash(array)


@given(st.lists(st.integers(-(2**40), 2**40), min_size=6, max_size=6), st.integers(-5, 5))
def test_every_element_keeps_the_low_bits_of_what_was_stored(values, low):
    array = new(ARRAY(INT, (low, low + 1), (0, 2)))
    for place, value in enumerate(values):
        array[low + place // 3, place % 3] = value
    assert list(array) == [INT.wrap(value) for value in values]
