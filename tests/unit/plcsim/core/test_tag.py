"""Tags: paths, values, names that are near."""

from enum import IntEnum

import pytest

from plcsim.core.errors import TagError
from plcsim.core.memory import PAGE, Memory
from plcsim.core.tag import Tag, TagTable, encode_tag, leaves
from plcsim.program.python.program import Program
from st_types import ARRAY, BOOL, ENUM, INT, REAL, STRING, TIME, UINT, Struct, var
from st_types.types.derived import Member, StructType


class Mode(IntEnum):
    OFF = 0
    AUTO = 2


class Axis(Struct):
    speed = var(REAL)
    name = var(STRING(8), "axis")


class Cell(Program):
    on = var(BOOL)
    parts = var(UINT, 7)
    mode = var(ENUM(Mode))
    delay = var(TIME, 500)
    axes = var(ARRAY(Axis, (1, 3)))
    grid = var(ARRAY(INT, (0, 1), (-1, 1)))
    main = var(Axis)


@pytest.fixture
def controller(make_controller, task_class):
    controller = make_controller(task_class(1, 10, cell=Cell, other=Cell))
    controller.boot()
    return controller


@pytest.fixture
def tags(controller):
    return controller.tags


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("cell.on", False),
        ("cell.parts", 7),
        ("CELL.Parts", 7),
        ("cell.delay", 500),
        ("cell.main.name", "axis"),
        ("cell.axes[3].name", "axis"),
        ("cell.grid[1,-1]", 0),
        ("cell.grid[1, -1]", 0),
        ("cell.mode", 0),
    ],
)
def test_a_path_leads_to_a_value(tags, path, value):
    assert tags.read(tags.find(path)) == value


def test_what_is_written_is_what_the_program_has(controller, tags):
    for path, value in {
        "cell.parts": 65535,
        "cell.on": True,
        "cell.axes[2].speed": 1.5,
        "cell.main.name": "conveyor",
        "cell.grid[1,1]": -5,
        "cell.mode": 2,
    }.items():
        tags.write(tags.find(path), value)
    cell, other = (task.cyclic.__self__ for task in controller.tasks)
    assert (cell.parts, cell.on, cell.axes[2].speed) == (65535, True, 1.5)
    assert (cell.main.name, cell.grid[1, 1], cell.mode) == ("conveyor", -5, Mode.AUTO)
    assert (other.parts, other.on, other.grid[1, 1]) == (7, False, 0)


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("", "no program ''"),
        ("cel.parts", "no program 'cel'.*did you mean cell.parts"),
        ("cell.part", "has no member part.*did you mean cell.parts"),
        ("cell.parts.x", "has no members"),
        ("cell.parts[1]", "has no elements"),
        ("cell.axes[0].speed", r"\[0\]"),
        ("cell.axes[4].speed", r"\[4\]"),
        ("cell.axes[1,1].speed", r"\[1,1\]"),
        ("cell.axes[x].speed", r"\[x\]"),
        ("cell.axes[", r"no tag 'cell\.axes\['"),
        ("cell.grid[1]", r"\[1\]"),
        ("cell.main.spede", "did you mean cell.main.speed"),
        ("zzzzzz", "no program 'zzzzzz' for tag 'zzzzzz'$"),
    ],
)
def test_a_wrong_path_is_named_with_what_is_near(tags, path, text):
    with pytest.raises(TagError, match=text):
        tags.find(path)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("cell.parts", -1),
        ("cell.parts", 65536),
        ("cell.parts", "7"),
        ("cell.on", 2),
        ("cell.main.speed", "fast"),
        ("cell.main.name", "€"),
        ("cell.main.name", 5),
    ],
)
def test_a_value_that_does_not_fit_is_refused_and_nothing_is_stored(tags, path, value):
    tag = tags.find(path)
    before = tags.read(tag)
    with pytest.raises(TagError, match=path):
        tags.write(tag, value)
    assert tags.read(tag) == before


def test_all_tags_of_all_programs_are_listed_with_the_first_element_of_arrays(tags):
    of_cell = [
        "on",
        "parts",
        "mode",
        "delay",
        "axes[1].speed",
        "axes[1].name",
        "grid[0,-1]",
        "main.speed",
        "main.name",
    ]
    paths = [tag.path for tag in tags]
    assert paths == [f"{name}.{path}" for name in ("cell", "other") for path in of_cell]
    assert all(tags.find(tag.path) == tag for tag in tags)


@pytest.fixture
def shared():
    """Tags of a program ``p`` with a constant, and of global variables, one of them ``p``."""
    memory = Memory(4 * PAGE)

    def area(path, is_constant, *members):
        data_type = StructType("T", [Member(*member) for member in members])
        tag = Tag(path, data_type, memory.allocate(data_type.size), is_constant)
        memory.write(tag.address, encode_tag(tag._replace(is_constant=False), None))
        return tag

    areas = [
        area("", False, ("gCount", UINT, 5), ("p", UINT, 6), ("gAxes", ARRAY(Axis, (1, 2)))),
        area("", True, ("LIMIT", UINT, 7)),
        area("p", False, ("x", UINT, 8), ("gCount", UINT, 9)),
        area("p", True, ("LIMIT", UINT, 10)),
    ]
    return TagTable(memory, areas)


@pytest.mark.parametrize(
    ("path", "value", "is_constant"),
    [
        ("gCount", 5, False),
        ("GCOUNT", 5, False),
        ("::gCount", 5, False),
        ("gAxes[2].name", "axis", False),
        ("::gAxes[1].speed", 0, False),
        ("LIMIT", 7, True),
        ("p.x", 8, False),
        ("p.gCount", 9, False),
        ("p.LIMIT", 10, True),
        ("::p", 6, False),
    ],
)
def test_global_variables_have_their_bare_names(shared, path, value, is_constant):
    tag = shared.find(path)
    assert shared.read(tag) == value
    assert (tag.path, tag.is_constant) == (path, is_constant)
    assert shared.get(path) == tag


def test_a_program_goes_before_a_global_variable_of_its_name(shared):
    assert shared.read(shared.find("p")) == {"x": 8, "gCount": 9}


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("gCont", "no program and no global variable 'gCont' for tag 'gCont'; did you mean gCount"),
        ("gAxes[3].name", r"no tag 'gAxes\[3\]\.name': \[3\]"),
        ("::q.x", "no global variable 'q'"),
        ("p.LIMT", "did you mean p.LIMIT, LIMIT"),
    ],
)
def test_a_wrong_path_is_named_with_global_variables_too(shared, path, text):
    with pytest.raises(TagError, match=text):
        shared.find(path)
    assert shared.get(path) is None


@pytest.mark.parametrize("path", ["LIMIT", "p.LIMIT", "p.limit"])
def test_a_constant_is_not_written(shared, path):
    tag = shared.find(path)
    with pytest.raises(TagError, match=f"tag {path} is CONSTANT"):
        shared.write(tag, 1)


def test_all_tags_are_listed_by_the_names_they_have(shared):
    assert [tag.path for tag in shared][:4] == ["gCount", "p", "gAxes[1].speed", "gAxes[1].name"]
    constants = [tag.path for tag in shared if tag.is_constant]
    assert constants == ["LIMIT", "p.LIMIT"]
    every = [tag.path for tag in leaves(shared.find("gAxes"))]
    assert every == ["gAxes[1].speed", "gAxes[1].name", "gAxes[2].speed", "gAxes[2].name"]
