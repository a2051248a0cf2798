"""A subscriber of prova/hello on /chatter: the last word and a count are tags."""

from crosnode.messages import to_latin1
from crosnode.node import CrosNode, LogLevel, Subscriber
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import STRING, UDINT, var


class Listener(Program):
    """Hears words, and says on /rosout which."""

    __slots__ = ("chatter", "node")

    node: CrosNode
    chatter: Subscriber

    word = var(STRING(80))
    heard = var(UDINT)
    lost = var(UDINT)

    def init(self) -> None:
        """Make the node and register the subscriber; nothing waits for the master."""
        self.node = create_node(self.context, "listener_cros")
        self.chatter = self.node.register_subscriber("/chatter", "prova/hello", queue_size=1000)

    def cyclic(self) -> None:
        """Do one step of the node, then take what has come."""
        self.node.do_events_loop()
        while (message := self.chatter.pop()) is not None:
            self.word = to_latin1(message.aWord)
            self.heard += 1
            self.node.log(LogLevel.INFO, f"I heard: [{message.aWord}]")
        self.lost = self.chatter.dropped

    def exit(self) -> None:
        """Take the registration back."""
        self.node.destroy()
