"""Durations as people write them, ``"10ms"`` or ``"1.5s"``; inside always nanoseconds."""

from __future__ import annotations

import re
from fractions import Fraction

_UNITS_NS = {
    "ns": 1,
    "us": 1_000,
    "µs": 1_000,
    "ms": 1_000_000,
    "s": 1_000_000_000,
    "min": 60_000_000_000,
    "m": 60_000_000_000,
    "h": 3_600_000_000_000,
}
_DURATION = re.compile(r"\s*(\d+(?:\.\d+)?)\s*([a-zµ]+)\s*", re.IGNORECASE)


def parse_duration_ns(text: str) -> int:
    """Return the nanoseconds of a number with a unit (ns, us, ms, s, min, h).

    Raises:
        ValueError: there is no number, no unit, or the value is not a whole number of nanoseconds.
    """
    match = _DURATION.fullmatch(text)
    unit_ns = _UNITS_NS.get(match[2].lower()) if match else None
    if match is None or unit_ns is None:
        raise ValueError(f'{text!r} is not a duration such as "10ms", "500us" or "1.5s"')
    value = Fraction(match[1]) * unit_ns
    if value.denominator != 1:
        raise ValueError(f"{text!r} is not a whole number of nanoseconds")
    return value.numerator


def format_duration(duration_ns: int) -> str:
    """Return a duration in the largest unit that keeps it above 1, to three digits.

    Whole numbers of a unit are exact, however many digits they take, and so are the digits before
    the point.
    """
    for unit in ("s", "ms", "us"):
        whole, rest = divmod(duration_ns, _UNITS_NS[unit])
        if whole and not rest:
            return f"{whole} {unit}"
        if whole:
            number = duration_ns / _UNITS_NS[unit]
            return f"{number:.3g} {unit}" if number < 999.5 else f"{number:.0f} {unit}"
    return f"{duration_ns} ns"
