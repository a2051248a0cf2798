"""Values that another node changes."""

from typing import Any

import pytest

from crosnode.errors import MessageValueError
from crosnode.upkeep.reconfigure import Adjustable, Reconfigure

from ..node.world import MASTER_IP, OTHER_IP, World, drain

TABLE = (
    Adjustable("speed", 0.5, 0.0, 2.0, "m/s"),
    Adjustable("retries", 3, 0, 10),
    Adjustable("careful", value=True),
    Adjustable("tool", "gripper"),
)


class Rig:
    def __init__(self) -> None:
        self.world = world = World()
        self.server = Reconfigure(world.node("cell"), TABLE)
        world.steps.append(self.server.step)
        self.other = world.node("gui", OTHER_IP)
        self.described = self._heard("parameter_descriptions", "ConfigDescription")
        self.updates = self._heard("parameter_updates", "Config")
        self.caller = self.other.register_service_caller(
            "/cell/set_parameters", "dynamic_reconfigure/Reconfigure"
        )
        world.run(300)

    def _heard(self, topic: str, name: str) -> Any:
        return self.other.register_subscriber(f"/cell/{topic}", f"dynamic_reconfigure/{name}")

    def send(self, kind: str, **values: object) -> Any:
        request = self.caller.new()
        attribute = {"Bool": "bools", "Int": "ints", "Double": "doubles", "Str": "strs"}[kind]
        parameter = self.other.types.message(f"dynamic_reconfigure/{kind}Parameter")
        made = [parameter.new(name=name, value=value) for name, value in values.items()]
        setattr(request.config, attribute, made)
        self.caller.call(request)
        self.world.run(50)
        reply = self.caller.pop()
        assert reply is not None
        return reply.response.config


def values_of(config: Any) -> dict[str, object]:
    lists = (config.bools, config.ints, config.doubles, config.strs)
    return {each.name: each.value for some in lists for each in some}


def test_values_are_described_with_their_bounds() -> None:
    rig = Rig()
    (described,) = drain(rig.described.pop)
    (group,) = described.groups
    assert [(each.name, each.type) for each in group.parameters] == [
        ("speed", "double"), ("retries", "int"), ("careful", "bool"), ("tool", "str"),
    ]  # fmt: skip
    assert values_of(described.min) | values_of(described.max) == {
        "speed": 2.0, "retries": 10, "careful": True, "tool": "",
    }  # fmt: skip
    assert values_of(described.dflt) == {each.name: each.value for each in TABLE}
    assert [values_of(each) for each in drain(rig.updates.pop)] == [values_of(described.dflt)]


def test_others_change_values_within_their_bounds() -> None:
    rig = Rig()
    drain(rig.updates.pop)
    answer = rig.send("Double", speed=1.25, nonsense=3.0)
    assert rig.server.values["speed"] == values_of(answer)["speed"] == 1.25
    assert values_of(rig.send("Double", speed=99.0))["speed"] == 2.0
    assert values_of(rig.send("Double", speed=float("nan")))["speed"] == 2.0
    assert values_of(rig.send("Int", retries=-5))["retries"] == 0
    assert values_of(rig.send("Int", speed=1))["speed"] == 2.0  # of another type
    assert values_of(rig.send("Bool", careful=False))["careful"] is False
    assert values_of(rig.send("Str", tool="x" * 5_000))["tool"] == "x" * 1_000
    assert rig.server.changes == 7
    assert values_of(drain(rig.updates.pop)[-1]) == rig.server.values


def test_the_program_changes_values() -> None:
    rig = Rig()
    drain(rig.updates.pop)
    rig.server.set("speed", 5.0)
    rig.world.run(10)
    (update,) = drain(rig.updates.pop)
    assert values_of(update)["speed"] == 2.0
    with pytest.raises(KeyError):
        rig.server.set("nothing", 1)


@pytest.mark.parametrize(
    "table", [(Adjustable("a", 1), Adjustable("a", 2)), (Adjustable("a", 5, 0, 3),)]
)
def test_a_table_that_cannot_be(table: tuple[Adjustable, ...]) -> None:
    with pytest.raises(MessageValueError):
        Reconfigure(World().node("n"), table)


def test_what_the_parameter_server_has_counts_at_the_start_and_what_changes_is_stored() -> None:
    world = World()
    assert world.master
    master = world.master.master
    found = {"speed": 9, "retries": 2.5, "careful": False, "note": "not of the table"}
    master.set_param("/launch", "/cell", found)
    server = Reconfigure(world.node("cell"), TABLE)
    world.steps.append(server.step)
    gui = world.node("gui", OTHER_IP)
    updates = gui.register_subscriber("/cell/parameter_updates", "dynamic_reconfigure/Config")
    world.run(1_000)
    values = {"speed": 2.0, "retries": 3, "careful": False, "tool": "gripper"}
    assert server.values == values
    assert server.changes == 2
    assert values_of(drain(updates.pop)[-1]) == values
    assert master.get_param("/x", "/cell")[2] == found | values
    server.set("tool", "welder")
    world.run(100)
    assert master.get_param("/x", "/cell/tool")[2] == "welder"


def test_values_are_stored_when_the_master_comes_and_a_newer_one_is_not_read_over() -> None:
    world = World(master=False)
    world.net.host(MASTER_IP)
    server = Reconfigure(world.node("cell"), TABLE)
    world.steps.append(server.step)
    world.run(1_000)
    server.set("retries", 7)
    world.restart_master()
    assert world.master
    master = world.master.master
    master.set_param("/launch", "/cell/retries", 5)
    world.run(3_000)
    assert server.values["retries"] == 7
    assert master.get_param("/x", "/cell")[2] == server.values


def test_a_value_that_changes_while_the_master_is_away_is_stored_later() -> None:
    rig = Rig()
    rig.world.run(500)
    rig.world.kill_master()
    rig.server.set("speed", 1.5)
    rig.world.run(500)
    rig.world.restart_master()
    assert rig.world.master
    rig.world.run(3_000)
    assert rig.world.master.master.get_param("/x", "/cell/speed")[2] == 1.5
