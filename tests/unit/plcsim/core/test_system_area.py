import mmap
import os

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import PAGE, SYSTEM_AREA, Memory
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
    area = Memory(PAGE).system
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
    area = Memory(PAGE).system
    area.end_program(why)
    assert area.verdict == text
    area.rearm()
    assert area.verdict == ""


def test_a_shared_page_is_seen_from_both_sides():
    fd = SystemArea.shared_file()
    try:
        scan, watchdog = SystemArea.of_file(fd), SystemArea.of_file(fd)
    finally:
        os.close(fd)
    assert scan.verdict == ""
    watchdog.end_program(STALLED)
    assert scan.verdict
    memory = Memory(PAGE, system_fd=None)
    assert not memory.system.verdict


def test_a_memory_takes_a_shared_page():
    fd = SystemArea.shared_file()
    memory = Memory(PAGE, fd)
    watchdog = SystemArea.of_file(fd)
    os.close(fd)
    watchdog.end_program(STALLED)
    assert memory.system.verdict


def test_the_release_time_of_the_context_is_the_cell():
    memory = Memory(PAGE)
    context = Context(memory, network=None)
    assert context.release_ns == 0
    context.release_ns = 2**62 + 1
    assert (memory.system.cells[RELEASE], context.release_ns) == (2**62 + 1, 2**62 + 1)


def test_a_page_of_its_own_lies_in_the_memory_s_file():
    memory = Memory(PAGE)
    memory.system.cells[RELEASE] = -7
    ((fd, _, size),) = memory.files
    with mmap.mmap(fd, size) as second:
        cell = second[SYSTEM_AREA + 8 * RELEASE :][:8]
    assert int.from_bytes(cell, "little", signed=True) == -7
    assert SIZE == PAGE


def test_a_shared_page_lies_on_top_of_the_memory_s_file():
    fd = SystemArea.shared_file()
    memory = Memory(PAGE, fd)
    os.close(fd)
    (_, _, _), (top, address, size) = memory.files
    assert (address, size) == (SYSTEM_AREA, SIZE)
    SystemArea.of_file(top).end_program(STALLED)
    assert memory.system.verdict
