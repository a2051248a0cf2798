"""What TCP and UDP have in common, in a run that is recorded and in one that is replayed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar

from plcsim.network import Address, DatagramSocket, OptionValue, Outcome, Socket
from plcsim.network.protocol import NO_ADDRESS
from plcsim.recorder.journal.answers import (
    I64,
    NOTHING,
    OUTCOMES,
    address_from,
    address_text,
    heads,
    i64_from,
)

if TYPE_CHECKING:
    from plcsim.network import Option
    from plcsim.recorder.journal.feed import Feed

_CONNECT, _SET_OPTION, _OPTION = map(heads, (b"c", b"t", b"p"))
_LOCAL, _PEER, _CLOSE = b"h", b"e", b"x"

_AnySocket = TypeVar("_AnySocket", bound=Socket | DatagramSocket)


class RecordedPort(Generic[_AnySocket]):
    """A socket whose answers go into the journal; for what its calls do see `Socket`.

    Args:
        socket: answers.
        answers: those of the cycle so far.
    """

    def __init__(self, socket: _AnySocket, answers: bytearray) -> None:
        self._socket = socket
        self._answers = answers

    @property
    def local(self) -> Address:
        """See `Socket`."""
        value = self._socket.local
        self._answers += _LOCAL + NOTHING + address_text(value)
        return value

    @property
    def peer(self) -> Address | None:
        """See `Socket`."""
        value = self._socket.peer
        self._answers += _PEER + NOTHING + address_text(value)
        return value

    def connect(self, peer: Address) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.connect(peer)
        self._answers += _CONNECT[outcome]
        return outcome

    def close(self) -> None:
        """See `Socket`."""
        self._socket.close()
        self._answers += _CLOSE + NOTHING

    def set_option(self, option: Option, value: int) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.set_option(option, value)
        self._answers += _SET_OPTION[outcome]
        return outcome

    def option(self, option: Option) -> OptionValue:
        """See `Socket`."""
        answer = self._socket.option(option)
        self._answers += _OPTION[answer.outcome] + I64.pack(answer.value)
        return answer


class ReplayPort:
    """A socket that answers what was recorded."""

    def __init__(self, feed: Feed) -> None:
        self._feed = feed

    def _outcome(self, call: bytes) -> Outcome:
        return OUTCOMES[self._feed.answer(call)]

    @property
    def local(self) -> Address:
        """See `Socket`."""
        self._feed.answer(_LOCAL)
        return address_from(self._feed) or NO_ADDRESS

    @property
    def peer(self) -> Address | None:
        """See `Socket`."""
        self._feed.answer(_PEER)
        return address_from(self._feed)

    def connect(self, peer: Address) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"c")

    def close(self) -> None:
        """See `Socket`."""
        self._feed.answer(_CLOSE)

    def set_option(self, option: Option, value: int) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"t")

    def option(self, option: Option) -> OptionValue:
        """See `Socket`."""
        return OptionValue(self._outcome(b"p"), i64_from(self._feed))
