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
    seconds = iter(range(5, 1000, 5))

    def is_as_fast() -> bool:
        """Whether it is so in some second; the host may hold one of us up in others."""
        told = ros.tool("rostopic", "hz", "/chatter", seconds=next(seconds))
        return any(90 < float(r) < 110 for r in re.findall(r"average rate: ([\d.]+)", told))

    ros.until(is_as_fast)

    def is_heard() -> bool:
        ros.tool("rostopic", "pub", "-1", "/theirs", STRING, "hello")
        return bool(node.subscribers["/theirs"].queue)

    ros.until(is_heard)
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
    node, publisher = talker(ros)
    ros.rospy("listen", "/chatter")
    ros.rospy("talk", "/theirs")
    ros.until(lambda: publisher.subscribers and node.subscribers["/theirs"].publishers)

    def is_well() -> bool:
        """Whether the graph is whole; rospy's nodes and rosout find each other by themselves."""
        _, _, graph = ros.tool("roswtf").partition("Online checks summary:")
        return "No errors or warnings" in graph

    ros.until(is_well)


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
    ros.tool("rosbag", "play", "-d", "1", "--wait-for-subscribers", str(bag))
    ros.until(lambda: len(subscriber.queue) == 50)


def test_a_remapped_node(ros: Ros) -> None:
    node = ros.node("plc", "__name:=robot", "__ns:=/cell", "chatter:=/said", "_gain:=2.5")
    node.register_publisher("chatter", STRING)
    ros.until(lambda: node.is_registered)
    assert "/cell/robot" in ros.tool("rosnode", "list")
    assert "/said" in ros.tool("rostopic", "list")
    assert ros.tool("rosparam", "get", "/cell/robot/gain").strip() == "2.5"
