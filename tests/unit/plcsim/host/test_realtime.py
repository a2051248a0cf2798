"""Real-time rights: what is taken, what is refused in words, and that processors are given back."""

import ctypes
import gc
import os
import resource
import signal
import subprocess
import sys

import pytest

from plcsim.host import garbage, processors, realtime
from plcsim.host.realtime import Rights


@pytest.fixture
def scheduler(monkeypatch, tmp_path):
    """A host that gives everything; what was asked for is noted."""
    asked = []
    monkeypatch.setattr(os, "sched_setscheduler", lambda *given: asked.append(given))
    monkeypatch.setattr(os, "sched_setaffinity", lambda *given: asked.append(given))
    monkeypatch.setattr(realtime, "_lock_memory", lambda granted, _: granted.append("memory"))
    monkeypatch.setattr(realtime, "_stay_awake", lambda granted, _: granted.append("awake"))
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1, 2})
    monkeypatch.setattr(processors, "FOLDERS", tmp_path)  # no run of this host is in the way
    return asked


def refuse(*_):
    raise PermissionError(1, "Operation not permitted")


def test_what_is_given_is_said(scheduler):
    rights = realtime.acquire(50, None)
    assert rights == Rights(("SCHED_FIFO 50", "CPU 2", "memory", "awake"), (), 2)
    assert rights.complete
    assert scheduler[0][:2] == (0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK)
    assert scheduler[0][2].sched_priority == 50
    assert scheduler[1] == (0, {2})


def test_the_processor_can_be_chosen(scheduler):
    assert "CPU 0" in realtime.acquire(50, 0).granted
    assert scheduler[1] == (0, {0})


def test_without_the_scheduler_nothing_else_is_taken(scheduler, monkeypatch):
    monkeypatch.setattr(os, "sched_setscheduler", refuse)
    rights = realtime.acquire(50, None)
    assert rights == Rights((), ("SCHED_FIFO: Operation not permitted",))
    assert not rights.complete
    assert scheduler == []


def test_a_processor_that_is_refused_does_not_matter(scheduler, monkeypatch):
    monkeypatch.setattr(os, "sched_setaffinity", refuse)
    rights = realtime.acquire(50, 1)
    assert rights.complete
    assert rights.refused == ("CPU 1: Operation not permitted",)
    assert rights.cpu is None


def test_a_processor_that_is_not_there_is_said_and_another_taken(scheduler):
    rights = realtime.acquire(50, 7)
    (refused,) = rights.refused
    assert refused.startswith("there is no processor 7 for the scan")
    assert scheduler[1] == (0, {2})


def test_a_processor_that_another_run_has_is_said(scheduler, monkeypatch):
    monkeypatch.setattr(processors, "claim", lambda _: (0, "CPU 0: another run has it as well"))
    rights = realtime.acquire(50, 0)
    assert rights.refused == ("CPU 0: another run has it as well",)
    assert rights.cpu == 0


class Libc:
    """A kernel that locks what it is asked to, but for flags that it does not know."""

    def __init__(self, *unknown):
        self.unknown = unknown
        self.asked = []

    def mlockall(self, flags):
        self.asked.append(flags)
        return -(flags in self.unknown)


CURRENT, FUTURE, ONFAULT = 1, 2, 4
UNLIMITED = (resource.RLIM_INFINITY, resource.RLIM_INFINITY)


@pytest.mark.parametrize(
    ("unknown", "asked", "granted"),
    [
        ((), [CURRENT, FUTURE | ONFAULT], True),
        ((FUTURE | ONFAULT,), [CURRENT, FUTURE | ONFAULT, CURRENT | FUTURE], True),
        ((CURRENT,), [CURRENT], False),
    ],
)
def test_later_memory_is_locked_as_it_is_touched_where_the_kernel_can(
    monkeypatch, unknown, asked, granted
):
    libc = Libc(*unknown)
    monkeypatch.setattr(realtime, "_libc", libc)
    monkeypatch.setattr(resource, "getrlimit", lambda _: UNLIMITED)
    given, refused = [], []
    realtime._lock_memory(given, refused)
    assert libc.asked == asked
    assert (given == ["locked memory"], bool(refused)) == (granted, not granted)


@pytest.mark.parametrize(
    ("limit", "status", "granted"),
    [
        (65536, "Name:\tpython\nCapEff:\t0000000000800000\n", False),  # CAP_SYS_NICE alone
        (65536, "Name:\tpython\nCapEff:\t0000000000804000\n", True),  # and CAP_IPC_LOCK
        (65536, "Name:\tpython\n", False),
        (65536, None, False),
        (resource.RLIM_INFINITY, "CapEff:\t0000000000000000\n", True),
    ],
)
def test_memory_is_locked_only_where_no_limit_stops_a_later_allocation(
    monkeypatch, tmp_path, limit, status, granted
):
    monkeypatch.setattr(realtime, "PROCESS_STATUS", tmp_path / "status")
    monkeypatch.setattr(realtime, "_libc", Libc())
    monkeypatch.setattr(resource, "getrlimit", lambda _: (limit, limit))
    if status is not None:
        (tmp_path / "status").write_text(status)
    given, refused = [], []
    realtime._lock_memory(given, refused)
    assert given == ["locked memory"] * granted
    assert refused == ["locked memory: the limit is 64 KiB"] * (not granted)


@pytest.mark.parametrize(
    ("policy", "held"),
    [
        (os.SCHED_OTHER, False),
        (os.SCHED_FIFO, True),
        (os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, True),
        (os.SCHED_BATCH | os.SCHED_RESET_ON_FORK, False),
    ],
)
def test_it_is_known_whether_rights_are_held(monkeypatch, policy, held):
    monkeypatch.setattr(os, "sched_getscheduler", lambda _: policy)
    assert realtime.is_held() is held


def test_timers_are_sharpened():
    get_timer_slack = 30
    libc = ctypes.CDLL(None)
    before = libc.prctl(get_timer_slack)
    try:
        realtime.sharpen_timers()
        assert libc.prctl(get_timer_slack) == 1
    finally:
        libc.prctl(29, before)


def test_after_init_nothing_is_collected_by_itself():
    try:
        realtime.settle(Rights((), ()))
        assert not gc.isenabled()
    finally:
        garbage.thaw()


@pytest.mark.parametrize("locked", [True, False])
def test_what_init_has_made_is_laid_out_where_memory_is_locked(monkeypatch, locked):
    libc = Libc()
    monkeypatch.setattr(realtime, "_libc", libc)
    monkeypatch.setattr(garbage, "freeze", lambda: None)
    realtime.settle(Rights((realtime.LOCKED_MEMORY,) * locked, ()))
    assert libc.asked == [CURRENT, FUTURE | ONFAULT] * locked


CHILD = """
import os, signal, sys, time
from plcsim.host.realtime import die_with_parent
die_with_parent(signal.SIGKILL, int(sys.argv[1]))
print("alive", flush=True)
time.sleep(60)
"""


def test_a_process_whose_parent_has_gone_already_ends_at_once():
    gone = subprocess.run([sys.executable, "-c", CHILD, "1"], capture_output=True, check=False)
    assert (gone.returncode, gone.stdout) == (-signal.SIGKILL, b"")


def test_a_process_ends_with_its_parent():
    middle = f"""
import os, subprocess, sys
subprocess.Popen([sys.executable, "-c", {CHILD!r}, str(os.getpid())])
sys.stdin.read()
"""
    parent = subprocess.Popen(
        [sys.executable, "-c", middle], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    assert parent.stdout.readline() == b"alive\n"
    parent.kill()
    parent.communicate(timeout=100)  # ends when the child cannot write to it any more
