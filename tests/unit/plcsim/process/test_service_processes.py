"""When services are started, how often again, and what is said of those that never served."""

import os
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from plcsim.process import service_processes as module
from plcsim.process.output import Output
from plcsim.process.service_processes import ServiceProcesses
from plcsim.project.extension import Extension
from plcsim.shared_image.layout import HEADER_SIZE
from plcsim.shared_image.status_page import ServiceState, StatusPage

UNTIL_ASKED = """
import signal, time
signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGTERM])
time.sleep(60)
"""

IN_ORDER = """
import signal
from pathlib import Path
signal.sigwait([signal.SIGTERM])  # blocked, or this process is no more
Path(__file__).with_name("recorded").touch()
"""


class Web(Extension):
    """The extension of the table [web]."""


@pytest.fixture
def processes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[ServiceProcesses]:
    (tmp_path / "main_for_tests.py").write_text(UNTIL_ASKED)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setattr(module, "MAIN", "main_for_tests")
    monkeypatch.setattr(module, "services_of", lambda settings: settings)
    monkeypatch.setattr(module, "extensions", lambda: {"web": Web()})
    page = StatusPage()
    output = Output()
    made = ServiceProcesses({"web": "service_for_tests"}, page, output)
    yield made
    made.close()
    output.close()
    page.close()


def wait_for_end(processes: ServiceProcesses, *, kill: bool = True) -> None:
    process = processes._services[0]._process
    assert process is not None
    if kill:
        process.kill()
    deadline = time.monotonic() + 100
    while process.poll() is None:
        assert time.monotonic() < deadline
        time.sleep(0.001)


def test_a_service_starts_when_the_image_is_there_and_again_within_a_second(
    processes: ServiceProcesses,
) -> None:
    processes.tend(0)
    assert processes.starts == {"web": 0}
    os.ftruncate(processes.image_fd, HEADER_SIZE + 1)
    processes.tend(1)
    processes.tend(2)
    assert processes.starts == {"web": 1}
    wait_for_end(processes)
    ended_ns = 5_000_000_000
    processes.tend(ended_ns)
    assert processes.starts == {"web": 1}
    processes.tend(ended_ns + 100_000_000)
    assert processes.starts == {"web": 2}


def test_a_service_that_gives_up_is_started_less_and_less_often(
    processes: ServiceProcesses, tmp_path: Path
) -> None:
    (tmp_path / "main_for_tests.py").write_text("raise SystemExit(1)\n")
    os.ftruncate(processes.image_fd, HEADER_SIZE + 1)
    now_ns, pauses = 0, []
    for _ in range(4):
        processes.tend(now_ns)
        wait_for_end(processes, kill=False)
        before, starts = now_ns, processes.starts["web"]
        while processes.starts["web"] == starts:
            now_ns += 10_000_000
            processes.tend(now_ns)
        pauses.append((now_ns - before) // 1_000_000)
    assert pauses == [110, 210, 410, 810]


def test_a_service_that_ends_without_having_served_never_served(
    processes: ServiceProcesses,
) -> None:
    os.ftruncate(processes.image_fd, HEADER_SIZE + 1)
    processes.tend(0)
    assert processes.never_served == []  # it may need a moment yet
    wait_for_end(processes)
    processes.tend(1)
    assert processes.never_served == ["web"]
    page = processes._services[0]._page
    page.note_service(0, ServiceState.SERVING)
    assert processes.never_served == []
    page.note_service(0, ServiceState.FAILING)
    assert processes.never_served == []  # it has served before


@pytest.mark.parametrize("is_started", [True, False])
def test_a_service_that_is_asked_to_end_before_it_has_begun_does_its_work(
    processes: ServiceProcesses, tmp_path: Path, *, is_started: bool
) -> None:
    (tmp_path / "main_for_tests.py").write_text(IN_ORDER)
    os.ftruncate(processes.image_fd, HEADER_SIZE + 1)
    if is_started:
        processes.tend(0)
    fd = processes.image_fd

    processes.close()

    assert (tmp_path / "recorded").exists()
    with pytest.raises(OSError, match="Bad file descriptor"):
        os.fstat(fd)
