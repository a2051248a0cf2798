"""Date and time of C, and the rest of its standard library."""

import struct
from datetime import UTC, datetime, timedelta

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.system_area import DATE, RELEASE
from plcsim.machine import MachineFault
from tests.unit.plcsim.ansi_c.c_library_world import AREA, World

WORLD = World()
EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
times = st.integers(-(2**31), 2**31 - 1)


def taken_apart(when):
    WORLD.memory.write(AREA, struct.pack("<i", when))
    return WORLD.call("gmtime_r", AREA, AREA + 16)


@given(times)
def test_a_date_is_taken_apart_and_put_together(when):
    taken_apart(when)
    parts = struct.unpack("<9i", WORLD.memory.read(AREA + 16, 36))
    expected = (EPOCH + timedelta(seconds=when)).timetuple()
    assert parts == (
        *(expected.tm_sec, expected.tm_min, expected.tm_hour, expected.tm_mday),
        *(expected.tm_mon - 1, expected.tm_year - 1900, (expected.tm_wday + 1) % 7),
        *(expected.tm_yday - 1, 0),
    )
    assert WORLD.call("mktime", AREA + 16) == when


KINDS = "a A b B c C d D e F g G H I j m M p R S T u U V w W y Y"


@given(times)
def test_a_date_is_written_as_the_format_says(when):
    date = EPOCH + timedelta(seconds=when)
    taken_apart(when)
    text = " ".join(f"%{kind}" for kind in KINDS.split())
    form = WORLD.text(AREA + 64, text.encode())
    count = WORLD.call("strftime", AREA + 256, 400, form, AREA + 16, params="IIII")
    assert WORLD.read_text(AREA + 256).decode() == date.strftime(text)
    assert count == len(date.strftime(text))


def test_a_date_that_does_not_fit_writes_nothing_beyond_its_area():
    taken_apart(0)
    WORLD.memory.write(AREA + 256, b"\x55" * 16)
    form = WORLD.text(AREA + 64, b"%A, %Y")
    assert WORLD.call("strftime", AREA + 256, 8, form, AREA + 16, params="IIII") == 0
    assert WORLD.memory.read(AREA + 264, 8) == b"\x55" * 8


def test_the_time_is_the_controller_s():
    cells = WORLD.memory.system.cells
    cells[RELEASE], cells[DATE] = 1_500_000_000, 1_000_000_000 * 10**9
    assert WORLD.call("time", 0) == 1_000_000_001
    cells[RELEASE] += 2 * 10**9
    assert WORLD.call("time", AREA) == 1_000_000_003
    assert WORLD.memory.read(AREA, 4) == struct.pack("<i", 1_000_000_003)


def test_random_numbers_are_the_same_in_each_run():
    WORLD.call("srand", 7, results="")
    first = [WORLD.call("rand") for _ in range(5)]
    WORLD.call("srand", 7, results="")
    assert [WORLD.call("rand") for _ in range(5)] == first
    assert len(set(first)) == 5
    assert all(0 <= n <= 0x7FFF_FFFF for n in first)


@given(st.lists(st.integers(-(2**31), 2**31 - 1), max_size=60))
def test_sorting_and_searching(values):
    WORLD.memory.write(AREA, struct.pack(f"<{len(values)}i", *values) or b"\0")
    machine = WORLD.machine
    compare = machine.reserve_functions(1)
    signed = [struct.Struct("<i").unpack]

    def order(a, b):
        first, second = (signed[0](WORLD.memory.read(at, 4))[0] for at in (a, b))
        return (first > second) - (first < second)

    machine.set_function(compare, machine.host_function(order, "II", "i"))
    WORLD.call("qsort", AREA, len(values), 4, compare, params="IIII", results="")
    found = struct.unpack(
        f"<{len(values)}i", WORLD.memory.read(AREA, 4 * len(values) or 1)[: 4 * len(values)]
    )
    assert list(found) == sorted(values)
    if values:
        key = AREA + 0x1000
        WORLD.memory.write(key, struct.pack("<i", values[0]))
        args = (key, AREA, len(values), 4, compare)
        at = WORLD.call("bsearch", *args, params="IIIII", results="I")
        assert found[(at - AREA) // 4] == values[0]


@pytest.mark.parametrize(
    ("name", "values", "reason"), [("abort", (), "abort"), ("exit", (1,), "exit was called")]
)
def test_the_end_of_a_program_is_a_fault(name, values, reason):
    with pytest.raises(MachineFault, match=reason):
        WORLD.call(name, *values, results="")


def test_an_assertion_that_does_not_hold_is_a_fault_with_its_text():
    with pytest.raises(MachineFault, match="assertion failed: x > 0"):
        WORLD.call("plc_assert", WORLD.text(AREA, b"assertion failed: x > 0"), results="")


def test_errors_have_texts():
    text = WORLD.call("strerror", 2, results="I")
    assert WORLD.read_text(text) == b"no such file or folder"
    assert WORLD.library.variable("errno")
    assert WORLD.library.variable("nothing") is None
