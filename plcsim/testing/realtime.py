"""Tests on the wall clock: passed, failed by the program, or the host could not hold the tick."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

from plcsim.core.duration import format_duration
from plcsim.core.task import Cause, Violation

if TYPE_CHECKING:
    from plcsim.core.controller import Controller
    from plcsim.core.task import TaskClass


class RealtimeVerdict(Enum):
    """What a test on the wall clock says."""

    PASSED = "passed"
    FAILED = "failed by the program"
    HOST = "host could not hold the tick"


def judge(controller: Controller, *, failed: bool) -> RealtimeVerdict:
    """Return the verdict.

    A program that used more than cycle time plus tolerance fails whatever the host did, as CPU time
    is counted there. Otherwise a host that made the controller miss grid points takes the meaning
    from both a failure and a success.

    Args:
        controller: after the test.
        failed: whether an assertion of the test failed.
    """
    classes = controller.classes
    own = (Cause.PROGRAM, Cause.PREEMPTED)
    if any(c.violations[cause] for c in classes for cause in own):
        return RealtimeVerdict.FAILED
    foreign = (Cause.HOST, Cause.CONTROLLER)
    if any(c.violations[cause] for c in classes for cause in foreign):
        return RealtimeVerdict.HOST
    if _missed_by_host(controller):
        return RealtimeVerdict.HOST
    if isinstance(controller.fault, Violation) and controller.fault.cause in foreign:
        return RealtimeVerdict.HOST
    return RealtimeVerdict.FAILED if failed else RealtimeVerdict.PASSED


def _missed_by_host(controller: Controller) -> bool:
    """Whether grid points were missed although all programs together fit into a cycle."""
    used_ns = sum(c.execution.maximum_ns for c in controller.classes)
    return any(c.missed and used_ns <= c.cycle_ns for c in controller.classes)


def figures(controller: Controller) -> str:
    """Return how the host did, in words."""
    return "; ".join(_figures(c) for c in controller.classes)


def _figures(task_class: TaskClass) -> str:
    late = task_class.lateness
    return (
        f"task class {task_class.number} ({format_duration(task_class.cycle_ns)}): "
        f"{task_class.missed} of {task_class.missed + task_class.cycles} grid points missed, "
        f"woken up to {format_duration(late.maximum_ns)} late "
        f"(p99 {format_duration(late.percentile_ns(99))}), programs used "
        f"{format_duration(task_class.execution.maximum_ns)} at most"
    )
