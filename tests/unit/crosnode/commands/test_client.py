"""What a process without a program sees of a network, and what it leaves there."""

import pytest

from crosnode.messages import MessageTypes
from crosnode.node import CrosNode
from plcsim.core.errors import PlcError

from ..node.world import OTHER_IP, STRING
from .network import Desk


def published(node: CrosNode, desk: Desk) -> None:
    node.register_publisher("/words", STRING)
    desk.world.until(lambda: node.is_registered)


def test_the_type_of_a_topic_is_that_of_its_publisher_whatever_is_known_here() -> None:
    desk = Desk()
    node = desk.world.node("talker")
    node.types = MessageTypes()
    text = "uint8 A=1\nInner[] inner\n" + "=" * 80 + "\nMSG: cell/Inner\nfloat32 x\n"
    node.types.define("cell/State", text)
    node.register_publisher("/state", "cell/State")
    desk.world.until(lambda: node.is_registered)
    found = desk.client().topic_type("/state")
    assert (found.name, found.md5sum) == ("cell/State", node.types.message("cell/State").md5sum)
    assert found.new(inner=[]).inner == []


def test_without_a_publisher_the_type_is_looked_up_here() -> None:
    desk = Desk()
    node = desk.world.node("listener")
    node.register_subscriber("/words", STRING)
    desk.world.until(lambda: node.is_registered)
    assert desk.client().topic_type("/words").name == STRING
    with pytest.raises(PlcError, match="/nothing: nobody publishes it or subscribes to it"):
        desk.client().topic_type("/nothing")


def test_the_type_of_a_service_is_told_by_its_provider() -> None:
    desk = Desk()
    node = desk.world.node("provider")
    node.register_service_provider("/set", "std_srvs/SetBool")
    desk.world.until(lambda: node.is_registered)
    assert desk.client().service_type("/set") == "std_srvs/SetBool"
    with pytest.raises(PlcError, match="no provider"):
        desk.client().service_type("/get")


def test_calls_alone_leave_no_node_and_a_node_takes_itself_back() -> None:
    desk = Desk()
    client = desk.client()
    client.call_master("getSystemState")
    client.close()
    assert desk.world.master
    assert "tool" not in str(desk.world.master.master.get_system_state("/x"))
    client = desk.client()
    client.node.register_publisher("/words", STRING)
    assert client.wait(lambda: client.node.is_registered)
    assert "/tool" in str(desk.world.master.master.get_system_state("/x"))
    client.close()
    assert "/tool" not in str(desk.world.master.master.get_system_state("/x"))


def test_a_master_that_is_not_there_is_told() -> None:
    desk = Desk(master=False)
    with pytest.raises(PlcError, match=r"no answer of the master at http://192\.168\.0\.1:11311/"):
        desk.client().call_master("getUri")


def test_a_peer_that_is_silent_is_not_waited_for_for_ever() -> None:
    desk = Desk()
    published(desk.world.node("talker", OTHER_IP), desk)
    desk.world.faults.silence(OTHER_IP)
    client = desk.client()
    uri = client.call_master("lookupNode", "/talker")
    with pytest.raises(PlcError, match="no answer of /talker"):
        client.call(uri, "getPid", whom="/talker")
