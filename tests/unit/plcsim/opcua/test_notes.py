"""Units, limits and descriptions from tags.csv."""

from plcsim.opcua.model import Note
from plcsim.opcua.notes import notes_of


def test_a_project_without_a_tag_map_has_none(tmp_path):
    assert notes_of(tmp_path) == {}


def test_unit_limits_and_description_of_a_row(tmp_path):
    (tmp_path / "tags.csv").write_text(
        "tag,area,offset,unit,min,max,description\nmain.level,hr,0,m,0,10,of the tank\n"
    )

    assert notes_of(tmp_path) == {"main.level": Note("m", 0.0, 10.0, "of the tank")}


def test_limits_of_a_scaled_row_are_not_those_of_the_variable(tmp_path):
    (tmp_path / "tags.csv").write_text(
        "tag,area,offset,scale,unit,min,max\nmain.raw,hr,0,0.1,bar,0,10\n"
    )

    assert notes_of(tmp_path) == {"main.raw": Note()}
