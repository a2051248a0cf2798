"""``plcsim ros`` beside rospy's nodes and both masters."""

import re
import sys

from .rig import PATIENCE_S, Ros


def typed(ros: Ros, *arguments: str, seconds: float = PATIENCE_S) -> str:
    """Type ``plcsim ros ...``; return what it says."""
    command = [sys.executable, "-m", "plcsim.cli.main", "ros", *arguments]
    process = ros.start(["timeout", str(seconds), *command])
    ros.until(lambda: not process.is_running, seconds + 5)
    return process.text


def test_topics_of_rospy(ros: Ros) -> None:
    peer = ros.rospy("talk", "/chatter")
    ros.until(lambda: "/chatter [std_msgs/String]" in typed(ros, "topic", "list"))
    assert "/rospy_talk" in typed(ros, "topic", "info", "/chatter")
    assert typed(ros, "topic", "echo", "/chatter", "-n", "2").count('data: "rospy ') == 2

    def is_as_fast() -> bool:
        """Whether it is so in some second; the host may hold one of us up in others."""
        told = typed(ros, "topic", "hz", "/chatter", "--for", "3s")
        return any(45 < float(r) < 55 for r in re.findall(r"average rate: ([\d.]+)", told))

    ros.until(is_as_fast)
    name = re.search(r"/rospy_talk\S*", typed(ros, "node", "list"))
    assert name
    info = typed(ros, "node", "info", name[0])
    assert " * /chatter [std_msgs/String]" in info
    assert "Pid: " in info
    assert peer.is_running


def test_a_word_to_rospy(ros: Ros) -> None:
    peer = ros.rospy("listen", "/words")
    ros.until(lambda: "/words" in typed(ros, "topic", "list"))
    typed(ros, "topic", "pub", "-1", "/words", "std_msgs/String", "from plcsim")
    ros.until(lambda: "heard from plcsim" in peer.text)


def test_a_service_of_rospy_and_parameters(ros: Ros) -> None:
    ros.rospy("serve", "/set")
    ros.until(lambda: "/set (" in typed(ros, "service", "list"))
    assert typed(ros, "service", "call", "/set", "true") == 'success: true\nmessage: "rospy"\n'
    assert "I will not" in typed(ros, "service", "call", "/set", "false")
    typed(ros, "param", "set", "/speed", "1.5")
    assert ros.tool("rosparam", "get", "/speed").strip() == "1.5"
    assert typed(ros, "param", "get", "/speed") == "1.5\n"
