"""The processor of a scan: chosen, and held against other runs."""

import os
import subprocess
import sys

import pytest

from plcsim.host import processors
from plcsim.host.processors import claim, free_cpu, isolated, keep_off, missing_cpu

CPUS = sorted(os.sched_getaffinity(0))


@pytest.fixture(autouse=True)
def host(tmp_path, monkeypatch):
    """A host of three processors that nobody uses; ``hold(cpu)`` is another run on one of them."""
    for cpu in range(3):
        (tmp_path / f"cpu{cpu}").mkdir()
    monkeypatch.setattr(processors, "FOLDERS", tmp_path)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1, 2})
    held = []

    def hold(cpu):
        held.append(processors._lock(cpu))

    yield hold
    for fd in held:
        os.close(fd)


def test_the_last_is_taken_and_by_the_next_run_another():
    assert claim(None) == (2, "")
    assert claim(None) == (1, "")
    assert claim(None) == (0, "")
    assert claim(None) == (2, "CPU 2: every processor has another run on it")


def test_one_that_was_asked_for_is_taken_whoever_has_it(host):
    assert claim(0) == (0, "")
    host(1)
    assert claim(1) == (1, "CPU 1: another run has it as well")


def test_one_that_is_not_there_is_said_and_another_taken(host):
    host(2)
    assert claim(7) == (1, "")
    assert missing_cpu(7) == (
        "there is no processor 7 for the scan, only 0, 1, 2; one of them is taken"
    )
    assert [missing_cpu(cpu) for cpu in (None, 0, 1, 2)] == [""] * 4


def test_an_isolated_one_is_taken_where_it_was_asked_for(monkeypatch, tmp_path):
    """A process is on none of them before it asks (isolcpus=2-3)."""
    (tmp_path / "isolated").write_text("2-3\n")
    (tmp_path / "cpu3").mkdir()
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1})
    assert claim(3) == (3, "")
    assert missing_cpu(3) == missing_cpu(2) == ""
    assert missing_cpu(4) != ""
    assert claim(None) == (1, "")
    assert free_cpu() == 3


@pytest.mark.parametrize(
    ("text", "cpus"), [("\n", []), ("1\n", [1]), ("0,2-4,7\n", [0, 2, 3, 4, 7])]
)
def test_isolated_processors_are_read(tmp_path, text, cpus):
    (tmp_path / "isolated").write_text(text)
    assert isolated() == cpus


def test_the_only_one_is_not_claimed(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {2})
    assert claim(None) == (None, "")
    assert free_cpu() is None


def test_a_free_one_is_told_and_stays_free(host):
    assert free_cpu() == free_cpu() == 2
    host(2)
    assert free_cpu() == 1
    host(1)
    host(0)
    assert free_cpu() == 2


def test_a_host_that_does_not_show_its_processors_gives_the_last(monkeypatch, tmp_path):
    monkeypatch.setattr(processors, "FOLDERS", tmp_path / "nowhere")
    assert claim(None) == claim(None) == (2, "")
    assert free_cpu() == 2


CLAIM = """
import sys
from pathlib import Path
from plcsim.host import processors
processors.FOLDERS = Path(sys.argv[1])
processors.os.sched_getaffinity = lambda _: {0, 1, 2}
print(processors.claim(None)[0], flush=True)
sys.stdin.read()
"""


def test_a_claim_ends_with_its_process(tmp_path):
    def run():
        return subprocess.Popen(
            [sys.executable, "-c", CLAIM, tmp_path],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    first, second = run(), run()
    assert {first.stdout.readline(), second.stdout.readline()} == {"2\n", "1\n"}
    for process in (first, second):
        process.kill()
        process.communicate()
    assert free_cpu() == 2


@pytest.mark.skipif(len(CPUS) < 2, reason="needs two processors")
def test_the_parent_keeps_off_the_processor_of_the_scan(monkeypatch):
    monkeypatch.undo()
    try:
        keep_off(CPUS[-1])
        assert os.sched_getaffinity(0) == set(CPUS[:-1])
    finally:
        os.sched_setaffinity(0, CPUS)


def test_on_the_only_processor_the_parent_stays(monkeypatch):
    def refuse(*_):
        raise AssertionError

    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0})
    monkeypatch.setattr(os, "sched_setaffinity", refuse)
    keep_off(0)
