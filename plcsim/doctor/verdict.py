"""What measurements mean: whether a tick can be held, and who is to blame if not.

The rule, for the lateness of plcsim's own loop with one empty program:

- *held*: 99.9 % of the cycles start less than 20 % of the tick late, and no grid point is missed.
- *mostly*: 99 % of them do, and at most one grid point in a thousand is missed.
- *not held*: everything else.

A measurement of a few seconds sees about a thousand cycles: it finds a host that cannot hold the
tick, but it cannot promise the next hour. The longer it is, the more the verdict is worth.
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.duration import format_duration

if TYPE_CHECKING:
    from plcsim.doctor.loops import Measurement

LIMIT_PERCENT = 20
"""A cycle may start this share of the tick late; the rest is for the programs."""

MISSED_PER_MILLE = 1
"""Grid points that may be missed where the tick is *mostly* held."""


class Verdict(Enum):
    """How well a tick is held, in the words that follow "can"."""

    HELD = "can be held"
    MOSTLY = "can mostly be held"
    NOT_HELD = "cannot be held"


class Comparison(NamedTuple):
    """Our loop beside the floor, measured on the same grid with the same rights."""

    floor: Measurement
    scan: Measurement


def judge(measurement: Measurement) -> Verdict:
    """Return how well the loop held its cycle time, by the rule of this module."""
    limit_ns = limit_of(measurement)
    if measurement.missed == 0 and measurement.lateness.p99_9_ns < limit_ns:
        return Verdict.HELD
    few = 1000 * measurement.missed <= MISSED_PER_MILLE * measurement.order.cycles
    if few and measurement.lateness.p99_ns < limit_ns:
        return Verdict.MOSTLY
    return Verdict.NOT_HELD


def limit_of(measurement: Measurement) -> int:
    """Return the lateness in nanoseconds that is still punctual."""
    return measurement.order.cycle_ns * LIMIT_PERCENT // 100


def explain(comparison: Comparison) -> str:
    """Return the verdict on our loop, its reason, and who is to blame, in plain words."""
    floor, scan = comparison
    verdict = judge(scan)
    text = (
        f"{'With' if scan.order.realtime else 'Without'} real-time rights a tick of "
        f"{format_duration(scan.order.cycle_ns)} {verdict.value}: {_reason(scan)}."
    )
    if verdict is Verdict.HELD:
        return text
    if judge(floor) is Verdict.HELD:
        return f"{text} A bare {floor.loop} loop held it: measure longer to know (--seconds 30)."
    return f"{text} It is the host, for a bare {floor.loop} loop did not hold it either."


def _reason(measurement: Measurement) -> str:
    lateness = measurement.lateness
    return (
        f"99.9 % of the cycles start within {format_duration(lateness.p99_9_ns)} of their release "
        f"(limit {format_duration(limit_of(measurement))}), the last within "
        f"{format_duration(lateness.maximum_ns)}, and {measurement.missed} of "
        f"{measurement.order.cycles} grid points were missed"
    )
