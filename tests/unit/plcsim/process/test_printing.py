"""stdout and stderr of the scan process: a write never waits."""

import os
import subprocess
import sys

import pytest

from plcsim.process.printing import NeverWaiting

PAGE = 4096


@pytest.fixture
def pipe():
    """The ends of a pipe of one page."""
    import fcntl

    fds = os.pipe()
    fcntl.fcntl(fds[1], fcntl.F_SETPIPE_SZ, PAGE)
    yield fds
    for fd in fds:
        os.close(fd)


@pytest.fixture
def lost():
    return []


@pytest.fixture
def stream(pipe, lost):
    found = NeverWaiting(pipe[1], lost.append)
    yield found
    os.close(found.fileno())


def test_what_there_is_room_for_arrives(stream, pipe, lost):
    assert stream.write(b"line\n") == 5
    assert stream.write(bytearray(b"\xff\n")) == 2
    assert os.read(pipe[0], 100) == b"line\n\xff\n"
    assert lost == []
    assert stream.writable()


def test_what_there_is_no_room_for_is_lost_and_counted(stream, pipe, lost):
    assert stream.write(b"x" * PAGE) == PAGE
    assert stream.write(b"lost\n") == 5
    assert lost == [5]
    os.read(pipe[0], PAGE)
    stream.write(b"next\n")
    assert os.read(pipe[0], 100) == b"next\n"


def test_a_line_that_was_cut_is_ended_before_the_next(stream, pipe, lost):
    assert stream.write(b"y" * (PAGE + 904)) == PAGE + 904
    assert lost == [904]
    assert os.read(pipe[0], 2 * PAGE) == b"y" * PAGE
    stream.write(b"next\n")
    stream.write(b"and next\n")
    assert os.read(pipe[0], 100) == b"\nnext\nand next\n"


def test_without_a_reader_everything_is_lost(stream, pipe, lost):
    os.dup2(os.open(os.devnull, os.O_RDONLY), pipe[0])
    assert stream.write(b"gone") == 4
    assert lost == [4]


def test_others_that_write_to_the_pipe_may_wait(stream, pipe):
    assert os.get_blocking(pipe[1])
    assert not os.get_blocking(stream.fileno())


CHILD = """
import os, sys
from plcsim.process import printing
lost = []
printing.never_wait(lost.append)
print("letters \\u00e4 \\udcff")
print("to stderr", file=sys.stderr)
os.write(1, b"by its number\\n")
print("x" * 5_000_000)
print("the end")
os.write(2, b"%d" % sum(lost))
os._exit(0)
"""


def test_print_goes_there_line_by_line():
    """Nobody reads before the child has ended."""
    child = subprocess.Popen(
        [sys.executable, "-c", CHILD], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert child.wait(100) == 0
    out, err = child.communicate()
    first, second, _ = out.split(b"\n", 2)
    assert (first, second) == ("letters ä \\udcff".encode(), b"by its number")
    told, _, lost = err.partition(b"\n")
    assert told == b"to stderr"
    assert len(out) + int(lost) == len(first) + len(second) + 2 + 5_000_001 + len("the end\n")
