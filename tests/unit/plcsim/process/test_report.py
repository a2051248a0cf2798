"""The report: every field of docs/report.md, with its type."""

import json

import pytest

from plcsim.core.heap_use import Heaps, HeapUse
from plcsim.core.statistics import Histogram
from plcsim.core.task import Policy
from plcsim.process.report import SCHEMA, histogram_report, report, summary_of

MS = 1_000_000

DISTRIBUTION = dict.fromkeys(
    ["count", "minimum", "mean", "p50", "p90", "p99", "p99_9", "maximum"], int
)
VIOLATION = {
    "task_class": int,
    "program": str,
    "cycle": int,
    "cause": str,
    "release_ns": int,
    "response_ns": int,
    "own_ns": int,
    "others_ns": int,
    "controller_ns": int,
    "limit_ns": int,
    "location": str,
    "text": str,
}
HEAP = ("size_bytes", "used_bytes", "most_bytes", "areas", "refused")
REPORT = {
    "schema": str,
    "project": str,
    "clock": str,
    "realtime_rights": [str],
    "state": str,
    "fault": object,
    "elapsed_ns": int,
    "memory_bytes": int,
    "heaps": [{"name": str} | dict.fromkeys(HEAP, int)],
    "task_classes": [
        {
            "number": int,
            "cycle_ns": int,
            "tolerance_ns": int,
            "cycles": int,
            "missed_grid_points": int,
            "in_tolerance": int,
            "violations": {"program": int, "host": int, "preempted": int, "controller": int},
            "lateness_ns": DISTRIBUTION,
            "execution_ns": DISTRIBUTION,
            "controller_ns": DISTRIBUTION,
            "response_ns": DISTRIBUTION,
            "programs": [{"name": str, "execution_ns": DISTRIBUTION}],
        }
    ],
    "violations": [VIOLATION],
    "logbook": [{"time_ns": int, "severity": str, "source": str, "text": str}],
    "logbook_dropped": int,
    "output_lost_bytes": int,
}


def check(value, schema):
    """Compare a value with its schema: all keys are there, every type is right."""
    if isinstance(schema, dict):
        assert value.keys() == schema.keys()
        for key, inner in schema.items():
            check(value[key], inner)
    elif isinstance(schema, list):
        assert value
        for element in value:
            check(element, schema[0])
    else:
        assert isinstance(value, schema)


@pytest.fixture
def report_of(make_controller):
    """``report_of(class, ...)``: the report of a run of 100 ms, through JSON."""

    def report_of(*classes, **options):
        controller = make_controller(*classes, **options)
        Heaps.of(controller.context).add("a", lambda: HeapUse(1000, 24, 48, 3, 1))
        controller.boot()
        controller.run_for(100 * MS)
        controller.shutdown()
        return json.loads(json.dumps(report(controller, "cell", 100 * MS, ["SCHED_FIFO 50"])))

    return report_of


def test_every_field_has_its_type(report_of, task_class, program_of, clock):
    busy = program_of(lambda _: clock.spend_ns(12 * MS))
    found = report_of(
        task_class(1, 10, {"policy": Policy.LOG}, a=busy, b=program_of()),
        task_class(2, 20, c=program_of()),
    )
    check(found, REPORT)
    assert found["schema"] == SCHEMA == "plcsim-report/1"
    assert (found["project"], found["clock"], found["state"]) == ("cell", "virtual", "STOPPED")
    assert found["fault"] is None
    assert found["heaps"] == [{"name": "a"} | dict(zip(HEAP, (1000, 24, 48, 3, 1), strict=True))]
    assert found["realtime_rights"] == ["SCHED_FIFO 50"]
    first, second = found["task_classes"]
    assert [p["name"] for p in first["programs"]] == ["a", "b"]
    assert first["cycles"] + first["missed_grid_points"] == 10
    assert first["violations"]["program"] == first["cycles"] == len(found["violations"])
    assert first["execution_ns"]["p50"] == first["programs"][0]["execution_ns"]["p50"] == 12 * MS
    assert (second["number"], second["cycle_ns"]) == (2, 20 * MS)


def test_a_violation_that_led_to_service(report_of, task_class, program_of, clock):
    found = report_of(task_class(1, 10, p=program_of(lambda _: clock.spend_ns(25 * MS))))
    fault = found["fault"]
    assert fault.pop("kind") == "cycle_time_violation"
    check(fault, VIOLATION)
    assert found["violations"] == [fault]
    assert (found["state"], fault["cause"], fault["cycle"]) == ("SERVICE", "program", 1)
    assert fault["text"] == next(e["text"] for e in found["logbook"] if e["severity"] == "error")


def test_a_program_that_failed(report_of, task_class, program_of):
    found = report_of(task_class(1, 10, p=program_of(lambda _: 1 // 0)))
    assert found["state"] == "SERVICE"
    fault = found["fault"]
    location = fault.pop("location")
    assert location.startswith(__file__)
    assert fault.pop("calls")[-1] == f"{location} in <lambda>"
    assert found["fault"] == {
        "kind": "program_error",
        "program": "p",
        "unit": "CYCLIC",
        "text": "division by zero",
    }


def test_a_distribution_comes_back_from_the_report():
    histogram = Histogram()
    for duration_ns in (3, 1, 4, 1, 5):
        histogram.record(duration_ns)
    figures = histogram_report(histogram)
    check(figures, DISTRIBUTION)
    assert (figures["count"], figures["minimum"], figures["maximum"]) == (5, 1, 5)
    assert summary_of(figures) == histogram.summary()
