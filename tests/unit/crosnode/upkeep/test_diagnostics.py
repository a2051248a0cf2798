"""Diagnostics of a node as another one hears them."""

from typing import Any

import pytest

from crosnode.errors import MessageValueError
from crosnode.node.ros_time import Epoch
from crosnode.upkeep import diagnostics as module
from crosnode.upkeep.diagnostics import Diagnostics, Level

from ..node.world import OTHER_IP, World, drain


def rig() -> tuple[World, Diagnostics, Any]:
    world = World()
    found = Diagnostics(world.node("cell", epoch=Epoch(10**18)), "plc-1")
    heard = world.node("l", OTHER_IP).register_subscriber(
        "/diagnostics", module.TYPE, queue_size=99
    )
    world.run(200)
    world.steps.append(found.step)
    return world, found, heard


def test_components_are_told_once_a_second_and_when_a_level_changes() -> None:
    world, found, heard = rig()
    world.run(50)
    assert drain(heard.pop) == []
    found.set("drives", Level.OK, "on", {"current A": 1.5})
    found.set("gripper", Level.WARN, "slow")
    world.run(3_100)
    messages = drain(heard.pop)
    assert len(messages) == 4
    drives, gripper = messages[0].status
    assert (drives.name, drives.level, drives.message) == ("cell: drives", 0, "on")
    assert drives.hardware_id == "plc-1"
    assert [(each.key, each.value) for each in drives.values] == [("current A", "1.5")]
    assert gripper.level == Level.WARN
    assert messages[0].header.stamp.to_ns() > 10**18
    found.set("drives", Level.OK, "still on")
    world.run(5)
    assert drain(heard.pop) == []
    found.set("drives", Level.ERROR, "short circuit")
    world.run(5)
    (message,) = drain(heard.pop)
    assert message.status[0].message == "short circuit"


def test_components_and_values_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_COMPONENTS", 1)
    _, found, _ = rig()
    found.set("one", Level.OK)
    found.set("one", Level.OK)
    with pytest.raises(MessageValueError, match="at most 1 components"):
        found.set("two", Level.OK)
    with pytest.raises(MessageValueError, match="100 values"):
        found.set("one", Level.OK, "", {str(number): number for number in range(101)})
