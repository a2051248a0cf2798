"""Options of a virtual socket: values, their ranges, what they are at first."""

from __future__ import annotations

from plcsim.network.protocol import MAX_LINGER_S, Option, Outcome, legal_value


class SocketOptions:
    """Values of all options of one socket.

    Args:
        send_buffer: bytes.
        receive_buffer: bytes.
    """

    def __init__(self, send_buffer: int, receive_buffer: int) -> None:
        # Keepalive values are those of tcp(7).
        self._values = {
            Option.KEEPALIVE: 0,
            Option.SEND_BUFFER: send_buffer,
            Option.RECEIVE_BUFFER: receive_buffer,
            Option.RECEIVE_LOW: 1,
            Option.URGENT_INLINE: 0,
            Option.NO_DELAY: 0,
            Option.KEEP_COUNT: 9,
            Option.KEEP_IDLE: 7200,
            Option.KEEP_INTERVAL: 75,
        }
        self.linger: int | None = None

    def __getitem__(self, option: Option) -> int:
        return self._values[option]

    def __contains__(self, option: Option) -> bool:
        return option in self._values

    def set(self, option: Option, value: int) -> Outcome:
        """Set an option: OK, or INVALID for a value out of range."""
        legal = legal_value(option, value)
        if legal is None or option not in self._values:
            return Outcome.INVALID
        self._values[option] = legal
        return Outcome.OK

    def set_linger(self, seconds: int | None) -> Outcome:
        """Set the linger time: OK, or INVALID for a time out of range."""
        if seconds is not None and not 0 <= seconds <= MAX_LINGER_S:
            return Outcome.INVALID
        self.linger = seconds
        return Outcome.OK

    def inherit(self, other: SocketOptions) -> None:
        """Take over all values, as an accepted socket does from the listening one."""
        self._values.update(other._values)
        self.linger = other.linger
