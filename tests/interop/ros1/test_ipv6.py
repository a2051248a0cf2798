"""IPv6 with rospy, roscpp and rosmaster (ROS_IPV6=on), by number and by name.

By number rospy has topics only: it splits ``rosrpc://::1:port`` at each colon. roscpp wants names
for all, which the processes of a test find in an /etc/hosts of their own.
"""

import socket
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from .rig import Ros, in_own_namespace, ros_system

if TYPE_CHECKING:
    from crosnode.messages.message import Message

HOSTS = "127.0.0.1 localhost\n::1 six.lan\n"


@pytest.fixture(autouse=True)
def _ipv6() -> None:
    try:
        with socket.socket(socket.AF_INET6) as probe:
            probe.bind(("::1", 0))
    except OSError:
        pytest.skip("this host has no IPv6")


@pytest.fixture(name="six", params=["rosmaster", "plcsim"])
def _six(request: pytest.FixtureRequest, tmp_path: Path, rospy_installed: None) -> Iterator[Ros]:
    with ros_system(request.param, tmp_path, host="::1") as system:
        yield system


@pytest.fixture(name="named", params=["rosmaster", "plcsim"])
def _named(request: pytest.FixtureRequest, tmp_path: Path, rospy_installed: None) -> Iterator[Ros]:
    probe = [*in_own_namespace(Path("/etc/hosts")), "true"]
    if subprocess.run(probe, capture_output=True, check=False).returncode:
        pytest.skip("no right to mount another /etc/hosts")
    with ros_system(request.param, tmp_path, host="six.lan", hosts=HOSTS) as system:
        yield system


def test_topics_of_rospy_by_number(six: Ros) -> None:
    assert six.uri.startswith("http://[::1]:")
    node = six.node("plc")
    subscriber = node.register_subscriber("/in", "std_msgs/String")
    publisher = node.register_publisher("/out", "std_msgs/String", loop_period_ns=20_000_000)
    heard: list[str] = []

    def cycle() -> None:
        if (message := subscriber.pop()) is not None:
            heard.append(message.data)
        if (ours := publisher.pop()) is not None:
            ours.data = "ours"
            publisher.send(ours)

    six.steps.append(cycle)
    six.rospy("talk", "/in")
    listener = six.rospy("listen", "/out")
    six.until(lambda: heard and "heard ours" in listener.text)
    assert heard[0].startswith("rospy ")
    (link,) = publisher.links
    assert link.peer.startswith("[::1]:")


def test_tools_by_number(six: Ros) -> None:
    six.node("plc").register_publisher("/out", "std_msgs/String")
    six.until(lambda: "/plc" in six.tool("rosnode", "list"))
    assert "* /out" in six.tool("rosnode", "info", "/plc")
    assert "xmlrpc reply" in six.tool("rosnode", "ping", "-c", "1", "/plc")


def test_rospy_by_name(named: Ros) -> None:
    node = named.node("plc")
    assert node.uri.startswith("http://six.lan:")
    provider = node.register_service_provider("/ours", "std_srvs/SetBool")
    caller = node.register_service_caller("/theirs", "std_srvs/SetBool")
    replies: list[Message] = []

    def cycle() -> None:
        if (request := provider.pop()) is not None:
            request.respond(success=True, message="six")
        if (reply := caller.pop()) is not None and reply.response is not None:
            replies.append(reply.response)

    named.steps.append(cycle)
    named.rospy("serve", "/theirs")
    client = named.rospy("call", "/ours")
    named.until(lambda: "answer six" in client.text)
    named.until(lambda: "/theirs" in named.tool("rosservice", "list"))
    caller.call(caller.new(data=True))
    named.until(lambda: replies)
    assert replies[0].message == "rospy"


def test_roscpp_by_name(named: Ros, roscpp: Path) -> None:
    node = named.node("plc")
    publisher = node.register_publisher("/chatter", "prova/hello", loop_period_ns=20_000_000)
    number = 0

    def cycle() -> None:
        nonlocal number
        if (message := publisher.pop()) is not None:
            number += 1
            message.aWord = f"six {number}"
            publisher.send(message)

    named.steps.append(cycle)
    listener = named.start([str(roscpp / "listener")])
    named.until(lambda: "six 5" in listener.text)
    (link,) = publisher.links
    assert link.peer.startswith("[::1]:")
