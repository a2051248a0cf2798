"""The result of one PLC test as JSON and as JUnit properties."""

from __future__ import annotations

import linecache
import re
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

from plcsim.core.statistics import Histogram
from plcsim.process.report import class_report, fault_report, heaps_report, violation_report
from plcsim.testing.costs import overhead_ns
from plcsim.testing.instructions import summary_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pytest

    from plcsim.testing.calibration import Calibration
    from plcsim.testing.plc import Plc
    from plcsim.testing.trace import Trace

SCHEMA = "plcsim-test-report/1"

_REPEAT = re.compile(r"-?repeat\d+(?=[\]-])")

_OWN_ERROR = re.compile(r"\Aplcsim\.[\w.]+: ")
"""What pytest puts before the message of an error of ours."""

EXPLANATION = "plc"
"""Heading of what the plugin adds to a failed test."""

MOST_TRACES = 6
"""Traces of one test that go into the report."""


def result_of(
    item: pytest.Item,
    report: pytest.TestReport,
    plc: Plc,
    calibration: Calibration | None,
    traces: Sequence[Trace],
) -> dict[str, Any]:
    """Return what the report says of one test; docs/testing-reference.md describes each field."""
    own_ns = overhead_ns()
    samples_ns = calibration.samples_ns if calibration else []
    loop_ns = round(median(samples_ns)) if samples_ns else 0
    return {
        "test": item.nodeid,
        "group": group_of(item.nodeid),
        "outcome": report.outcome,
        "verdict": getattr(report, "plc_verdict", ""),
        "message": _message(report),
        **_origin(report),
        "explanation": "\n".join(text for head, text in report.sections if head == EXPLANATION),
        "project": plc.name,
        "clock": "monotonic" if plc.realtime else "virtual",
        "seed": plc.seed,
        "interleaving": str(plc.interleaving or ""),
        "time_ns": plc.total_ns,
        "state": plc.controller.state.name,
        "fault": fault_report(plc.controller.fault),
        "calibration_ns": loop_ns,
        "task_classes": [class_report(c) for c in plc.controller.classes],
        "heaps": heaps_report(plc.controller),
        "programs": [
            _program(name, costs_ns, own_ns, loop_ns)
            | {
                "instructions": _instructions(plc.costs.instructions.get(name)),
                "lines": plc.costs.lines.of_task(name),
            }
            for name, costs_ns in plc.costs.measured_ns.items()
            if costs_ns
        ],
        "lines": plc.costs.lines.of_libraries(),
        "violations": [violation_report(v) for v in plc.controller.violations],
        "traces": [
            {"tags": [t.path for t in trace.tags], "svg": trace.to_svg()}
            for trace in traces[:MOST_TRACES]
        ],
    }


def other_result_of(report: pytest.TestReport) -> dict[str, Any]:
    """Return what the report says of a test that has no controller."""
    return {
        "test": report.nodeid,
        "outcome": report.outcome,
        "message": _message(report),
        **_origin(report),
    }


def group_of(nodeid: str) -> str:
    """Return the name that all repeats of a test share."""
    return _REPEAT.sub("", nodeid).replace("[]", "")


def _message(report: pytest.TestReport) -> str:
    if isinstance(report.longrepr, tuple):
        return str(report.longrepr[2])
    text = getattr(getattr(report.longrepr, "reprcrash", None), "message", None)
    shown = str(text or report.longrepr or "") if not report.passed else ""
    return _OWN_ERROR.sub("", shown)


def _origin(report: pytest.TestReport) -> dict[str, str]:
    """Return where a test failed, as "file:line", and the line itself; "" where nobody knows."""
    crash = getattr(report.longrepr, "reprcrash", None)
    if crash is None:
        return {"location": "", "source": ""}
    file, here = Path(crash.path), Path.cwd()
    shown = file.relative_to(here) if file.is_relative_to(here) else file
    source = linecache.getline(str(crash.path), crash.lineno).strip()
    return {"location": f"{shown}:{crash.lineno}", "source": source}


def _program(name: str, costs_ns: list[int], own_ns: int, loop_ns: int) -> dict[str, Any]:
    """Return the CPU time of a program's cycles, and their median in runs of the loop."""
    histogram = Histogram()
    net_ns = [max(0, cost - own_ns) for cost in costs_ns]
    for cost in net_ns:
        histogram.record(cost)
    middle_ns = round(median(net_ns))
    summary = histogram.summary()
    return {
        "name": name,
        "cycles": len(net_ns),
        "cpu_ns": {k.removesuffix("_ns"): v for k, v in summary._asdict().items()},
        "median_in_loops": round(middle_ns / loop_ns, 6) if loop_ns else 0,
        "histogram": histogram.buckets(),
    }


def _instructions(counted: list[int] | None) -> dict[str, Any] | None:
    """Return the instructions of a program's cycles, None where they are not counted."""
    return summary_of(counted) if counted else None


def properties_of(result: dict[str, Any]) -> list[tuple[str, object]]:
    """Return the figures of a result as JUnit properties."""
    properties: list[tuple[str, object]] = [
        ("plc.clock", result["clock"]),
        ("plc.seed", result["seed"]),
        ("plc.time_ns", result["time_ns"]),
    ]
    if result["verdict"]:
        properties.append(("plc.verdict", result["verdict"]))
    for task_class in result["task_classes"]:
        name = f"plc.task_class.{task_class['number']}"
        properties += [
            (f"{name}.cycles", task_class["cycles"]),
            (f"{name}.missed_grid_points", task_class["missed_grid_points"]),
            (f"{name}.violations", sum(task_class["violations"].values())),
            (f"{name}.response_max_ns", task_class["response_ns"]["maximum"]),
        ]
    for program in result["programs"]:
        name = f"plc.program.{program['name']}"
        properties += [
            (f"{name}.cpu_p50_ns", program["cpu_ns"]["p50"]),
            (f"{name}.cpu_p99_ns", program["cpu_ns"]["p99"]),
        ]
        if program["instructions"]:
            properties.append((f"{name}.instructions_max", program["instructions"]["maximum"]))
    return properties
