"""Whether a process waits by itself, or for a processor."""

import subprocess
import sys
import time

import pytest

from plcsim.host.scheduling import processor_ns

LONG_S = 60


def until(is_so):
    """Wait until something is so, for a busy host may take its time."""
    end = time.monotonic() + LONG_S
    while not is_so():
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.fixture
def process():
    started = []

    def start(code):
        run = subprocess.Popen(
            [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        started.append(run)
        return run

    yield start
    for run in started:
        run.kill()
        run.communicate()


def test_a_process_that_could_go_on_has_its_processor_time(process):
    busy = process("while True: pass")
    until(lambda: (processor_ns(busy.pid) or 0) > 200_000_000)


def test_a_process_that_waits_by_itself_has_none(process):
    idle = process("print('ready', flush=True); input()")
    idle.stdout.readline()
    until(lambda: processor_ns(idle.pid) is None)


def test_a_process_that_is_not_there_has_none(process):
    gone = process("")
    gone.communicate()
    assert processor_ns(gone.pid) is None
