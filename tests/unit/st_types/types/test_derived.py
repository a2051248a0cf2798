from enum import IntEnum

import pytest

from st_types import (
    ARRAY,
    BOOL,
    DINT,
    ENUM,
    INT,
    LREAL,
    REAL,
    STRING,
    UDINT,
    UINT,
    USINT,
    WSTRING,
    DeclarationError,
)
from st_types.types.derived import (
    AliasType,
    ArrayType,
    EnumerationType,
    Member,
    ReferenceType,
    StructType,
    SubrangeType,
    resolve_alias,
)


class Color(IntEnum):
    RED = 1
    GREEN = 5


SPEED = SubrangeType("Speed", INT, -10, 10)


@pytest.mark.parametrize(
    ("data_type", "name", "size", "alignment"),
    [
        (STRING(20), "STRING[20]", 21, 1),
        (STRING(1), "STRING[1]", 2, 1),
        (WSTRING(20), "WSTRING[20]", 42, 2),
        (ARRAY(UINT, (1, 5)), "ARRAY[1..5] OF UINT", 10, 2),
        (ARRAY(BOOL, (-1, 1), (0, 3)), "ARRAY[-1..1, 0..3] OF BOOL", 12, 1),
        (ARRAY(LREAL, (0, 0)), "ARRAY[0..0] OF LREAL", 8, 4),
        (ARRAY(STRING(4), (0, 1)), "ARRAY[0..1] OF STRING[4]", 10, 1),
        (ENUM(Color), "Color", 4, 4),
        (SPEED, "Speed", 2, 2),
        (ReferenceType(LREAL), "REFERENCE TO LREAL", 4, 4),
        (ReferenceType(None, "ref"), "ref", 4, 4),
        (AliasType("Temperature", REAL), "Temperature", 4, 4),
    ],
    ids=str,
)
def test_name_size_and_alignment(data_type, name, size, alignment):
    assert (data_type.name, data_type.size, data_type.alignment) == (name, size, alignment)


@pytest.mark.parametrize(
    ("declare", "message"),
    [
        (
            lambda: ARRAY(StructType("Empty", []), (1, 2**20)),
            "ARRAY[1..1048576] OF Empty: 1048576 elements are too many.",
        ),
        (lambda: STRING(-1), "STRING[-1]: the length must be 0 or above."),
        (lambda: WSTRING(-3), "WSTRING[-3]: the length must be 0 or above."),
        (
            lambda: ARRAY(INT, (2, 1)),
            "ARRAY[2..1] OF INT: each lower bound must not be above its upper bound.",
        ),
        (
            lambda: ARRAY(INT),
            "ARRAY[] OF INT: each lower bound must not be above its upper bound.",
        ),
        (
            lambda: ARRAY(LREAL, (1, 2**30)),
            "ARRAY[1..1073741824] OF LREAL: 8589934592 bytes are too many.",
        ),
        (
            lambda: StructType("Motor", [Member("speed", INT), Member("speed", REAL)]),
            "Motor: two members are called speed.",
        ),
        (
            lambda: StructType("Two", [Member(n, ARRAY(DINT, (1, 2**28))) for n in "ab"]),
            "Two: 2147483648 bytes are too many.",
        ),
        (lambda: EnumerationType("Mode", {}), "Mode: an enumeration needs at least one value."),
        (
            lambda: EnumerationType("Mode", {"ON": 2**31}),
            "Mode.ON: 2147483648 is not a DINT.",
        ),
        (lambda: SubrangeType("Part", REAL, 0, 1), "Part: REAL cannot have a subrange."),
        (lambda: SubrangeType("Part", USINT, -1, 5), "Part: -1..5 is not a range of USINT."),
        (lambda: SubrangeType("Part", USINT, 5, 4), "Part: 5..4 is not a range of USINT."),
    ],
)
def test_a_wrong_declaration_says_what_is_wrong(declare, message):
    with pytest.raises(DeclarationError) as caught:
        declare()
    assert str(caught.value) == message


def test_the_last_index_runs_fastest():
    grid = ArrayType(INT, [(1, 2), (-1, 1)])
    places = [grid.index_of(i, j) for i in (1, 2) for j in (-1, 0, 1)]
    assert places == list(range(grid.count)) == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize(
    ("indices", "message"),
    [
        ((1,), "ARRAY[1..2, -1..1] OF INT: 2 indices wanted, not 1."),
        ((3, 0), "ARRAY[1..2, -1..1] OF INT: index 3 is outside 1..2."),
        ((1, -2), "ARRAY[1..2, -1..1] OF INT: index -2 is outside -1..1."),
    ],
)
def test_a_wrong_index_says_which(indices, message):
    with pytest.raises(IndexError) as caught:
        ArrayType(INT, [(1, 2), (-1, 1)]).index_of(*indices)
    assert str(caught.value) == message


def test_members_are_found_as_they_are_spelled_with_their_offset():
    motor = StructType("Motor", [Member("on", BOOL), Member("Speed", REAL, 1.5)])
    assert motor.find("Speed") == (Member("Speed", REAL, 1.5), 4)
    for name in ("SPEED", "torque"):
        with pytest.raises(KeyError):
            motor.find(name)


def test_members_may_differ_in_case_only_as_those_of_acp10_mc():
    limits = StructType("Limits", [Member("A1", REAL), Member("a1", REAL), Member("V", REAL)])
    assert [limits.find(name)[1] for name in ("A1", "a1")] == [0, 4]
    assert [limits.spelling(name) for name in ("a1", "v", "B")] == ["a1", "V", None]


def test_enumeration_keeps_names_values_and_its_class():
    color = ENUM(Color)
    assert (color.values, color.members) == ({"RED": 1, "GREEN": 5}, Color)


def test_a_type_may_refer_to_itself():
    reference = ReferenceType(lambda: node, "REFERENCE TO Node")
    node = StructType("Node", [Member("next", reference), Member("value", UDINT)])
    assert node.members[0].data_type.target is node
    assert node.size == 8


def test_a_target_is_asked_for_once():
    asked = []
    reference = ReferenceType(lambda: asked.append(0), "REFERENCE TO Lib")
    assert (reference.target, reference.target, asked) == (None, None, [0])


def test_aliases_of_aliases_resolve_to_the_type():
    inner = AliasType("Inner", SPEED, 3)
    assert resolve_alias(AliasType("Outer", inner)) is SPEED
    assert resolve_alias(SPEED) is SPEED
