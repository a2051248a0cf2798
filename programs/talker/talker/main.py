"""The talker of the thesis: a publisher of prova/hello on /chatter.

Once a second the node asks for a message; the program pops it, fills it and sends it. That is the
callback of figure 1.22, inverted as in figure 1.21.
"""

from crosnode.node import CrosNode, Publisher
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import STRING, UDINT, var

LOOP_PERIOD_NS = 1_000_000_000


class Talker(Program):
    """Says a word once a second."""

    __slots__ = ("chatter", "node")

    node: CrosNode
    chatter: Publisher

    word = var(STRING(80), "Hello world!!!")
    sent = var(UDINT)
    subscribers = var(UDINT)

    def init(self) -> None:
        """Make the node and register the publisher; nothing waits for the master."""
        self.node = create_node(self.context, "talker_cros")
        self.chatter = self.node.register_publisher(
            "/chatter", "prova/hello", loop_period_ns=LOOP_PERIOD_NS
        )

    def cyclic(self) -> None:
        """Do one step of the node, then what it asks for."""
        self.node.do_events_loop()
        message = self.chatter.pop()
        if message is not None:
            message.aWord = self.word
            self.chatter.send(message)
            self.sent = self.chatter.sent
        self.subscribers = self.chatter.subscribers

    def exit(self) -> None:
        """Take the registrations back."""
        self.node.destroy()
