"""The command-line tools against our node."""

import re
from pathlib import Path

from crosnode.node import CrosNode, Publisher

from .rig import Ros

STRING = "std_msgs/String"


def talker(ros: Ros) -> tuple[CrosNode, Publisher]:
    """A node that says a word a hundred times a second, and hears /theirs."""
    node = ros.node("plc")
    publisher = node.register_publisher("/chatter", STRING, loop_period_ns=10_000_000)
    node.register_subscriber("/theirs", STRING, queue_size=1000)

    def say() -> None:
        if (message := publisher.pop()) is not None:
            message.data = "word"  # type: ignore[attr-defined]
            publisher.send(message)

    ros.steps.append(say)
    ros.until(lambda: node.is_registered)
    return node, publisher


def test_rostopic(ros: Ros) -> None:
    node, _ = talker(ros)
    assert "/chatter" in ros.tool("rostopic", "list")
    info = ros.tool("rostopic", "info", "/chatter")
    assert "Type: std_msgs/String" in info
    assert "/plc (http://127.0.0.1:" in info
    assert ros.tool("rostopic", "echo", "-n", "3", "/chatter").count('data: "word"') == 3
    rates = re.findall(r"average rate: ([\d.]+)", ros.tool("rostopic", "hz", "/chatter", seconds=5))
    assert 90 < float(rates[-1]) < 110
    ros.tool("rostopic", "pub", "-1", "/theirs", STRING, "hello")
    message = node.subscribers["/theirs"].pop()
    assert message is not None
    assert message.data == "hello"  # type: ignore[attr-defined]


def test_rosnode(ros: Ros) -> None:
    node, publisher = talker(ros)
    peer = ros.rospy("listen", "/chatter")
    ros.until(lambda: publisher.subscribers)
    ros.until(lambda: "heard" in peer.text)
    assert "/plc" in ros.tool("rosnode", "list")
    info = ros.tool("rosnode", "info", "/plc")
    assert f"Pid: {node.pid}" in info
    assert "* topic: /chatter" in info
    assert "* to: /rospy_listen" in info
    assert "* direction: outbound" in info
    assert "xmlrpc reply from" in ros.tool("rosnode", "ping", "-c", "2", "/plc")
    assert "killed" in ros.tool("rosnode", "kill", "/plc")
    ros.until(lambda: node.is_closed)
    assert "/plc" not in ros.tool("rosnode", "list")


def test_roswtf_finds_no_error(ros: Ros) -> None:
    _, publisher = talker(ros)
    ros.rospy("listen", "/chatter")
    ros.rospy("talk", "/theirs")
    ros.until(lambda: publisher.subscribers)
    ros.run(0.5)
    found = ros.tool("roswtf")
    _, _, graph = found.partition("Online checks summary:")
    assert "No errors or warnings" in graph, found


def test_rosbag_records_and_plays(ros: Ros, tmp_path: Path) -> None:
    node, publisher = talker(ros)
    bag = tmp_path / "x.bag"
    ros.tool("rosbag", "record", "-O", str(bag), "-l", "50", "/chatter")
    info = ros.tool("rosbag", "info", str(bag))
    assert re.search(r"/chatter\s+50 msgs\s+: std_msgs/String", info), info
    node.unregister(publisher)
    ros.steps.clear()
    subscriber = node.register_subscriber("/chatter", STRING, queue_size=1000)
    ros.until(lambda: node.is_registered)
    ros.tool("rosbag", "play", "-d", "1", str(bag))
    assert len(subscriber.queue) == 50


def test_a_remapped_node(ros: Ros) -> None:
    node = ros.node("plc", "__name:=robot", "__ns:=/cell", "chatter:=/said", "_gain:=2.5")
    node.register_publisher("chatter", STRING)
    ros.until(lambda: node.is_registered)
    assert "/cell/robot" in ros.tool("rosnode", "list")
    assert "/said" in ros.tool("rostopic", "list")
    assert ros.tool("rosparam", "get", "/cell/robot/gain").strip() == "2.5"
