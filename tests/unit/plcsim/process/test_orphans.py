"""Processes that programs start do not outlive the run."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from plcsim.process import orphans
from plcsim.process.orphans import Orphans, end_group

DAEMON = """
import os, subprocess, sys
null = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
daemon = subprocess.Popen(["sleep", "3600"], start_new_session=True, **null)
print(daemon.pid)
"""


def leave_a_daemon():
    """Start a process that leaves another one behind, outside its group; return its id."""
    return int(
        subprocess.run([sys.executable, "-c", DAEMON], capture_output=True, check=True).stdout
    )


def is_there(pid):
    return Path(f"/proc/{pid}").exists()


def test_a_daemon_is_ended():
    found = Orphans()
    daemon = leave_a_daemon()
    assert is_there(daemon)
    found.end()
    assert not is_there(daemon)


def test_children_from_before_are_left_alone():
    child = subprocess.Popen(["sleep", "3600"])
    Orphans().end()
    assert child.poll() is None
    child.kill()
    child.wait()


def test_after_it_orphans_are_no_children_of_ours():
    Orphans().end()
    daemon = leave_a_daemon()
    assert daemon not in orphans._children()
    os.kill(daemon, signal.SIGKILL)


def test_orphans_that_have_ended_are_let_go_of():
    found = Orphans()
    daemon = leave_a_daemon()
    found.reap()
    assert is_there(daemon)
    os.kill(daemon, signal.SIGKILL)
    os.waitid(os.P_PID, daemon, os.WEXITED | os.WNOWAIT)
    found.reap()
    assert not is_there(daemon)
    found.end()


def test_an_orphan_in_the_group_of_a_scan_is_let_go_of():
    found = Orphans()
    command = "sleep 3600 >&- & echo $!"
    leader = subprocess.Popen(["sh", "-c", command], stdout=subprocess.PIPE, process_group=0)
    left = int(leader.communicate()[0])
    os.kill(left, signal.SIGKILL)
    os.waitid(os.P_PID, left, os.WEXITED | os.WNOWAIT)
    found.reap()
    assert not is_there(left)
    found.end()


@pytest.mark.parametrize("group", [0, None])
def test_the_exit_code_of_what_was_started_here_is_not_taken_away(group):
    """Another run in this process has a scan and services, which lead groups of their own."""
    found = Orphans()
    started = subprocess.Popen(["sh", "-c", "exit 7"], process_group=group)
    os.waitid(os.P_PID, started.pid, os.WEXITED | os.WNOWAIT)
    found.reap()
    assert started.wait() == 7
    found.end()


def test_one_that_may_not_be_killed_is_left(monkeypatch):
    found = Orphans()
    daemon = leave_a_daemon()

    def refuse(*_):
        raise PermissionError

    with monkeypatch.context() as patch:
        patch.setattr(os, "kill", refuse)
        found.end()
    assert is_there(daemon)
    os.kill(daemon, signal.SIGKILL)
    os.waitpid(daemon, 0)


def test_a_group_is_ended_whose_leader_has_ended():
    command = "sleep 3600 & echo $!"
    leader = subprocess.Popen(["sh", "-c", command], stdout=subprocess.PIPE, process_group=0)
    left = int(leader.stdout.readline())
    os.waitid(os.P_PID, leader.pid, os.WEXITED | os.WNOWAIT)
    end_group(leader.pid)
    assert leader.stdout.read() == b""  # ends when nobody can write to it any more
    leader.communicate()
    end_group(leader.pid)  # there is none any more
    assert left
