"""The report of a run as JSON; docs/report.md describes every field."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.core.controller import describe_violation
from plcsim.core.errors import ProgramError
from plcsim.core.heap_use import Heaps
from plcsim.core.statistics import Summary

if TYPE_CHECKING:
    from plcsim.core.controller import Controller
    from plcsim.core.logbook import Entry
    from plcsim.core.statistics import Histogram
    from plcsim.core.task import TaskClass, Violation

SCHEMA = "plcsim-report/1"

_HISTOGRAM_FIELDS = ("count", *(name.removesuffix("_ns") for name in Summary._fields[1:]))


def histogram_report(histogram: Histogram) -> dict[str, int]:
    """Return count, minimum, mean, percentiles and maximum in nanoseconds."""
    return dict(zip(_HISTOGRAM_FIELDS, histogram.summary(), strict=True))


def summary_of(figures: dict[str, int]) -> Summary:
    """Return what `histogram_report` was made from."""
    return Summary(*(figures[field] for field in _HISTOGRAM_FIELDS))


def class_report(task_class: TaskClass) -> dict[str, Any]:
    """Return the part of the report about one task class."""
    return {
        "number": task_class.number,
        "cycle_ns": task_class.cycle_ns,
        "tolerance_ns": task_class.tolerance_ns,
        "cycles": task_class.cycles,
        "missed_grid_points": task_class.missed,
        "in_tolerance": task_class.in_tolerance,
        "violations": {cause.value: n for cause, n in task_class.violations.items()},
        "lateness_ns": histogram_report(task_class.lateness),
        "execution_ns": histogram_report(task_class.execution),
        "controller_ns": histogram_report(task_class.controller),
        "response_ns": histogram_report(task_class.response),
        "programs": [
            {"name": task.name, "execution_ns": histogram_report(task.execution)}
            for task in task_class.tasks
        ],
    }


def violation_report(violation: Violation) -> dict[str, Any]:
    """Return a record of a violation, with its text."""
    return {
        **violation._asdict(),
        "cause": violation.cause.value,
        "text": describe_violation(violation),
    }


def heaps_report(controller: Controller) -> list[dict[str, Any]]:
    """Return what programs and libraries in C have on their heaps."""
    return [
        {
            "name": name,
            "size_bytes": use.size,
            "used_bytes": use.used,
            "most_bytes": use.most,
            "areas": use.areas,
            "refused": use.refused,
        }
        for name, use in Heaps.of(controller.context).uses().items()
    ]


def fault_report(fault: ProgramError | Violation | None) -> dict[str, Any] | None:
    """Return what led to SERVICE: kind "program_error" or "cycle_time_violation"."""
    if fault is None:
        return None
    if isinstance(fault, ProgramError):
        return {
            "kind": "program_error",
            "program": fault.program,
            "unit": fault.unit,
            "location": fault.location,
            "text": fault.reason,
            "calls": list(fault.calls),
        }
    return {"kind": "cycle_time_violation", **violation_report(fault)}


def entry_report(entry: Entry) -> dict[str, Any]:
    """Return an entry of the logbook."""
    return {**entry._asdict(), "severity": entry.severity.value}


def report(controller: Controller, name: str, elapsed_ns: int, rights: list[str]) -> dict[str, Any]:
    """Return the report of a run.

    Args:
        controller: after its run.
        name: of the project.
        elapsed_ns: from the end of INIT to the end of the run, on the controller's clock.
        rights: real-time rights that the host gave.
    """
    return {
        "schema": SCHEMA,
        "project": name,
        "clock": "virtual" if controller.clock.is_virtual else "monotonic",
        "realtime_rights": rights,
        "state": controller.state.name,
        "fault": fault_report(controller.fault),
        "elapsed_ns": elapsed_ns,
        "memory_bytes": controller.memory.used,
        "heaps": heaps_report(controller),
        "task_classes": [class_report(c) for c in controller.classes],
        "violations": [violation_report(v) for v in controller.violations],
        "logbook": [entry_report(entry) for entry in controller.logbook],
        "logbook_dropped": controller.logbook.dropped,
        "output_lost_bytes": 0,
    }
