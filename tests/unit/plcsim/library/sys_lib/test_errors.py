"""Errors that programs report."""

import pytest

from plcsim.core.errors import ApplicationError
from plcsim.core.logbook import Severity
from plcsim.core.system import State
from plcsim.library.runtime import ERR_OK


def warnings(tasks):
    found = [e for e in tasks.controller.logbook if e.severity is Severity.WARNING]
    return [(entry.source, entry.text) for entry in found]


def test_a_warning_stands_in_the_logbook(tasks):
    tasks.run_as(0)
    assert tasks.function("ERRxwarning")(50_000, 16, tasks.text("too hot\x07")) == ERR_OK
    tasks.controller.scan.active = None
    assert tasks.function("ERR_warning")(50_001, 0) == ERR_OK
    assert warnings(tasks) == [
        ("mix", "too hot\\x07 (error 50000, info 16#00000010)"),
        ("system", "error 50001, info 16#00000000"),
    ]


def test_a_fatal_error_leads_to_service(tasks, in_cycle):
    text = tasks.text("no way on")
    in_cycle(2, lambda: tasks.function("ERRxfatal")(55_555, 1, text))
    assert tasks.controller.run_for(100_000_000) is State.SERVICE
    assert "no way on (error 55555, info 16#00000001)" in str(tasks.controller.fault)
    assert tasks.controller.fault.program == "mix"


def test_a_long_text_is_cut(tasks):
    with pytest.raises(ApplicationError, match=r"^x{33} \(error 1"):
        tasks.function("ERRxfatal")(1, 0, tasks.text("x" * 50))
    with pytest.raises(ApplicationError, match=r"^error 1, info"):
        tasks.function("ERR_fatal")(1, 0)
