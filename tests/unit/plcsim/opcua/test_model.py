"""What the address space holds."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.core.tag import Tag
from plcsim.opcua.model import Branch, Leaf, ModelMaker, Note
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StructType,
)
from st_types.types.elementary import BOOL, INT, REAL

MOTOR = StructType("Motor", [Member("speed", REAL), Member("on", BOOL)])
TIMER = DataBlockType(
    "Ramp",
    [
        Member("Step", INT, section=Section.INPUT),
        Member("Out", INT, section=Section.OUTPUT),
        Member("before", INT),
    ],
)
MODE = EnumerationType("Mode", {"OFF": 0, "ON": 1})
CONVEYOR = StructType(
    "conveyor",
    [
        Member("motors", ArrayType(MOTOR, [(1, 2)])),
        Member("speeds", ArrayType(REAL, [(0, 1), (0, 2)])),
        Member("ramp", TIMER),
        Member("mode", MODE),
        Member("where", ReferenceType(None)),
    ],
)
SHARED = StructType("globals", [Member("gCount", INT)])
FIXED = StructType("constants", [Member("LIMIT", INT)])
AREAS = [
    Tag("", SHARED, 100),
    Tag("", FIXED, 110, is_constant=True),
    Tag("conveyor", CONVEYOR, 200),
]


def paths(branches):
    return [leaf.tag.path for branch in branches for leaf in branch.leaves()]


def test_programs_structs_blocks_and_arrays_of_structs_are_objects():
    shared, conveyor = ModelMaker().make(AREAS)

    assert (shared.name, shared.path) == ("Globals", "::Globals")
    assert (conveyor.name, conveyor.path) == ("conveyor", "::conveyor")
    motors, speeds, ramp, mode, where = conveyor.children
    assert isinstance(motors, Branch)
    assert [child.name for child in motors.children] == ["[1]", "[2]"]
    second = motors.children[1]
    assert (second.path, second.type_name) == ("conveyor.motors[2]", "Motor")
    assert isinstance(speeds, Leaf)
    assert speeds.dimensions == (2, 3)
    assert speeds.element is REAL
    assert isinstance(ramp, Branch)
    assert isinstance(mode, Leaf)
    assert isinstance(where, Leaf)


def test_what_is_internal_to_a_function_block_is_left_out():
    assert [p for p in paths(ModelMaker().make(AREAS)) if "ramp" in p] == [
        "conveyor.ramp.Step",
        "conveyor.ramp.Out",
    ]


def test_leaves_have_the_address_of_their_tag():
    leaves = {leaf.tag.path: leaf for b in ModelMaker().make(AREAS) for leaf in b.leaves()}

    assert leaves["conveyor.motors[2].on"].tag.address == 200 + MOTOR.size + 4


@pytest.mark.parametrize(
    ("path", "is_writable"),
    [("gCount", True), ("LIMIT", False), ("conveyor.where", False), ("conveyor.mode", True)],
)
def test_constants_and_addresses_cannot_be_written(path, is_writable):
    leaves = {leaf.tag.path: leaf for b in ModelMaker().make(AREAS) for leaf in b.leaves()}

    assert leaves[path].is_writable is is_writable


def test_nothing_can_be_written_where_that_is_said():
    branches = ModelMaker(read_only=True).make(AREAS)

    assert not any(leaf.is_writable for b in branches for leaf in b.leaves())


@pytest.mark.parametrize(
    ("patterns", "served"),
    [
        (["gCount"], ["gCount"]),
        (["CONVEYOR.MODE", "LIMIT"], ["LIMIT", "conveyor.mode"]),
        (["conveyor.motors[2]"], ["conveyor.motors[2].speed", "conveyor.motors[2].on"]),
        (["*.on"], ["conveyor.motors[1].on", "conveyor.motors[2].on"]),
        (["conveyor.ramp.?ut"], ["conveyor.ramp.Out"]),
    ],
)
def test_named_tags_only(patterns, served):
    assert paths(ModelMaker(patterns).make(AREAS)) == served


def test_a_pattern_that_meets_nothing_is_told_with_names_that_are_near():
    with pytest.raises(ConfigurationError, match=r"no tag 'conveyor\.mod'.*conveyor\.mode"):
        ModelMaker(["conveyor.mod"]).make(AREAS)


def test_too_many_variables_are_refused():
    with pytest.raises(ConfigurationError, match="more than 5 variables"):
        ModelMaker(most=5).make(AREAS)


def test_the_tag_map_gives_units_and_limits_whatever_the_case():
    note = Note("rpm", 0.0, 3000.0, "of the belt")
    branches = ModelMaker(notes={"GCOUNT": note}).make(AREAS)

    assert next(branches[0].leaves()).note == note
