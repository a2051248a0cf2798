"""Latched topics and parameters with a roscpp node, both ways."""

from pathlib import Path

from .rig import Ros

STRING = "std_msgs/String"


def test_latched_topics(ros: Ros, roscpp: Path) -> None:
    peer = ros.start([str(roscpp / "latched")])
    ros.until(lambda: "/cpp_latched" in ros.tool("rostopic", "list"))
    node = ros.node("plc")  # later than the word
    subscriber = node.register_subscriber("/cpp_latched", STRING)
    ros.until(lambda: subscriber.queue)
    message = subscriber.pop()
    assert message is not None
    assert message.data == "kept by roscpp"  # type: ignore[attr-defined]
    publisher = node.register_publisher("/plc_latched", STRING, latching=True)
    publisher.send(publisher.new(data="kept by the plc"))
    ros.until(lambda: "heard kept by the plc\n" in peer.text)


def test_parameters(ros: Ros, roscpp: Path) -> None:
    node = ros.node("plc")
    param = node.subscribe_param("/cpp_gain")
    node.set_param("/plc_gain", 1.5)
    peer = ros.start([str(roscpp / "latched")])
    ros.until(lambda: param.value == 2.5)
    ros.until(lambda: "gain 1.5\n" in peer.text)
    node.set_param("/plc_gain", 3.5)
    ros.until(lambda: "gain 3.5\n" in peer.text)
