"""Options of the host's sockets, of TCP and of UDP."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.network.os_outcomes import outcome_of
from plcsim.network.protocol import BUFFERS, Option, OptionValue, Outcome, legal_value

if TYPE_CHECKING:
    import socket
    from collections.abc import Mapping

    Names = Mapping[Option, tuple[int, int]]
    """Level and name of the options that a kind of socket has."""


def set_option(own: socket.socket, names: Names, option: Option, value: int) -> Outcome:
    """Set an option; one that is not in ``names``, or no legal value, is INVALID."""
    legal = legal_value(option, value)
    if option not in names or legal is None:
        return Outcome.INVALID
    try:
        own.setsockopt(*names[option], legal)
    except OSError as error:
        return outcome_of(error)
    return Outcome.OK


def read_option(own: socket.socket, names: Names, option: Option) -> OptionValue:
    """Return an option as it was set; one that is not in ``names`` is INVALID."""
    if option not in names:
        return OptionValue(Outcome.INVALID)
    try:
        value = own.getsockopt(*names[option])
    except OSError as error:
        return OptionValue(outcome_of(error))
    # socket(7): the kernel doubles the buffer sizes that are set.
    return OptionValue(Outcome.OK, value // 2 if option in BUFFERS else value)
