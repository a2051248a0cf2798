import os
import subprocess
import sys
import textwrap

import pytest

from plcsim.shared_image import (
    CommandRefused,
    ImageError,
    ImageNotReady,
    ImageReader,
    Mask,
    ScanWatch,
    Write,
    layout,
)
from plcsim.shared_image.layout import make_file

from .conftest import MS, World


def test_before_the_first_publish_there_is_nothing_to_read(world: World) -> None:
    assert world.reader.latest == 0
    with pytest.raises(ImageNotReady, match="published"):
        world.reader.copy(0, 4)


def test_an_empty_file_is_not_ready_yet() -> None:
    fd = make_file()
    with pytest.raises(ImageNotReady, match="not made"):
        ImageReader(fd)
    os.ftruncate(fd, 8192)
    with pytest.raises(ImageNotReady, match="not made"):
        ImageReader(fd)
    os.pwrite(fd, b"\x07" * 8, 0)
    with pytest.raises(ImageError, match="version"):
        ImageReader(fd)
    os.close(fd)


def test_a_bank_that_is_written_meanwhile_is_not_taken(world: World) -> None:
    world.controller.run(cycles=1)
    bank = world.reader.latest & 1
    world.writer._cells[layout.CELL_BEGIN[bank]] = world.reader.latest + 2
    with pytest.raises(ImageError, match="faster"):
        world.reader.copy(0, 4)


def test_a_bank_that_was_not_finished_is_not_taken(world: World) -> None:
    world.controller.run(cycles=1)
    bank = world.reader.latest & 1
    world.writer._cells[layout.CELL_END[bank]] = 0
    with pytest.raises(ImageError, match="faster"):
        world.reader.copy(0, 4)


def test_a_changed_layout_stops_reading_and_writing(world: World) -> None:
    world.controller.run(cycles=1)
    world.writer._cells[layout.CELL_HASH] = world.reader.layout_hash ^ 1
    with pytest.raises(ImageError, match="layout"):
        world.reader.copy(0, 4)
    with pytest.raises(ImageError, match="layout"):
        world.write("fast.word", b"\1\0")


def test_a_command_of_too_many_operations_is_refused(world: World) -> None:
    address = world.address("fast.word")
    with pytest.raises(CommandRefused, match="too long"):
        world.reader.send(Write(tuple(Mask(address, 0, 1) for _ in range(3000))))


def test_a_scan_that_stands_still_is_seen() -> None:
    watch = ScanWatch(cycle_ns=1 * MS)
    assert watch.is_alive(1, 0)
    assert watch.is_alive(1, 250 * MS)
    assert not watch.is_alive(1, 251 * MS)
    assert watch.is_alive(2, 252 * MS)


def test_a_slow_scan_is_given_three_cycles() -> None:
    watch = ScanWatch(cycle_ns=1000 * MS)
    watch.is_alive(1, 0)
    assert watch.is_alive(1, 3000 * MS)
    assert not watch.is_alive(1, 3001 * MS)


READER = """
import sys
from plcsim.shared_image import ImageReader
reader = ImageReader(int(sys.argv[1]))
tag = reader.directory.find("fast.count")
place = reader.directory.offset_of(tag.address, 4)
copy = reader.directory.find("fast.copy").address - tag.address
print("ready", flush=True)
torn = 0
seen = set()
while len(seen) < 2000:
    data = reader.copy(place, place + 8)[1]
    torn += data[:4] != data[copy : copy + 4]
    seen.add(data[:4])
print(torn, len(seen))
"""


def test_another_process_never_sees_half_a_scan(world: World) -> None:
    world.controller.run(cycles=1)
    with subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(READER), str(world.fd)],
        pass_fds=[world.fd],
        stdout=subprocess.PIPE,
        text=True,
    ) as reader:
        assert reader.stdout is not None
        assert reader.stdout.readline() == "ready\n"
        while reader.poll() is None:
            world.controller.run(cycles=1000)
        torn, seen = map(int, reader.stdout.read().split())
    assert torn == 0
    assert seen == 2000
