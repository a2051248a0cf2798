"""Provides /add_two_ints: each cycle answers what was asked, at most ten requests."""

from crosnode.node import CrosNode, ServiceProvider
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import UDINT, var

ANSWERED_PER_CYCLE = 10
LOWEST, HIGHEST = -(2**63), 2**63 - 1


class Provider(Program):
    """Adds two integers."""

    __slots__ = ("add", "node")

    node: CrosNode
    add: ServiceProvider

    answered = var(UDINT)

    def init(self) -> None:
        """Make the node and register the service."""
        self.node = create_node(self.context, "add_two_ints_server")
        self.add = self.node.register_service_provider("add_two_ints", "roscpp_tutorials/TwoInts")

    def cyclic(self) -> None:
        """Do one step of the node, then answer."""
        self.node.do_events_loop()
        for _ in range(ANSWERED_PER_CYCLE):
            request = self.add.pop()
            if request is None:
                return
            total = request.request.a + request.request.b
            if LOWEST <= total <= HIGHEST:
                request.respond(sum=total)
            else:
                request.fail(f"{total} does not fit into 64 bits")
            self.answered += 1

    def exit(self) -> None:
        """Take the registration back."""
        self.node.destroy()
