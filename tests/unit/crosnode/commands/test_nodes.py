"""``plcsim ros node``, ``service`` and ``param`` on a virtual network."""

import json

import pytest

from crosnode.commands.nodes import (
    call_service,
    delete_param,
    get_param,
    list_nodes,
    list_params,
    list_services,
    set_param,
    tell_node,
)
from plcsim.core.errors import PlcError

from ..node.world import OTHER_IP, STRING
from .network import Desk

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def desk() -> Desk:
    """A network where /provider negates and hears words of /talker."""
    desk = Desk()
    provider = desk.world.node("provider")
    service = provider.register_service_provider("/negate", "std_srvs/SetBool")
    talker = desk.world.node("talker", OTHER_IP)
    publisher = talker.register_publisher("/words", STRING)
    provider.register_subscriber("/words", STRING)

    def answer() -> None:
        if (request := service.pop()) is not None:
            if request.request.data:
                request.respond(success=False, message="no")
            else:
                request.fail("cannot")

    desk.world.steps.append(answer)
    desk.world.until(lambda: provider.is_registered and publisher.subscribers)
    return desk


def test_nodes(desk: Desk, capsys: Capture) -> None:
    desk.type(list_nodes)
    assert capsys.readouterr().out == "/provider\n/talker\n"


def test_a_node(desk: Desk, capsys: Capture) -> None:
    desk.type(tell_node, node="talker")
    out = capsys.readouterr().out
    for text in (
        "Node [/talker]\n\nPublications:\n * /rosout [rosgraph_msgs/Log]\n * /words [std_msgs/",
        "\nSubscriptions: None\n",
        "\nServices:\n * /talker/get_loggers\n * /talker/set_logger_level\n",
        "\nURI: http://192.168.0.20:",
        "\nPid: ",
        "\nConnections:\n * /words to /provider (TCPROS)\n",
    ):
        assert text in out
    with pytest.raises(PlcError, match=r"unknown node \[/nobody\]"):
        desk.type(tell_node, node="nobody")


def test_services(desk: Desk, capsys: Capture) -> None:
    desk.type(list_services)
    assert "/negate (/provider)\n" in capsys.readouterr().out
    desk.type(call_service, service="negate", value="true")
    assert capsys.readouterr().out == 'success: false\nmessage: "no"\n'
    with pytest.raises(PlcError, match="/negate: cannot"):
        desk.type(call_service, service="/negate", value="{}")
    with pytest.raises(PlcError, match="no provider"):
        desk.type(call_service, service="/nothing", value="{}")


def test_a_call_that_nobody_answers(desk: Desk) -> None:
    desk.world.steps.pop()
    with pytest.raises(PlcError, match="/negate: "):
        desk.type(call_service, service="/negate", value="{}")


def test_parameters(desk: Desk, capsys: Capture) -> None:
    desk.type(set_param, name="cell/speed", value="1.5")
    desk.type(set_param, name="/cell/names", value='["a", "b"]')
    desk.type(list_params)
    assert capsys.readouterr().out == "/cell/names\n/cell/speed\n"
    desk.type(get_param, name="/cell")
    assert json.loads(capsys.readouterr().out) == {"speed": 1.5, "names": ["a", "b"]}
    desk.type(delete_param, name="/cell/names")
    desk.type(get_param, name="/")
    assert json.loads(capsys.readouterr().out) == {"cell": {"speed": 1.5}}
    with pytest.raises(PlcError, match="is not set"):
        desk.type(get_param, name="/nothing")
