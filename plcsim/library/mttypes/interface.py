"""Library mttypes as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from enum import IntEnum

from plcsim.library.face import declared_beside
from st_types import Struct

__all__ = ["MTPIDIntegrationEnum", "MTPIDParametersType"]

_DECLARED = declared_beside(__name__)


class MTPIDIntegrationEnum(IntEnum):
    """Enumeration MTPIDIntegrationEnum."""

    mtINTEGRATION_FREE = 0
    mtHOLD_INTEGRATION_POSITIVE = 1
    mtHOLD_INTEGRATION_NEGATIVE = -1


_DECLARED.enumeration(MTPIDIntegrationEnum)


class MTPIDParametersType(Struct):
    """Parameters of a PID controller."""

    _plc_type = _DECLARED["MTPIDParametersType"]

    Gain: float
    """Of all parts."""

    IntegrationTime: float
    """Seconds; 0 for no integral part."""

    DerivativeTime: float
    """Seconds; 0 for no derivative part."""

    FilterTime: float
    """Seconds, of the derivative part."""
