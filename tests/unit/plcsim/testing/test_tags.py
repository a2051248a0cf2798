"""The mapping of tags: one door with clear errors, and a note of what was read."""

import pytest

from plcsim.core.errors import TagError
from plcsim.testing import PlcTestError


def test_case_does_not_matter(cell_plc):
    cell_plc["CELL.Initial"] = 9
    assert cell_plc["cell.initial"] == 9


def test_the_latest_reads_are_noted_once(cell_plc):
    for path in ("Cell.count", "Cell.start", "Cell.count"):
        cell_plc.tags[path]
    assert list(cell_plc.tags.read) == ["Cell.start", "Cell.count"]
    cell_plc.tags.peek("Cell.level")
    assert "Cell.level" not in cell_plc.tags.read


def test_noting_goes_into_the_given_place_and_adds_to_all(cell_plc):
    noted = {}
    with cell_plc.tags.noting(noted):
        cell_plc.tags["Cell.count"]
    assert list(noted) == ["Cell.count"]
    assert "Cell.count" in cell_plc.tags.read


@pytest.mark.parametrize("path", [3, None, ("Cell", "count")])
def test_what_is_no_path(cell_plc, path):
    with pytest.raises(TagError, match="is no tag; tags are named"):
        cell_plc.tags.find(path)


def test_leaves_of_a_program_and_of_a_leaf(cell_plc):
    paths = [leaf.path for leaf in cell_plc.tags.leaves("Cell")]
    assert paths[:4] == ["Cell.count", "Cell.start", "Cell.motor.on", "Cell.motor.speed"]
    assert [leaf.path for leaf in cell_plc.tags.leaves("Cell.count")] == ["Cell.count"]


def test_too_many_leaves(cell_plc, monkeypatch):
    monkeypatch.setattr("plcsim.testing.values.MOST_LEAVES", 3)
    with pytest.raises(PlcTestError, match="Cell has more than 3 elements; name some of them"):
        cell_plc.tags.leaves("Cell")
