"""What one step of a node may do at most.

Each kind of work has a bound of its own, and all of it together has one: ``work``. Its unit is the
time that a byte of a topic takes; work that moves few bytes has a price in this unit, as measured
at a tick of 1 ms by benchmarks/node_step.py (docs/decisions/0005-the-step-is-bounded-by-counts.md).
"""

from __future__ import annotations

from typing import Final, NamedTuple

POLL_WORK: Final = 1_024
"""Price of looking at a connection."""

LARGE_SHARE: Final = 1
"""Bytes of a large message, which go between the socket and their place without a copy in pieces
of up to a mebibyte, that cost as much as one byte of others. Mostly seven do; but how fast memory
is moves with what else the host does, and a message now and then may as well take more steps."""

STREAM_SHARE: Final = 7
"""The same in a node that large messages reach or leave without a pause: there each step takes what
it can, so that all of them get through."""

FRESH_WORK: Final = 2
"""Price of a byte of a large message that goes to memory which the system has yet to lay out: the
first of a connection. A page takes 5 to 10 us on a virtual machine."""

LARGE_WORK: Final = 49_152
"""Price of a large message that was not expected: its length is read apart, and it gets room."""

TRANSFER_WORK: Final = 12_288
"""Price of a read that gave bytes and of a write, beside the bytes."""

MESSAGE_WORK: Final = 608
"""Price of a message of a topic that comes in, beside its bytes."""

REQUEST_WORK: Final = 4_096
"""Price of a request or a reply of a service, beside its bytes."""

START_WORK: Final = 65_536
"""Price of a connection that is begun: what it is in this program."""

CONNECT_WORK: Final = 114_688
"""Price of a socket that is opened and begins to connect."""

CONNECTED_WORK: Final = 57_344
"""Price of a connection that is seen to be there."""

ACCEPT_WORK: Final = 65_536
"""Price of a connection that is taken."""

QUIET_WORK: Final = 98_304
"""Work that a step has left where it does what has time, such as options behind the first."""

OPTION_WORK: Final = 20_480
"""Price of an option that is set on a socket."""

HEADER_WORK: Final = 98_304
"""Price of the header of a connection that is read, and answered."""

END_WORK: Final = 65_536
"""Price of a connection that is ended."""

CALL_WORK: Final = 81_920
"""Price of an XML-RPC call that is made, beside its writing."""

PART_WORK: Final = 57_344
"""Price of the HTTP head of an XML-RPC call or answer, or of some of its XML."""

COLD_PART_WORK: Final = 114_688
"""The same of the first part of one whose like was long ago: the processor reads the code for it
from memory."""

ANSWER_WORK: Final = 131_072
"""Price of an XML-RPC call that is answered, behind what is read of it."""

ANSWERED_WORK: Final = 65_536
"""Price of an answer that is taken, behind what is read of it."""

ALONE_WORK: Final = 131_072
"""Price of work that has a millisecond of cycle to itself: part of an XML-RPC call whose like was
long ago, for which the processor has to read all its code from memory."""


class StepLimits(NamedTuple):
    """Bounds of one step; what does not fit waits for the next, in turn.

    Attributes:
        bytes_in: bytes read from topic and service connections.
        bytes_out: bytes written.
        bytes_parsed: bytes read from XML-RPC connections, which cost most to parse.
        messages: messages, requests, replies and calls taken from what was read.
        accepts: new connections taken.
        calls: connections started: to publishers, services and other nodes.
        polls: connections looked at, and messages written outside of a look.
        work: all of it together, at the prices above.
    """

    bytes_in: int = 1_048_576
    bytes_out: int = 1_048_576
    bytes_parsed: int = 8_192
    messages: int = 256
    accepts: int = 4
    calls: int = 4
    polls: int = 32
    work: int = ALONE_WORK


UNPACED = StepLimits(
    bytes_in=4 << 20, bytes_out=4 << 20, bytes_parsed=1 << 20, messages=10_000, accepts=100,
    calls=100, polls=200, work=64 << 20,
)  # fmt: skip
"""Limits of a node that owns its process, such as a benchmark, where a long step hurts nobody."""


class StepBudget:
    """What is left of the limits within a step.

    Args:
        limits: of the step.
        large_share: bytes of a large message for the price of one byte of others.

    Attributes:
        is_short: whether something had to wait for the next step.
        large: bytes of large messages that were moved.
    """

    __slots__ = (*StepLimits._fields, "_untouched", "is_short", "large", "large_share")

    bytes_in: int
    bytes_out: int
    bytes_parsed: int
    messages: int
    accepts: int
    calls: int
    polls: int
    work: int

    def __init__(self, limits: StepLimits, large_share: int = LARGE_SHARE) -> None:
        (self.bytes_in, self.bytes_out, self.bytes_parsed, self.messages, self.accepts,
         self.calls, self.polls, self.work) = limits  # fmt: skip
        self._untouched = limits.work - POLL_WORK * limits.polls
        self.is_short = False
        self.large = 0
        self.large_share = large_share

    @property
    def is_stream(self) -> bool:
        """Whether large messages come or go without a pause."""
        return self.large_share == STREAM_SHARE

    def affords(self, price: int) -> bool:
        """Whether work of a price may begin: it fits, or nothing but looks was done before.

        So even the dearest work has its turn, in a step that begins with it.
        """
        if self.may_begin(price):
            return True
        self.is_short = True
        return False

    def may_begin(self, price: int) -> bool:
        """As ``affords``, for work that is not missed where it may not."""
        return self.work >= price or self.work - POLL_WORK * self.polls >= self._untouched

    def at_most(self, size: int) -> int:
        """Return how many of ``size`` bytes may be moved, by the work that is left."""
        return self._allowed(min(size, self.work))

    def at_most_large(self, size: int, *, is_fresh: bool = False) -> int:
        """Return how many of ``size`` bytes of a large message may be moved.

        Args:
            size: bytes.
            is_fresh: whether they go to memory that is yet to be laid out.
        """
        work = self.work - TRANSFER_WORK if self.work > 2 * TRANSFER_WORK else self.work
        most = work // FRESH_WORK if is_fresh else work * self.large_share
        return self._allowed(min(size, most))

    def take_large(self, size: int, *, is_fresh: bool = False) -> None:
        """Take the price of so many bytes of a large message, moved at once; arguments as above."""
        self.large += size
        price = size * FRESH_WORK if is_fresh else size // self.large_share
        self.work -= TRANSFER_WORK + price

    def _allowed(self, allowed: int) -> int:
        if allowed <= 0:
            self.is_short = True
        return allowed

    def start_call(self) -> bool:
        """Take the price of starting a connection; False where it must wait."""
        if self.calls <= 0 or not self.affords(START_WORK):
            return False
        self.calls -= 1
        self.work -= START_WORK
        return True
