from collections.abc import Iterable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import ARRAY, BOOL, INT, REAL, STRING, UINT, Struct, var
from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    Member,
    ReferenceType,
    Section,
    StructType,
)
from st_types.types.paths import Part, find, inner_types, leaves, parts
from st_types.types.views import type_of


class Axis(Struct):
    on = var(BOOL)
    speed = var(REAL, 1.5)


class Cell(Struct):
    number = var(INT, -3)
    main = var(Axis)
    axes = var(ARRAY(Axis, (1, 3)))
    grid = var(ARRAY(INT, (0, 1), (-1, 1)))
    name = var(STRING(5), "cell")


@pytest.mark.parametrize(
    ("path", "name", "offset"),
    [
        ("", "Cell", 0),
        ("number", "INT", 0),
        ("NUMBER", "INT", 0),
        ("main.speed", "REAL", 8),
        ("axes", "ARRAY[1..3] OF Axis", 12),
        ("axes[1]", "Axis", 12),
        ("axes[3].Speed", "REAL", 32),
        ("grid[0,-1]", "INT", 36),
        ("grid[1, 0]", "INT", 44),
        ("name", "STRING[5]", 48),
    ],
)
def test_find(path, name, offset):
    data_type, found = find(type_of(Cell), path)
    assert (data_type.name, found) == (name, offset)


def test_find_starts_at_an_array_and_sees_through_aliases():
    rows = AliasType("Rows", ARRAY(ARRAY(AliasType("Speed", UINT), (1, 2)), (0, 1)))
    assert find(rows, "[1][2]") == (UINT, 6)
    assert find(rows, "") == (rows.target, 0)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("speed", "Cell has no member speed"),
        ("main.torque", "Axis has no member torque"),
        ("axes[4]", "[4]: ARRAY[1..3] OF Axis: index 4 is outside 1..3."),
        ("axes[1,1]", "[1,1]: ARRAY[1..3] OF Axis: 1 indices wanted, not 2."),
        ("grid[0]", "[0]: ARRAY[0..1, -1..1] OF INT: 2 indices wanted, not 1."),
        ("axes[x]", "[x]: "),
        ("axes[]", "[]: "),
        ("axes.on", "ARRAY[1..3] OF Axis has no members (on)"),
        ("number.x", "INT has no members (x)"),
        ("number[0]", "INT has no elements ([0])"),
        ("name[0]", "STRING[5] has no elements ([0])"),
    ],
)
def test_a_wrong_path_says_which_step(path, message):
    with pytest.raises(KeyError) as caught:
        find(type_of(Cell), path)
    assert caught.value.args[0].startswith(message)


@pytest.mark.parametrize(
    "path",
    [".", "main.", ".main", "main..speed", "axes[1", "axes1]", "axes[[1]]", "axes.[1]", "a b"],
)
def test_what_is_not_a_path_is_refused(path):
    with pytest.raises(KeyError) as caught:
        find(type_of(Cell), path)
    assert caught.value.args[0] == f"{path} is not a path such as axes[3].name"


STEPS = ["axes", "grid", "main", "on", "name", "[", "]", "[2]", "[0,1]", "1", "-", ",", ".", ".on"]


@given(st.lists(st.sampled_from(STEPS), max_size=5).map("".join) | st.text())
def test_any_text_is_a_path_or_a_key_error(path):
    try:
        data_type, offset = find(type_of(Cell), path)
    except KeyError:
        return
    assert 0 <= offset <= type_of(Cell).size - data_type.size


def test_members_that_differ_in_case_only_are_two() -> None:
    limits = StructType("limits", [Member("A1", INT), Member("a1", INT), Member("V", INT)])
    assert (find(limits, "A1")[1], find(limits, "a1")[1], find(limits, "v")[1]) == (0, 2, 4)


CELL = [
    ("number", "INT", 0),
    ("main", "Axis", 4),
    ("main.on", "BOOL", 4),
    ("main.speed", "REAL", 8),
    ("axes", "ARRAY[1..3] OF Axis", 12),
    ("axes[1]", "Axis", 12),
    ("axes[1].on", "BOOL", 12),
    ("axes[1].speed", "REAL", 16),
]


def shown(found: Iterable[Part]) -> list[tuple[str, str, int]]:
    return [(part.path, part.data_type.name, part.offset) for part in found]


def test_parts_come_before_what_they_hold() -> None:
    found = shown(parts(type_of(Cell), elements=False))
    assert found[0] == ("", "Cell", 0)
    assert found[1:9] == CELL
    assert found[9:] == [
        ("grid", "ARRAY[0..1, -1..1] OF INT", 36),
        ("grid[0,-1]", "INT", 36),
        ("name", "STRING[5]", 48),
    ]


def test_every_part_is_found_by_its_path() -> None:
    every = list(parts(type_of(Cell)))
    assert len(every) == 23
    for part in every:
        assert find(type_of(Cell), part.path) == (part.data_type, part.offset)


def test_leaves_hold_values() -> None:
    found = leaves(AliasType("Alias", type_of(Cell)), "cell", 100, elements=False)
    assert shown(found) == [
        ("cell.number", "INT", 100),
        ("cell.main.on", "BOOL", 104),
        ("cell.main.speed", "REAL", 108),
        ("cell.axes[1].on", "BOOL", 112),
        ("cell.axes[1].speed", "REAL", 116),
        ("cell.grid[0,-1]", "INT", 136),
        ("cell.name", "STRING[5]", 148),
    ]


def test_data_blocks_can_be_left_alone() -> None:
    block = DataBlockType("TON", [Member("IN", BOOL)])
    both = StructType("S", [Member("t", block), Member("x", INT)])
    assert [part.path for part in leaves(both)] == ["t.IN", "x"]
    assert [part.path for part in leaves(both, blocks=False)] == ["x"]
    section = DataBlockType("F", [Member("a", BOOL, None, Section.INPUT), Member("b", BOOL)])
    assert [part.path for part in leaves(section, internals=False)] == ["a"]


def test_a_part_knows_its_declared_type() -> None:
    alias = AliasType("Speed", REAL)
    (_, part) = parts(StructType("S", [Member("v", alias)]))
    assert (part.data_type, part.declared) == (REAL, alias)


def test_types_inside_a_declaration() -> None:
    alias = AliasType("Alias", INT)
    array = ArrayType(alias, [(0, 1)])
    struct = StructType("S", [Member("a", array), Member("r", ReferenceType(REAL))])
    assert list(inner_types(alias)) == [INT]
    assert list(inner_types(array)) == [alias]
    assert next(iter(inner_types(struct))) is array
    assert list(inner_types(struct.members[1].data_type)) == [REAL]
    assert list(inner_types(INT)) == list(inner_types(ReferenceType(None))) == []
