"""What children print, on its way to the sinks."""

import gc
import os
import threading
from pathlib import Path

import pytest

from plcsim.process import output
from plcsim.process.output import Output, StreamSink


class Slow:
    """A sink with little room, that nobody empties but the test."""

    def __init__(self, room, *, whole_lines=False):
        self.whole_lines = whole_lines
        self.room = room
        self.taken = b""

    def put(self, data):
        assert len(data) <= self.room
        self.room -= len(data)
        self.taken += data

    def flush(self, patient):
        if patient():
            self.room += 4
        return 0


@pytest.fixture
def carrier(request):
    """``carrier(stdout, stderr, patient=...)``: an output and a child's two descriptors."""

    def carrier(stdout, stderr=None, **options):
        found = Output(stdout, stderr or Slow(1000), **options)
        request.addfinalizer(found.close)
        return found, found.child().fds

    return carrier


def test_both_streams_arrive_where_they_belong(carrier):
    out, err = Slow(1000), Slow(1000)
    found, fds = carrier(out, err)
    os.write(fds[0], b"to stdout \xff\x00")
    os.write(fds[1], b"to stderr")
    found.carry()
    assert (out.taken, err.taken) == (b"to stdout \xff\x00", b"to stderr")
    assert (found.lost, found.waits_for_reader) == (0, False)


def test_what_a_sink_has_no_room_for_is_lost_and_counted(carrier):
    out = Slow(6)
    found, fds = carrier(out)
    os.write(fds[0], b"0123456789")
    found.carry()
    os.write(fds[0], b"abc")
    assert found.flush() == 7
    assert out.taken == b"012345"
    assert not found.waits_for_reader


def test_on_the_virtual_clock_the_child_waits_and_nothing_is_lost(carrier):
    out = Slow(6)
    found, fds = carrier(out, patient=True)
    os.write(fds[0], b"0123456789")
    found.carry()
    assert (out.taken, found.waits_for_reader) == (b"012345", True)
    out.room = 100
    found.carry()
    assert (out.taken, found.waits_for_reader) == (b"0123456789", False)


def test_at_the_end_a_patient_output_waits_as_long_as_it_is_wanted(carrier):
    out = Slow(2)
    found, fds = carrier(out, patient=True)
    os.write(fds[0], b"0123456789")
    assert found.flush(lambda: True) == 0
    assert out.taken == b"0123456789"
    os.write(fds[0], b"more than there is room for")
    out.room = 2
    assert found.flush(lambda: False) == 0  # it stays in the pipe
    assert out.taken == b"0123456789mo"


def test_a_terminal_gets_whole_lines(carrier):
    out = Slow(1000, whole_lines=True)
    found, fds = carrier(out)
    os.write(fds[0], b"one\ntw")
    found.carry()
    assert out.taken == b"one\n"
    os.write(fds[0], b"o\nthree")
    found.carry()
    assert out.taken == b"one\ntwo\n"
    found.flush()
    assert out.taken == b"one\ntwo\nthree\n"


def test_a_line_that_does_not_end_is_cut(carrier):
    out = Slow(100_000, whole_lines=True)
    found, fds = carrier(out)
    os.write(fds[0], b"x" * output.LONGEST_LINE)
    found.carry()
    assert out.taken == b""
    os.write(fds[0], b"x")
    found.carry()
    assert out.taken == b"x" * (output.LONGEST_LINE + 1) + b"\n"


def test_what_several_children_print_is_not_mixed_in_a_line(carrier):
    out = Slow(1000, whole_lines=True)
    found, first = carrier(out)
    second = found.child().fds
    os.write(first[0], b"the first ")
    os.write(second[0], b"the second\n")
    found.carry()
    os.write(first[0], b"goes on\n")
    found.carry()
    assert out.taken == b"the second\nthe first goes on\n"


def test_the_descriptors_are_given_back():
    gc.collect()  # what others left open is not counted
    before = len(list(Path("/proc/self/fd").iterdir()))
    found = Output(Slow(1), Slow(1))
    found.child()
    found.close()
    assert len(list(Path("/proc/self/fd").iterdir())) == before


# a stream that a thread writes to


@pytest.fixture
def pipe():
    """The ends of a pipe."""
    fds = list(os.pipe())
    yield fds
    for fd in fds:
        os.close(fd)


@pytest.fixture(autouse=True)
def impatient(monkeypatch):
    monkeypatch.setattr(output, "PATIENCE_S", 0.05)


def test_a_stream_is_written_in_order(pipe):
    sink = StreamSink(pipe[1])
    sink.put(b"one ")
    sink.put(b"two")
    assert sink.flush(lambda: True) == 0
    assert os.read(pipe[0], 100) == b"one two"
    assert sink.room == output.ROOM


def fill(fd):
    """Fill a pipe to the last byte."""
    os.set_blocking(fd, False)
    filled = 0
    for size in (4096, 1):
        while True:
            try:
                filled += os.write(fd, b"x" * size)
            except BlockingIOError:
                break
    os.set_blocking(fd, True)
    return filled


def test_a_stream_that_nobody_reads_holds_up_nobody(pipe):
    filled = fill(pipe[1])
    sink = StreamSink(pipe[1])
    sink.put(b"lost")
    assert sink.flush(lambda: False) == 4
    assert sink.room == output.ROOM - 4
    reader = threading.Thread(target=os.read, args=(pipe[0], filled))
    reader.start()
    assert sink.flush(lambda: True) == 0
    reader.join()


def test_a_stream_that_does_not_block_is_written_all_the_same(pipe):
    filled = fill(pipe[1])
    os.set_blocking(pipe[1], False)
    sink = StreamSink(pipe[1])
    sink.put(b"late")
    os.read(pipe[0], filled)
    assert sink.flush(lambda: True) == 0
    assert os.read(pipe[0], 100) == b"late"


def test_a_reader_that_has_seen_enough_has_lost_nothing(pipe):
    os.dup2(os.open(os.devnull, os.O_RDONLY), pipe[0])
    sink = StreamSink(pipe[1])
    sink.put(b"nobody ")
    sink.put(b"wants this")
    assert sink.flush(lambda: True) == 0


def test_on_a_full_disk_output_is_lost():
    full = os.open("/dev/full", os.O_WRONLY)
    sink = StreamSink(full)
    sink.put(b"12345")
    assert sink.flush(lambda: True) == 5
    os.close(full)
