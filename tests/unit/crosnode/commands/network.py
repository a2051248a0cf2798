"""A client of ``plcsim ros`` on a virtual network, beside nodes and a master."""

from argparse import Namespace
from collections.abc import Callable

from crosnode.commands.client import RosClient
from crosnode.graph.arguments import node_settings
from crosnode.messages import MessageTypes

from ..node.world import MASTER_IP, World

IP = "192.168.0.50"
Act = Callable[[RosClient, Namespace], None]


class Desk:
    """Somebody who types commands."""

    def __init__(self, *, master: bool = True) -> None:
        self.world = World(master=master)
        self.world.net.host(MASTER_IP)
        self.world.run(1)

    def client(self) -> RosClient:
        context = self.world.context(IP)
        settings = node_settings("tool", (), {"ROS_MASTER_URI": self.world.master_uri}, host=IP)
        return RosClient(context, settings, MessageTypes(), lambda: self.world.run(1))

    def type(self, act: Act, **options: object) -> None:
        client = self.client()
        try:
            act(client, Namespace(**options))
        finally:
            client.close()
