"""ROS time: the controller's clock moved to the epoch, or ``/clock`` with ``/use_sim_time``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from crosnode.errors import DecodeError, InvalidNameError
from crosnode.node.status import StatusKind
from crosnode.xmlrpc.api_caller import CallState

if TYPE_CHECKING:
    from crosnode.node.node import CrosNode
    from crosnode.node.subscriber import QueuedMessage, Subscriber
    from crosnode.xmlrpc.api_caller import ApiCall

CLOCK: Final = "rosgraph_msgs/Clock"

QUICK_NS: Final = 50_000
"""Nanoseconds that reading a clock takes at most, where nothing comes in between."""


class Epoch:
    """What turns the controller's clock into the time of day, for all nodes of a controller.

    Attributes:
        ns: added to a release gives nanoseconds since 1970.
    """

    __slots__ = ("ns",)

    def __init__(self, ns: int = 0) -> None:
        self.ns = ns

    def follow(self, before_ns: int, wall_ns: int, after_ns: int) -> None:
        """Take the wall clock's time, so that a clock that was set is followed.

        Args:
            before_ns: the controller's clock before the wall clock was read.
            wall_ns: the wall clock, nanoseconds since 1970.
            after_ns: the controller's clock afterwards; where too much time lies between the two,
                the reading says too little and is not taken.
        """
        if after_ns - before_ns <= QUICK_NS:
            self.ns = wall_ns - (before_ns + after_ns) // 2


class RosTime:
    """Tells the time of ROS.

    Args:
        node: whose time it is.
        epoch: of its controller.

    Attributes:
        is_simulated: whether ``/use_sim_time`` is set; time is 0 until ``/clock`` comes.
    """

    def __init__(self, node: CrosNode, epoch: Epoch) -> None:
        self.is_simulated = False
        self._node = node
        self._epoch = epoch
        self._simulated_ns = 0
        self._clock: Subscriber | None = None
        self._seen: QueuedMessage | None = None
        self._question: ApiCall | None = None
        self._is_known = False

    def now_ns(self, release_ns: int) -> int:
        """Return nanoseconds since 1970, or of simulated time."""
        return self._simulated_ns if self.is_simulated else self._epoch.ns + release_ns

    def step(self) -> None:
        """Ask the master once whether time is simulated, then follow ``/clock``."""
        if not self._is_known:
            self._ask()
        elif self._clock is not None:
            self._look(self._clock)

    def _look(self, clock: Subscriber) -> None:
        """Take the newest message and leave it in the queue, which may be the program's."""
        packet = clock.queue.newest
        if packet is None or packet is self._seen:
            return
        self._seen = packet
        body, peer = packet
        try:
            self._simulated_ns = clock.message_type.decode(body).clock.to_ns()
        except DecodeError as error:
            if peer is not None:
                peer.drop(str(error))

    def _ask(self) -> None:
        question = self._question
        if question is None:
            if self._node.core.master.is_calm:
                self._question = self._node.get_param("/use_sim_time")
        elif question.state is not CallState.WAITING:
            self._question = None
            self._is_known = question.was_answered
            self._use(question.state is CallState.DONE and question.value is True)

    def _use(self, is_simulated: bool) -> None:  # a setter
        self.is_simulated = is_simulated
        if not is_simulated or self._clock is not None:
            return
        node = self._node
        try:
            self._clock = node.register_subscriber("/clock", CLOCK, queue_size=1)
        except InvalidNameError as error:  # the program subscribes to it as well
            found = [s for s in node.subscribers.values() if s.message_type.name == CLOCK]
            self._clock = found[0] if found else None
            if not found:
                node.core.tell(StatusKind.REGISTRATION_REFUSED, "/clock", str(error))
