"""Durations that a test gives."""

from __future__ import annotations

from plcsim.core.duration import parse_duration_ns
from plcsim.testing.errors import PlcTestError

__tracebackhide__ = True


def duration_ns(given: str | int, name: str = "duration") -> int:
    """Return the nanoseconds of a duration such as ``"250ms"``, or of an int of nanoseconds.

    Raises:
        PlcTestError: it is neither, or below 0.
    """
    if isinstance(given, int) and not isinstance(given, bool) and given >= 0:
        return given
    if not isinstance(given, str):
        raise PlcTestError(f'{name}: {given!r} is not a duration such as "250ms"')
    try:
        return parse_duration_ns(given)
    except ValueError as err:
        raise PlcTestError(f"{name}: {err}") from None
