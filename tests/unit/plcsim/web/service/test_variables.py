import pytest

from plcsim.core.errors import TagError


def test_the_tree_is_unfolded_piece_by_piece(world):
    variables = world.hub.variables
    assert [root["path"] for root in variables.roots()] == ["p"]
    inside = variables.children("p")
    found = {one["name"]: one for one in inside["children"]}
    assert inside["count"] == len(found) == 15
    assert found["level"] == {"path": "p.level", "name": "level", "type": "REAL", "kind": "real"}
    assert found["mode"]["names"] == ["OFF", "AUTO", "MANUAL"]
    assert [found[name]["kind"] for name in ("running", "name", "delay", "axes", "small")] == [
        "bool", "string", "time", "branch", "integer 16 signed",
    ]  # fmt: skip
    elements = variables.children("p.axes")
    assert [one["path"] for one in elements["children"]] == ["p.axes[1]", "p.axes[2]", "p.axes[3]"]
    members = variables.children("p.axes[2]")["children"]
    assert [one["path"] for one in members] == ["p.axes[2].speed", "p.axes[2].count"]


def test_a_long_array_comes_in_pieces(world):
    first = world.hub.variables.children("p.many")
    assert (len(first["children"]), first["count"]) == (500, 2000)
    last = world.hub.variables.children("p.many", 1500)
    assert last["children"][-1]["path"] == "p.many[1999]"


def test_a_search_finds_all_words_in_any_case(world):
    found = world.hub.variables.search("AX spe")
    assert [one["path"] for one in found["found"]] == ["p.axes[1].speed"]
    assert found["count"] == 1
    assert world.hub.variables.search("nothing")["count"] == 0


def test_what_is_not_there_is_told(world):
    with pytest.raises(TagError, match="levl"):
        world.hub.variables.children("p.levl")
