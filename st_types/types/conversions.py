"""Values from one elementary type to another, as the controller converts them.

Automation Studio compiles ST to C, so an assignment and a function such as ``DINT_TO_USINT`` are C
casts: an integer keeps its low bits. A REAL that goes to an integer is rounded first, halves away
from zero. Beyond the range of the machine instruction Intel gives its "integer indefinite": the
smallest signed number of 32 bits (64 bits for UDINT, DWORD and the 64-bit types), whose low bits
are kept; NaN and infinity count as beyond. ARM differs there, and no program should rest on it.
`saturate` is for those that clamp instead.
"""

from __future__ import annotations

import math
import struct
from typing import TYPE_CHECKING, Any

from st_types.types.elementary import Kind

if TYPE_CHECKING:
    from st_types.types.elementary import ElementaryType

Value = bool | int | float


def convert(value: Value, target: ElementaryType[Any]) -> Value:
    """Return ``value`` as a variable of type ``target`` holds it after an assignment.

    TIME, TIME_OF_DAY, DATE and DATE_AND_TIME are the integers they are stored as.
    """
    if target.kind is Kind.BOOL:
        return value != 0
    if target.kind is Kind.REAL:
        return _real(float(value), target.size)
    return target.wrap(_rounded(value, target) if isinstance(value, float) else int(value))


def saturate(value: Value, target: ElementaryType[Any]) -> Value:
    """Return the value of ``target`` that is nearest to ``value``; NaN gives 0 for integers."""
    if target.kind is Kind.BOOL:
        return value != 0
    if target.kind is Kind.REAL:
        return _clamped_real(float(value), target.size)
    if isinstance(value, float):
        if not math.isfinite(value):
            return 0 if math.isnan(value) else target.maximum if value > 0 else target.minimum
        value = int(value + math.copysign(0.5, value))
    return min(max(int(value), target.minimum), target.maximum)


def _rounded(value: float, target: ElementaryType[Any]) -> int:
    is_long = target.size == 8 or (target.size == 4 and target.minimum == 0)
    limit = 1 << (63 if is_long else 31)
    if not math.isfinite(value):
        return -limit
    whole = int(value + math.copysign(0.5, value))
    top = limit << 1 if target.size == 8 and target.minimum == 0 else limit
    return whole if -limit <= whole < top else -limit


_REAL_CODES = {4: "<f", 8: "<d"}


def _real(value: float, size: int) -> float:
    code = _REAL_CODES[size]
    try:
        stored: float = struct.unpack(code, struct.pack(code, value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return stored


def _clamped_real(value: float, size: int) -> float:
    stored = _real(value, size)
    if math.isinf(stored) and math.isfinite(value):
        largest: float = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]
        return math.copysign(largest, value)
    return stored
