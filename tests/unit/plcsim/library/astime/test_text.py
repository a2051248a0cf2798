"""Dates and durations as text. The form is that which the library's interface gives."""

import pytest

from plcsim.library.astime import DTStructure

EXAMPLE = 568_221_253
"""Sun Jan 3 15:14:13 1988."""


def test_a_date_as_text(plc):
    address = plc.text("x" * 40)
    assert plc.function("ascDT")(EXAMPLE, address, 30) == address
    assert plc.string(address) == "Sun Jan 3 15:14:13 1988"


def test_a_date_structure_as_text(plc):
    date, address = plc.bytes(bytes(DTStructure._plc_type.size)), plc.text("")
    assert plc.function("ascDTStructure")(date, address, 30) == 0
    plc.function("DT_TO_DTStructure")(EXAMPLE, date)
    assert plc.function("ascDTStructure")(date, address, 30) == address
    assert plc.string(address) == "Sun Jan 3 15:14:13 1988"


@pytest.mark.parametrize(
    ("milliseconds", "text"),
    [(0, "00:00:00"), (54_853_999, "15:14:13"), (-1000, "-00:00:01"), (90_000_000, "25:00:00")],
)
def test_a_duration_as_text(plc, milliseconds, text):
    address = plc.text("")
    assert plc.function("ascTIME")(milliseconds, address, 20) == address
    assert plc.string(address) == text


def test_a_duration_structure_as_text(plc):
    duration, address = plc.bytes(bytes(12)), plc.text("")
    plc.function("TIME_TO_TIMEStructure")(54_853_000, duration)
    assert plc.function("ascTIMEStructure")(duration, address, 20) == address
    assert plc.string(address) == "15:14:13"


def test_a_text_is_cut_to_the_bytes_that_are_there(plc):
    address = plc.bytes(b"#" * 10)
    plc.function("ascDT")(EXAMPLE, address, 8)
    assert plc.memory.read(address, 10) == b"Sun Jan\0##"


def test_nothing_is_stored_without_room(plc):
    address = plc.bytes(b"#" * 10)
    assert plc.function("ascDT")(EXAMPLE, address, 0) == 0
    assert plc.function("ascTIME")(0, 0, 20) == 0
    assert plc.function("ascTIMEStructure")(0, address, 10) == 0
    assert plc.function("ascDTStructure")(0, address, 10) == 0
    assert plc.memory.read(address, 10) == b"#" * 10


def test_differences(plc):
    assert plc.function("DiffDT")(1000, 400) == 600
    assert plc.function("DiffDT")(400, 1000) == 2**32 - 600
    assert plc.function("DiffT")(70, -30) == 100
