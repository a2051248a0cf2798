"""Errors of the host's sockets as outcomes."""

from __future__ import annotations

import errno
from typing import Final

from plcsim.network.protocol import Outcome

OUTCOMES: Final = {
    errno.EAGAIN: Outcome.WOULD_BLOCK,
    errno.EINPROGRESS: Outcome.WOULD_BLOCK,
    errno.EALREADY: Outcome.WOULD_BLOCK,
    errno.EINTR: Outcome.WOULD_BLOCK,
    errno.ECONNRESET: Outcome.RESET,
    errno.ECONNABORTED: Outcome.RESET,
    errno.ETIMEDOUT: Outcome.TIMED_OUT,
    errno.EPIPE: Outcome.NOT_CONNECTED,
    errno.ENOTCONN: Outcome.NOT_CONNECTED,
    errno.EISCONN: Outcome.ALREADY_CONNECTED,
    errno.ECONNREFUSED: Outcome.REFUSED,
    errno.EHOSTUNREACH: Outcome.UNREACHABLE,
    errno.ENETUNREACH: Outcome.UNREACHABLE,
    errno.ENETDOWN: Outcome.UNREACHABLE,
    errno.EADDRINUSE: Outcome.IN_USE,
    errno.EADDRNOTAVAIL: Outcome.NOT_LOCAL,
    errno.EACCES: Outcome.DENIED,
    errno.EPERM: Outcome.DENIED,
    errno.EMFILE: Outcome.NO_RESOURCES,
    errno.ENFILE: Outcome.NO_RESOURCES,
    errno.ENOBUFS: Outcome.NO_RESOURCES,
    errno.ENOMEM: Outcome.NO_RESOURCES,
    errno.EINVAL: Outcome.INVALID,
    errno.EBADF: Outcome.INVALID,
    errno.EDOM: Outcome.INVALID,
    errno.EMSGSIZE: Outcome.INVALID,
    errno.EOPNOTSUPP: Outcome.INVALID,
    errno.ENOPROTOOPT: Outcome.INVALID,
}


def outcome_of(error: OSError) -> Outcome:
    """Return what an error of a call means."""
    return OUTCOMES.get(error.errno or 0, Outcome.SYSTEM)
