"""Tags: paths, values, names that are near."""

from enum import IntEnum

import pytest

from plcsim.core.errors import TagError
from plcsim.program.python.program import Program
from st_types import ARRAY, BOOL, ENUM, INT, REAL, STRING, TIME, UINT, Struct, var


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
