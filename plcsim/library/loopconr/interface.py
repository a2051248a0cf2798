"""Library LoopConR as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

__all__ = ["LCR_ERR_LCRMovAvgFlt_BASE"]

_DECLARED = declared_beside(__name__)

LCR_ERR_LCRMovAvgFlt_BASE: Final = 31551
"""Base is 0."""


class LCRScal(FunctionBlock):
    """A straight line through two points."""

    _plc_type = _DECLARED["LCRScal"]

    x: float

    x1: float
    """X of the first point."""

    y1: float
    """Y of the first point."""

    x2: float
    """X of the second point."""

    y2: float
    """Y of the second point."""

    y: float


class LCRLimit(FunctionBlock):
    """Limits a value."""

    _plc_type = _DECLARED["LCRLimit"]

    max_value: int

    min_value: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    out: int

    max_limit: bool
    """TRUE where the value is above."""

    min_limit: bool
    """TRUE where the value is below."""


class LCRLimScal(FunctionBlock):
    """A straight line through two points, limited to what lies between them."""

    _plc_type = _DECLARED["LCRLimScal"]

    x: float

    x1: float
    """X of the first point."""

    y1: float
    """Y of the first point."""

    x2: float
    """X of the second point."""

    y2: float
    """Y of the second point."""

    y: float


class LCRMovAvgFlt(FunctionBlock):
    """Mean of the latest values."""

    _plc_type = _DECLARED["LCRMovAvgFlt"]

    enable: bool
    """Run the block; FALSE resets it."""

    x: float

    base: int
    """Number of values."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    y: float

    sum_old_dbl_1: int

    sum_old_dbl_2: int

    p_xold: int

    i_xold: int

    base_old: int

    enable_old: bool

    bootkey_old: int
