"""tf, diagnostics and dynamic_reconfigure with ROS' own libraries."""

from crosnode.errors import TransformError
from crosnode.tf.node_frames import (
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformListener,
)
from crosnode.tf.transform import Transform
from crosnode.upkeep.diagnostics import Diagnostics, Level
from crosnode.upkeep.reconfigure import Adjustable, Reconfigure

from .rig import HERE, PYTHON, Process, Ros


def peer(ros: Ros, act: str) -> Process:
    return ros.start([PYTHON, str(HERE / "peers" / "upkeep_peer.py"), act])


def test_frames_with_tf2_ros_in_both_directions(ros: Ros) -> None:
    node = ros.node("arm")
    StaticTransformBroadcaster(node).send("world", "base", Transform((0.0, 0.0, 1.0)))
    moving, listener = TransformBroadcaster(node), TransformListener(node)

    def cyclic() -> None:
        listener.step()
        moving.add("base", "hand", Transform((1.0, 2.0, 0.0)))
        moving.send()

    def knows(target: str, source: str) -> bool:
        try:
            listener.lookup(target, source)
        except TransformError:
            return False
        return True

    ros.steps.append(cyclic)
    other = peer(ros, "tf")
    ros.until(lambda: "hand" in other.text)
    assert "hand 1.000 2.000 1.000" in other.text
    ros.until(lambda: knows("world", "cart") and knows("world", "camera"))
    assert listener.lookup("world", "camera").translation == (1.25, 2.0, 1.0)
    assert listener.lookup("world", "cart").apply((1.0, 0.0, 0.0)) == (-1.0, 7.0, 0.0)


def test_values_with_the_client_of_dynamic_reconfigure(ros: Ros) -> None:
    table = (Adjustable("speed", 0.5, 0.0, 2.0), Adjustable("careful", value=True),
             Adjustable("tool", "gripper"))  # fmt: skip
    server = Reconfigure(ros.node("cell"), table)
    ros.steps.append(server.step)
    other = peer(ros, "reconfigure")
    ros.until(lambda: not other.is_running)
    assert other.text.splitlines() == [
        "speed double 0.0 2.0 0.5",
        "careful bool False True True",
        "tool str   gripper",
        "now 2.0 welder True",
    ]
    assert server.values == {"speed": 2.0, "careful": True, "tool": "welder"}
    ros.until(lambda: ros.tool("rosparam", "get", "/cell/tool").strip() == "welder")


def test_diagnostics_at_rostopic(ros: Ros) -> None:
    found = Diagnostics(ros.node("cell"), "plc-1")
    ros.steps.append(found.step)
    found.set("drives", Level.ERROR, "short circuit", {"current": 9.5})
    said = ros.tool("rostopic", "echo", "-n", "1", "/diagnostics")
    for text in ("level: 2", 'name: "cell: drives"', 'value: "9.5"', 'hardware_id: "plc-1"'):
        assert text in said
