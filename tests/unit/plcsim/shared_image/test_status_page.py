"""The status page: what the scan writes, the parent reads."""

import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from plcsim.core.system import State
from plcsim.core.task import Cause, TaskClass
from plcsim.shared_image.status_page import SIZE, ClassStatus, ServiceState, StatusPage

MS = 1_000_000


@pytest.fixture
def pages():
    """The writer's page and the reader's, of one file."""
    writer = StatusPage()
    reader = StatusPage(os.dup(writer.fd))
    yield writer, reader
    writer.close()
    reader.close()


def task(index):
    return SimpleNamespace(index=index)


def test_a_new_page(pages):
    _, reader = pages
    assert (reader.state, reader.active, reader.heartbeat) == (State.BOOT, None, 0)
    assert reader.elapsed_ns == 0
    assert reader.of_class(8) == ClassStatus(*[0] * 11)


def test_what_runs_is_seen_and_every_act_is_a_heartbeat(pages):
    writer, reader = pages
    seen = []
    for act in (
        lambda: writer.changed(State.BOOT),
        lambda: writer.started(task(0)),
        lambda: writer.started(task(7)),
        lambda: writer.finished(TaskClass(1, 10 * MS, 0, [])),
        lambda: writer.started(task(2)),
        lambda: writer.changed(State.SERVICE),
    ):
        act()
        seen.append((reader.heartbeat, reader.active, reader.state))
    beats, active, states = zip(*seen, strict=True)
    assert list(beats) == sorted(set(beats))
    assert active == (None, 0, 7, None, 2, None)
    assert states[-1] is State.SERVICE


def test_the_figures_of_each_class_are_apart(pages):
    writer, reader = pages
    for number in range(1, 9):
        task_class = TaskClass(number, 10 * MS, 0, [])
        task_class.cycles = 100 * number
        task_class.missed = 100 * number + 1
        task_class.in_tolerance = 100 * number + 2
        causes = (Cause.PROGRAM, Cause.HOST, Cause.PREEMPTED)
        for extra, cause in [*enumerate(causes, 3), (10, Cause.CONTROLLER)]:
            task_class.violations[cause] = 100 * number + extra
        task_class.execution.record(100 * number + 7)
        task_class.execution.record(100 * number + 6)
        task_class.lateness.record(100 * number + 9)
        task_class.lateness.record(100 * number + 8)
        writer.finished(task_class)
    writer.ticked(2**63)
    for number in range(1, 9):
        status = reader.of_class(number)
        assert status == ClassStatus(*range(100 * number, 100 * number + 11))
        assert status.violations == 4 * 100 * number + 3 + 4 + 5 + 10
    assert reader.elapsed_ns == 2**63


def test_a_controller_writes_its_figures(pages, make_controller, task_class, program_of, clock):
    writer, reader = pages
    program = program_of(lambda _: clock.spend_ns(3 * MS))
    controller = make_controller(task_class(2, 10, a=program, b=program_of()), heartbeat=writer)
    controller.boot()
    controller.run(cycles=5)
    status = reader.of_class(2)
    assert (status.cycles, status.missed, status.violations) == (5, 0, 0)
    assert (status.execution_ns, status.longest_execution_ns) == (3 * MS, 3 * MS)
    assert (reader.state, reader.active) == (State.RUN, None)


WRITER = """
import os, sys
from types import SimpleNamespace
from plcsim.shared_image.status_page import StatusPage
page = StatusPage(int(sys.argv[1]))
number = 0
while True:
    number = number % 0xFFFF_FFFF + 1
    page.ticked(number << 32 | number)
    page.started(SimpleNamespace(index=number))
"""


def test_every_field_is_read_whole_while_another_process_writes():
    page = StatusPage()
    writer = subprocess.Popen([sys.executable, "-c", WRITER, str(page.fd)], pass_fds=[page.fd])
    try:
        while not page.heartbeat:
            pass
        last_heartbeat = 0
        for _ in range(50_000):
            time = page.elapsed_ns
            assert time >> 32 == time & 0xFFFF_FFFF
            active, heartbeat = page.active, page.heartbeat
            assert active is None or active <= heartbeat  # the heartbeat grows first
            assert heartbeat >= last_heartbeat
            last_heartbeat = heartbeat
    finally:
        writer.kill()
        writer.wait()
        page.close()
    assert last_heartbeat > 0


def test_something_else_is_no_status_page():
    fd = os.memfd_create("other")
    os.ftruncate(fd, SIZE)
    with pytest.raises(ValueError, match="not a status page"):
        StatusPage(fd)
    os.close(fd)


def test_closing_gives_the_descriptor_back():
    page = StatusPage()
    page.close()
    with pytest.raises(OSError, match="Bad file descriptor"):
        os.fstat(page.fd)


def test_how_the_services_do(pages):
    writer, reader = pages
    assert reader.service_state(7) is ServiceState.STARTING
    writer.note_service(7, ServiceState.FAILING)
    assert reader.service_state(7) is ServiceState.FAILING
    assert not reader.has_served(7)
    writer.note_service(7, ServiceState.SERVING)
    writer.note_service(7, ServiceState.FAILING)
    assert reader.has_served(7)
    assert not reader.has_served(6)
