"""Calls /add_two_ints ten times a second and checks the answers."""

from crosnode.node import CrosNode, ServiceCaller
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import LREAL, UDINT, var

LOOP_PERIOD_NS = 100_000_000


class Caller(Program):
    """Adds up by a service: 1 + 1, 2 + 2, 3 + 3 and so on."""

    __slots__ = ("add", "node")

    node: CrosNode
    add: ServiceCaller

    asked = var(UDINT)
    right = var(UDINT)
    failed = var(UDINT)
    last = var(LREAL)

    def init(self) -> None:
        """Make the node; the provider is looked up with the first call."""
        self.node = create_node(self.context, "add_two_ints_client")
        self.add = self.node.register_service_caller(
            "add_two_ints",
            "roscpp_tutorials/TwoInts",
            persistent=True,
            loop_period_ns=LOOP_PERIOD_NS,
        )

    def cyclic(self) -> None:
        """Do one step of the node, ask when it is time, take the answers."""
        self.node.do_events_loop()
        request = self.add.pop_packet()
        if request is not None:
            self.asked += 1
            request.a = request.b = self.asked
            self.add.call(request)
        while (reply := self.add.pop()) is not None:
            if reply.response is None:
                self.failed += 1
            else:
                self.right += 1
                self.last = reply.response.sum

    def exit(self) -> None:
        """Take the registrations back."""
        self.node.destroy()
