"""Nodes of programs in a project without a table [ros]: the environment counts."""

import pytest

from crosnode.project import SharedTypes, create_node, surroundings
from plcsim.context import Context
from plcsim.memory import Memory
from plcsim.network import VirtualNetwork


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
