"""Plays a bag to the programs of a controller, as ``plcsim replay BAG PROJECT`` does.

It waits until the programs are connected, plays every message at its recorded time, and then asks
for the end of the run. With a clock it publishes ``/clock``, the time in the bag.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from crosnode.messages import Time
from crosnode.plc.player import OWN, Player
from plcsim.core.duration import format_duration
from plcsim.core.logbook import Severity
from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from crosnode.node import CrosNode, Publisher
    from plcsim.core.traffic import Traffic
    from plcsim.recorder.bag.reading import BagReader

CLOCK: Final = "/clock"
CLOCK_NS: Final = 10_000_000
"""Between two messages of /clock; rosbag play has 100 Hz too."""

SETTLING_NS: Final = 500_000_000
"""As long as nothing new is subscribed to for so long, everything is."""

CONNECTED_NS: Final = 50_000_000
"""Between the last connection and the first message: the subscriber has to see it too."""

PATIENCE_NS: Final = 20_000_000_000
"""Without a subscriber for so long there will be none."""

PROGRESS: Final = 10
"""Lines of progress in one run through a bag."""

LONG_NS: Final = 60_000_000_000
"""A bag that takes longer has progress."""


class PlaybackState(Enum):
    """How far a playback is."""

    WAITING = auto()
    """Until programs subscribe."""
    CONNECTING = auto()
    PLAYING = auto()
    OVER = auto()


class Playback:
    """One run through a bag; `step` does what is due.

    Args:
        bag: that is played.
        node: publishes.
        subscribed: returns the topics that are subscribed to now.
        tell: takes lines for the logbook.
        topics: that are played; none for all that are subscribed to.
        with_clock: publish /clock.
        traffic: see `Player`.

    Attributes:
        state: how far it is.
        sent: messages so far.
    """

    def __init__(
        self,
        bag: BagReader,
        node: CrosNode,
        subscribed: Callable[[], Collection[str]],
        tell: Callable[[Severity, str], None],
        topics: Collection[str] = (),
        *,
        with_clock: bool = False,
        traffic: Traffic | None = None,
    ) -> None:
        self._bag = bag
        self._node = node
        self._subscribed = subscribed
        self._tell = tell
        self._topics = topics
        self._traffic = traffic
        self._known: frozenset[str] = frozenset()
        self._since_ns: int | None = None
        self._begun_ns = 0
        self._player: Player | None = None
        self._clock: Publisher | None = None
        self._clock_ns = 0
        self._told = 0
        self.state = PlaybackState.WAITING
        if with_clock:
            self._clock = node.register_publisher(CLOCK, "rosgraph_msgs/Clock")
            if traffic is not None:
                self._clock.hand_over = lambda node, body: traffic.hand_in(node, CLOCK, bytes(body))

    @property
    def sent(self) -> int:
        """Messages sent so far."""
        return self._player.sent if self._player else 0

    def step(self, now_ns: int) -> None:
        """Do what is due at this time of the controller's clock; an error of the bag ends it."""
        try:
            self._step(now_ns)
        except RecordingError as error:
            self._tell(Severity.ERROR, str(error))
            self.state = PlaybackState.OVER

    def _step(self, now_ns: int) -> None:
        if self._since_ns is None:
            self._since_ns = self._begun_ns = now_ns
        match self.state:
            case PlaybackState.WAITING:
                self._wait(now_ns, self._since_ns)
            case PlaybackState.CONNECTING:
                self._connect(now_ns)
            case PlaybackState.PLAYING:
                self._play(now_ns)
            case PlaybackState.OVER:
                pass
        if self.state is not PlaybackState.PLAYING:
            self._node.do_events_loop()

    def _wait(self, now_ns: int, since_ns: int) -> None:
        """Go on when all is subscribed to that will be."""
        there = {topic.name for topic in self._bag.topics if not topic.name.startswith(OWN)}
        found = frozenset(there & set(self._subscribed()))
        if found != self._known:
            self._known, self._since_ns = found, now_ns
        elif found and now_ns - since_ns >= SETTLING_NS:
            wanted = sorted(self._topics or found)
            self._player = Player(self._bag, self._node, wanted, self._traffic)
            self.state = PlaybackState.CONNECTING
            self._begun_ns = now_ns
        elif not found and now_ns - since_ns >= PATIENCE_NS:
            names = ", ".join(sorted(there)[:8]) or "none"
            raise RecordingError(
                f"{self._bag.path}: nobody subscribes to any of its topics: {names}"
            )

    def _connect(self, now_ns: int) -> None:
        player = self._player
        assert player is not None
        deaf = [
            f"{name} ({each.message_type.name})"
            for name, each in player.publishers.items()
            if name in self._known and not each.subscribers
        ]
        if deaf and now_ns - self._begun_ns >= PATIENCE_NS:
            raise RecordingError(
                f"{self._bag.path}: subscribers do not take {', '.join(deaf)}; "
                "is the type of the bag theirs?"
            )
        if deaf:
            self._since_ns = now_ns
        elif self._since_ns is None or now_ns - self._since_ns >= CONNECTED_NS:
            self.state = PlaybackState.PLAYING
            self._begun_ns = now_ns
            player.start(now_ns)
            names = ", ".join(player.publishers)
            long = format_duration(self._bag.end_ns - self._bag.start_ns)
            self._tell(Severity.INFORMATION, f"plays {self._bag.path.name}: {long}, {names}")
            self._play(now_ns)

    def _play(self, now_ns: int) -> None:
        player = self._player
        assert player is not None
        if self._clock is not None and now_ns >= self._clock_ns:
            self._clock_ns = now_ns + CLOCK_NS
            message = self._clock.new()
            message.clock = Time.from_ns(self._bag.start_ns + now_ns - self._begun_ns)
            self._clock.send(message)
        player.step(now_ns)
        self._tell_progress(now_ns)
        if player.is_over:
            self.state = PlaybackState.OVER
            self._tell(Severity.INFORMATION, f"{player.sent} messages of {self._bag.path.name}")

    def _tell_progress(self, now_ns: int) -> None:
        """Say in a long bag how far it is, ten times."""
        whole_ns = self._bag.end_ns - self._bag.start_ns
        if whole_ns < LONG_NS:
            return
        part = (now_ns - self._begun_ns) * PROGRESS // whole_ns
        if self._told < part < PROGRESS:
            self._told = part
            text = f"{part * 100 // PROGRESS} % of {self._bag.path.name}"
            self._tell(Severity.INFORMATION, f"{text}, {self.sent} messages")
