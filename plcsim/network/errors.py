"""Errors of plcsim.network.

::

    NetworkError                     base of all (a PlcError)
    └── NetworkSetupError            a wrong virtual net, link or fault (also a ValueError)

What happens on a net is never an exception: it is an ``Outcome``.
"""

from __future__ import annotations

from plcsim.core.errors import PlcError


class NetworkError(PlcError):
    """Base of all errors of this package."""


class NetworkSetupError(NetworkError, ValueError):
    """A virtual net, a link or a fault is described wrongly."""
