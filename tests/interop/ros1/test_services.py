"""Services and parameters with rospy, roscpp and the tools."""

from pathlib import Path

import pytest

from crosnode.node import CrosNode

from .rig import Ros

SET_BOOL = "std_srvs/SetBool"


def provide(ros: Ros, node: CrosNode) -> None:
    provider = node.register_service_provider("/plc_set", SET_BOOL)

    def answer() -> None:
        if (request := provider.pop()) is None:
            return
        if request.request.data:  # type: ignore[attr-defined]
            request.respond(success=True, message="from the cycle")
        else:
            request.fail("not today")

    ros.steps.append(answer)
    ros.until(lambda: node.is_registered)


@pytest.mark.parametrize("act", ["call", "call_persistent"])
def test_rospy_calls_us(ros: Ros, act: str) -> None:
    provide(ros, ros.node("plc"))
    peer = ros.rospy(act, "/plc_set")
    ros.until(lambda: not peer.is_running)
    assert peer.text.count("answer from the cycle") == 2
    assert "not today" in peer.text


@pytest.mark.parametrize("persistent", [False, True])
def test_we_call_rospy(ros: Ros, persistent: bool) -> None:
    node = ros.node("plc")
    caller = node.register_service_caller("/py_set", SET_BOOL, persistent=persistent)
    ros.rospy("serve", "/py_set")
    ros.until(lambda: "/py_set" in ros.tool("rosservice", "list"))
    for data in (True, False, True):
        caller.call(caller.new(data=data))
    ros.until(lambda: len(caller.replies) == 3)
    first, second, third = (caller.pop() for _ in range(3))
    assert first
    assert first.response.message == "rospy"  # type: ignore[union-attr]
    assert second
    assert "I will not" in second.error
    assert third
    assert third.response


def test_roscpp_both_ways(ros: Ros, roscpp: Path) -> None:
    node = ros.node("plc")
    provide(ros, node)
    peer = ros.start([str(roscpp / "services")])
    ros.until(lambda: len(peer.text.splitlines()) >= 6)
    assert peer.text.splitlines() == ["0 1 from the cycle"] * 3 + ["1 1 from the cycle"] * 3
    for persistent in (False, True):
        caller = node.register_service_caller("/cpp_set", SET_BOOL, persistent=persistent)
        for _ in range(3):
            caller.call(caller.new(data=True))
        ros.until(lambda c=caller: len(c.replies) == 3)
        replies = [caller.pop() for _ in range(3)]
        assert [r.response.message for r in replies if r and r.response] == ["roscpp"] * 3  # type: ignore[attr-defined]


def test_rosservice(ros: Ros) -> None:
    provide(ros, ros.node("plc"))
    assert "/plc_set" in ros.tool("rosservice", "list")
    assert ros.tool("rosservice", "type", "/plc_set").strip() == SET_BOOL
    assert "from the cycle" in ros.tool("rosservice", "call", "/plc_set", "true")
    assert "not today" in ros.tool("rosservice", "call", "/plc_set", "false")


def test_parameters_with_rosparam(ros: Ros) -> None:
    node = ros.node("plc")
    param = node.subscribe_param("/gains")
    ros.until(lambda: node.is_registered)
    ros.tool("rosparam", "set", "/gains", "{p: 1.5, i: [1, 2], name: a<b & c}")
    ros.until(lambda: param.value == {"p": 1.5, "i": [1, 2], "name": "a<b & c"})
    ros.tool("rosparam", "set", "/gains/p", "1.0e-09")
    ros.until(lambda: param.value["p"] == 1e-09)
    node.set_param("/from_plc", {"deep": {"list": [True, "x", 3]}})
    ros.until(lambda: "list:" in ros.tool("rosparam", "get", "/from_plc/deep"))
    assert "/from_plc/deep/list" in ros.tool("rosparam", "list")
    ros.tool("rosparam", "delete", "/gains")
    ros.until(lambda: param.value == {})
