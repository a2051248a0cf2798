"""Mathematical functions as the C library has them: no exceptions, but NaN and infinities.

Source: ISO C99, annex F.9.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


def _defined(function: Callable[[float], float]) -> Callable[[float], float]:
    """Return a function that gives NaN where it is not defined."""

    def call(x: float) -> float:
        try:
            return function(x)
        except ValueError:
            return math.nan

    return call


def _exp(x: float) -> float:
    try:
        return math.exp(x)
    except OverflowError:
        return math.inf


def _logarithm(function: Callable[[float], float]) -> Callable[[float], float]:
    def call(x: float) -> float:
        if x > 0 or math.isnan(x):
            return function(x)
        return -math.inf if x == 0 else math.nan

    return call


def _pow(x: float, y: float) -> float:
    try:
        return math.pow(x, y)
    except OverflowError:
        return _signed_infinity(x, y)
    except ValueError:  # 0 to a negative power, or a root of a negative number
        return _signed_infinity(x, y) if x == 0 else math.nan


def _signed_infinity(x: float, y: float) -> float:
    """Return the infinity with the sign of ``x ** y``."""
    negative = math.copysign(1, x) < 0 and math.fmod(y, 2) != 0
    return -math.inf if negative else math.inf


def _fmod(x: float, y: float) -> float:
    try:
        return math.fmod(x, y)
    except ValueError:
        return math.nan


FUNCTIONS: Final[Mapping[str, Callable[..., float]]] = {
    "sin": _defined(math.sin),
    "cos": _defined(math.cos),
    "tan": _defined(math.tan),
    "asin": _defined(math.asin),
    "acos": _defined(math.acos),
    "atan": math.atan,
    "exp": _exp,
    "log": _logarithm(math.log),
    "log10": _logarithm(math.log10),
    "pow": _pow,
    "fmod": _fmod,
}
"""By the name that follows ``rt.``; arguments and results are LREAL."""
