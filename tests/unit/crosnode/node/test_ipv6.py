"""Nodes and a master that reach each other by IPv6."""

import pytest

from crosnode.graph.hosts import parse_hosts
from crosnode.master.server import MasterOptions, MasterServer
from crosnode.node import CrosNode
from crosnode.node.service_provider import ServiceProvider

from .world import STRING, World, words

MASTER, PLC, OTHER = "fd00::1", "fd00::10", "fd00::20"
NAMES = parse_hosts(f"{MASTER} master\n{PLC} plc\n{OTHER} other\n")


class Ipv6World(World):
    """A net of IPv6 alone."""

    def start_master(self, **options: object) -> MasterServer:
        server = MasterServer(self.context(MASTER), MasterOptions(host=MASTER, hosts=NAMES))
        self.steps.append(server.step)
        self.master_uri = server.uri
        return server


def answer(world: World, provider: ServiceProvider) -> None:
    def answered() -> bool:
        request = provider.pop()
        if request is not None:
            request.respond(success=True, message="done")
        return request is not None

    world.until(answered)


def flow(world: World, talker: CrosNode, listener: CrosNode) -> None:
    publisher = talker.register_publisher("/chatter", STRING)
    subscriber = listener.register_subscriber("/chatter", STRING)
    provider = listener.register_service_provider("/add", "std_srvs/Trigger")
    caller = talker.register_service_caller("/add", "std_srvs/Trigger")
    value = talker.set_param("/x", 5)
    world.until(lambda: publisher.subscribers and talker.is_registered and value.value == 0)
    publisher.send(publisher.new(data="six"))
    caller.call(caller.new())
    answer(world, provider)
    assert words(subscriber.pop) == ["six"]
    world.until(lambda: caller.replies)
    reply = caller.pop()
    assert reply is not None
    assert reply.response is not None
    assert reply.response.message == "done"


def test_by_number() -> None:
    world = Ipv6World()
    assert world.master_uri == "http://[fd00::1]:11311/"
    talker, listener = world.node("talker", PLC), world.node("listener", OTHER)
    assert talker.uri.startswith("http://[fd00::10]:")
    flow(world, talker, listener)
    (link,) = talker.publishers["/chatter"].links
    assert link.peer.startswith("[fd00::20]:")


@pytest.mark.parametrize("uri", ["http://master:11311", "http://FD00:0:0::1:11311/"])
def test_by_name_and_without_brackets(uri: str) -> None:
    world = Ipv6World()
    nodes = []
    for name, ip, host in (("talker", PLC, "plc"), ("listener", OTHER, "other")):
        environment = {"ROS_MASTER_URI": uri, "ROS_HOSTNAME": host}
        node = world.node(name, ip, environment=environment, hosts=NAMES, ipv6=True)
        assert node.uri.startswith(f"http://{host}:")
        nodes.append(node)
    flow(world, *nodes)
