"""[ros2] on a controller: what the service is given, and what cannot work."""

from pathlib import Path
from typing import Any

import pytest

from crosnode.ros2.extension import EXTENSION
from plcsim.core.clock import VirtualClock
from plcsim.core.controller import Controller
from plcsim.core.errors import ConfigurationError
from plcsim.network import VirtualNetwork
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.settings.table import Table
from st_types import BOOL, INT, LREAL, STRING, TIME, Struct, var


class Marker(Struct):
    text = var(STRING(20))


class Plant(Program):
    marker = var(Marker)
    level = var(LREAL)
    on = var(BOOL)
    quality = var(INT)
    age = var(TIME)

    def cyclic(self) -> None:
        pass


def controller() -> Controller:
    clock = VirtualClock()
    classes = [TaskClassSetup(1, 10**7, [ProgramSetup("plant", PythonCode(Plant))])]
    host = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    return make_controller(Setup(classes), network=host, clock=clock)


def attached(**values: Any) -> Any:
    table = Table(Path("plc.toml"), "ros2", values)
    return EXTENSION.attach(EXTENSION.read(table), controller())


def entry(**values: str) -> dict[str, str]:
    return {"tag": "plant.level", "type": "std_msgs/Float64"} | values


def test_the_service_is_given_the_entries_and_reads_their_tags() -> None:
    found = attached(
        domain=5,
        publish={"/out": entry(every="20ms", status="plant.quality")},
        subscribe={"/in": entry(timeout="1s", age="plant.age")},
    )
    assert found.for_service["domain"] == 5
    assert found.for_service["publish"] == [
        {"topic": "/out", "tag": "plant.level", "type": "std_msgs/Float64",
         "every_ns": 20_000_000, "on_change": False, "status": "plant.quality"},
    ]  # fmt: skip
    assert found.for_service["subscribe"] == [
        {"topic": "/in", "tag": "plant.level", "type": "std_msgs/Float64",
         "timeout_ns": 10**9, "status": None, "age": "plant.age"},
    ]  # fmt: skip
    paths = {tag.path for tag in found.exports}
    assert paths == {"plant.level", "plant.quality", "plant.age"}


def test_the_domain_is_that_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", "42")
    assert attached().for_service["domain"] == 42
    assert attached(domain=3).for_service["domain"] == 3
    monkeypatch.setenv("ROS_DOMAIN_ID", "999")
    with pytest.raises(ConfigurationError, match="ROS_DOMAIN_ID is '999', not 0 to 232"):
        attached()


@pytest.mark.parametrize(
    ("topic", "values", "reason"),
    [
        ("/in", {"tag": "plant.nothing"}, "ros2.subscribe./in: .*plant.nothing"),
        ("/in", {"type": "std_msgs/Nothing"}, "ros2.subscribe./in: .*std_msgs/Nothing"),
        ("/in", {"type": "std_msgs/String"}, "ros2.subscribe./in: .*plant.level"),
        ("/in", {"status": "plant.on"}, "status: tag plant.on is BOOL"),
        ("/in", {"age": "plant.quality"}, "age: tag plant.quality is INT, not TIME"),
        ("/in in", {}, "subscribe./in in"),
    ],
)
def test_what_cannot_work_is_said_before_the_first_cycle(
    topic: str, values: dict[str, str], reason: str
) -> None:
    with pytest.raises(ConfigurationError, match=reason):
        attached(subscribe={topic: entry(**values)})


def test_a_type_that_ros_2_has_with_other_fields_is_told_of() -> None:
    pytest.importorskip("rosbags")
    marker = {"tag": "plant.marker", "type": "visualization_msgs/Marker"}
    with pytest.raises(ConfigurationError, match="visualization_msgs/Marker is another type in"):
        attached(publish={"/marker": marker})
