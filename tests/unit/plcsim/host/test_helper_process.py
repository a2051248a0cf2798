"""Work in a copy of this process."""

import os
import sys
import time

import pytest

from plcsim.host.helper_process import SharedNumbers, can_help, helper_process


def test_it_works_beside_and_its_end_can_be_waited_for(tmp_path):
    made = []

    def work():
        made.append(1)
        print("not to be seen")
        (tmp_path / "pid").write_text(str(os.getpid()))

    with helper_process(work) as wait:
        wait()
        wait()
        assert (tmp_path / "pid").read_text() != str(os.getpid())
    assert made == []


def test_how_it_ends_does_not_matter(capfd):
    def work():
        raise KeyboardInterrupt

    with helper_process(work) as wait:
        wait()
    assert capfd.readouterr() == ("", "")


def test_it_ends_with_the_block():
    begun, pid = os.pipe()

    def work():
        os.write(pid, os.getpid().to_bytes(8, "little"))
        time.sleep(60)

    def break_off():
        with helper_process(work):
            helpers.append(int.from_bytes(os.read(begun, 8), "little"))
            raise ValueError(1)

    helpers = []

    start = time.monotonic()
    with pytest.raises(ValueError, match="1"):
        break_off()
    assert time.monotonic() - start < 30
    with pytest.raises(ChildProcessError):
        os.waitpid(helpers[0], os.WNOHANG)
    os.close(begun)
    os.close(pid)


def test_one_processor_or_several_threads_have_no_helper(monkeypatch):
    monkeypatch.setattr(sys, "gettrace", lambda: None)
    monkeypatch.setattr("sys._current_frames", lambda: {1: None})
    monkeypatch.setattr(os, "sched_getaffinity", lambda _pid: {0, 1})
    assert can_help()
    monkeypatch.setattr("sys._current_frames", lambda: {1: None, 2: None})
    assert not can_help()
    monkeypatch.setattr("sys._current_frames", lambda: {1: None})
    monkeypatch.setattr(os, "sched_getaffinity", lambda _pid: {0})
    assert not can_help()


def test_copies_take_each_number_once(tmp_path):
    with SharedNumbers(300) as numbers:
        with helper_process(
            lambda: (tmp_path / "there").write_text(" ".join(map(str, numbers)))
        ) as wait:
            here = [*numbers]
            wait()
        there = [int(number) for number in (tmp_path / "there").read_text().split()]
        assert numbers.taken == 300
    assert sorted(here + there) == [*range(300)]
    assert here == sorted(here)
    assert there == sorted(there)
