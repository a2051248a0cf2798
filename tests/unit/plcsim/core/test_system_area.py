import ctypes
import os

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import PAGE, Memory
from plcsim.core.system_area import (
    BUDGET,
    RELEASE,
    SIZE,
    STALLED,
    STOPPED,
    UNLIMITED,
    SystemArea,
)


def test_the_low_word_tells_whether_a_program_may_run():
    assert UNLIMITED & 0xFFFF_FFFF == 0
    assert all(why & 0xFFFF_FFFF for why in (STALLED, STOPPED))


def test_a_new_page_lets_programs_run():
    area = SystemArea()
    assert (area.cells[BUDGET], area.verdict) == (UNLIMITED, "")


@pytest.mark.parametrize(
    ("why", "text"),
    [
        (STALLED, "the program did not return"),
        (STOPPED, "stopped by SIGINT"),
        (-12345, "the program did not return"),
    ],
)
def test_a_program_is_asked_to_end_until_it_is_rearmed(why, text):
    area = SystemArea()
    area.end_program(why)
    assert area.verdict == text
    area.rearm()
    assert area.verdict == ""


def test_a_shared_page_is_seen_from_both_sides():
    fd = SystemArea.shared()
    try:
        scan, watchdog = SystemArea(fd), SystemArea(fd)
    finally:
        os.close(fd)
    assert scan.verdict == ""
    watchdog.end_program(STALLED)
    assert scan.verdict
    memory = Memory(PAGE, system_fd=None)
    assert not memory.system.verdict


def test_a_memory_takes_a_shared_page():
    fd = SystemArea.shared()
    memory = Memory(PAGE, fd)
    watchdog = SystemArea(fd)
    os.close(fd)
    watchdog.end_program(STALLED)
    assert memory.system.verdict


def test_the_release_time_of_the_context_is_the_cell():
    memory = Memory(PAGE)
    context = Context(memory, network=None)
    assert context.release_ns == 0
    context.release_ns = 2**62 + 1
    assert (memory.system.cells[RELEASE], context.release_ns) == (2**62 + 1, 2**62 + 1)


def test_the_host_address_is_where_the_cells_lie():
    area = SystemArea()
    area.cells[RELEASE] = -7
    assert ctypes.c_int64.from_address(area.host_address() + 8 * RELEASE).value == -7
    assert SIZE == PAGE
