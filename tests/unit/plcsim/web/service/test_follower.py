"""Pointers are followed when somebody asks, and lead nowhere without harm."""

import pytest

from plcsim.core.errors import TagError

from ..site import Socket


def store(world, path, value):
    world.plc.tags.write(world.plc.tags.find(path), value)


def linked(world):
    """Let head point to the first node, and that to the second."""
    find = world.plc.tags.find
    store(world, "p.nodes[1].value", 1.25)
    store(world, "p.nodes[2].value", 2.5)
    store(world, "p.head", find("p.nodes[1]").address)
    store(world, "p.heads[1]", find("p.nodes[2]").address)
    store(world, "p.nodes[1].next", find("p.nodes[2]").address)
    store(world, "p.limit", find("p.level").address)
    return find


@pytest.mark.parametrize(
    ("path", "target"),
    [
        ("p.head^.value", "p.nodes[1].value"),
        ("P.HEAD^.next", "p.nodes[1].next"),
        ("p.head^.next^.value", "p.nodes[2].value"),
        ("p.heads[1]^.value", "p.nodes[2].value"),
        ("p.nodes[1].next^", "p.nodes[2]"),
        ("p.limit^", "p.level"),
    ],
)
def test_a_path_leads_to_what_is_pointed_to(world, path, target):
    find = linked(world)
    tag = world.do(lambda: world.hub.follower.find(path))
    there = find(target)
    assert (tag.address, tag.data_type.size) == (there.address, there.data_type.size)


@pytest.mark.parametrize(
    ("path", "why"),
    [
        ("p.head^.next^.next^.value", "points to nothing: it is 0"),
        ("p.count^", "is no pointer"),
        ("p.head^.value^", "is no pointer"),
        ("p.head^.nothing", "nothing"),
        ("p.head^^", "is no pointer"),
        ("p.nothing^", "nothing"),
        ("p.heads^", "is no pointer"),
        ("p.head" + 60 * "^.next", "more than 50 pointers"),
    ],
)
def test_what_leads_nowhere_is_told(world, path, why):
    linked(world)
    with pytest.raises(TagError, match=why):
        world.do(lambda: world.hub.follower.find(path))


@pytest.mark.parametrize("address", [1, 0x7FFF_0000, 0xFFFF_FFFF])
def test_a_wild_pointer_is_told_and_nothing_is_read(world, address):
    store(world, "p.head", address)
    with pytest.raises(TagError, match=f"nothing lies at 16#{address:08X}"):
        world.do(lambda: world.hub.follower.find("p.head^.value"))
    assert world.plc.state.name == "RUN"


def test_the_tree_shows_pointers_and_what_lies_behind_them(world):
    linked(world)
    found = {one["name"]: one for one in world.hub.variables.children("p")["children"]}
    assert (found["head"]["pointer"], found["limit"]["pointer"]) == ("Node", "REAL")
    assert "pointer" not in found["count"]
    heads = world.hub.variables.children("p.heads")["children"]
    assert [one["pointer"] for one in heads] == ["Node", "Node"]

    async def act():
        async with Socket(world) as socket:
            inside = await socket.ask("children", path="p.head^")
            one = await socket.ask("children", path="p.limit^")
            await socket.ask("watch", tags=["p.head^.next^.value", "p.limit^"])
            values = await socket.pushed("values")
            refused = await socket.ask("force", tag="p.head^.value", value="1.0")
            return inside["ok"]["children"], one["ok"]["children"], values, refused

    inside, one, values, refused = world.do(act)
    assert [(each["path"], each.get("pointer")) for each in inside] == [
        ("p.head^.value", None),
        ("p.head^.next", "Node"),
    ]
    assert [(each["path"], each["kind"]) for each in one] == [("p.limit^", "real")]
    assert sorted(values["values"]) == [[0, 2.5], [1, 1.5]]
    assert "error" in refused
