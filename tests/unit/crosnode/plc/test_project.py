"""Nodes of programs in a project without a table [ros]: the environment counts."""

import time
from collections.abc import Mapping
from pathlib import Path

import pytest

from crosnode.node.ros_time import Epoch
from crosnode.plc.project import RosContext, SharedTypes, create_node, surroundings
from crosnode.plc.settings import read_settings
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.network import OsNetwork, VirtualNetwork
from plcsim.settings.table import Table


def test_without_a_table_the_environment_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", "http://10.0.0.1:5/")
    monkeypatch.setenv("ROS_NAMESPACE", "/cell")
    context = Context(Memory(), VirtualNetwork(lambda: 0).host("10.0.0.2"))
    assert surroundings(context) is None
    node = create_node(context, "x", "__name:=y")
    assert node.name == "/cell/y"
    assert node.core.master.uri == "http://10.0.0.1:5/"


def test_nodes_of_one_controller_share_their_types() -> None:
    context = Context(Memory(), VirtualNetwork(lambda: 0).host("10.0.0.2"))
    one, two = create_node(context, "one"), create_node(context, "two")
    assert one.types is two.types is context.library(SharedTypes)


def test_the_namespace_of_the_table_goes_before_the_environment_that_before_the_program() -> None:
    def name(namespace: str, environment: Mapping[str, str]) -> str:
        context = Context(Memory(), VirtualNetwork(lambda: 0).host("10.0.0.2"))
        values = {"namespace": namespace} if namespace else {}
        settings = read_settings(Table(Path("plc.toml"), "ros", values), environment)
        context.give_settings(RosContext(settings, Epoch(), lambda: 0))
        return create_node(context, "x", namespace="/mine").name

    assert name("/table", {"ROS_NAMESPACE": "/desk"}) == "/table/x"
    assert name("", {"ROS_NAMESPACE": "/desk"}) == "/desk/x"
    assert name("", {}) == "/mine/x"


def test_beside_a_node_in_exit_goes_on_what_a_test_has_there() -> None:
    context = Context(Memory(), VirtualNetwork(lambda: 0).host("10.0.0.2"))
    settings = read_settings(Table(Path("plc.toml"), "ros", {}), {})
    steps: list[int] = []
    found = RosContext(settings, Epoch(), lambda: 0)
    context.give_settings(found)
    node = create_node(context, "x")
    context.give_settings(found._replace(beside=lambda: steps.append(1)))
    node.set_param("/a", 1)  # waits for the master
    node.destroy(steps=3)
    assert steps


def test_without_a_table_time_is_that_of_the_host_on_its_network_and_0_on_a_virtual_one() -> None:
    real = Context(Memory(), OsNetwork())
    real.release_ns = time.monotonic_ns()
    node = create_node(real, "x")
    assert abs(node.now_ns - time.time_ns()) < 10**10
    node.core.loop.close(0)
    virtual = Context(Memory(), VirtualNetwork(lambda: 0).host("10.0.0.2"))
    assert create_node(virtual, "x").now_ns == virtual.release_ns


def test_bounds_of_steps_and_of_what_comes_in_are_those_of_the_table() -> None:
    context = Context(Memory(), VirtualNetwork(lambda: 0).host("10.0.0.2"))
    values = {
        "step": {"messages": 7},
        "limits": {"message": "1MiB", "parameter": "8MiB", "service_timeout": "2s"},
    }
    settings = read_settings(Table(Path("plc.toml"), "ros", values), {})
    context.give_settings(RosContext(settings, Epoch(), lambda: 0))
    options = create_node(context, "x").options
    assert options.step == {"messages": 7}
    assert (options.tcpros.max_message, options.tcpros.timeout_ns) == (1 << 20, 2_000_000_000)
    assert options.xmlrpc.values.max_size == 8 << 20


def test_a_node_is_of_ipv6_where_the_environment_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_IPV6", "on")
    monkeypatch.delenv("ROS_IP", raising=False)
    monkeypatch.delenv("ROS_HOSTNAME", raising=False)
    context = Context(Memory(), VirtualNetwork(lambda: 0).host("fd00::2"))
    assert create_node(context, "x").uri.startswith("http://[::1]:")
