"""Work in a copy of this process."""

import os
import sys
import time

import pytest

from plcsim.host import helper_process as helper_module
from plcsim.host.helper_process import SharedNumbers, can_help, helper_process, share


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
    monkeypatch.setattr("plcsim.host.realtime.is_held", lambda: True)
    assert not can_help()
    monkeypatch.setattr("plcsim.host.realtime.is_held", lambda: False)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _pid: {0})
    assert not can_help()


def test_copies_take_each_number_once(tmp_path):
    with SharedNumbers(3000) as numbers:
        with helper_process(
            lambda: (tmp_path / "there").write_text(" ".join(map(str, numbers)))
        ) as wait:
            here = [*numbers]
            wait()
        there = [int(number) for number in (tmp_path / "there").read_text().split()]
        assert numbers.taken == 3000
    assert sorted(here + there) == [*range(3000)]
    assert here == sorted(here)
    assert there == sorted(there)


def test_jobs_are_shared_once_one_is_new_and_each_is_done(monkeypatch, tmp_path):
    """The third is the first that is new; the fourth waits here until the copy has done one."""
    monkeypatch.setattr(helper_module, "can_help", lambda: True)
    told = []

    def do(number):
        (tmp_path / f"{number} {os.getpid()}").touch()
        limit = time.monotonic() + 100
        while number > 2 and len({f.name.split()[1] for f in tmp_path.iterdir()}) < 2:
            assert time.monotonic() < limit
            time.sleep(0.001)  # the other process tells by files only
        return number == 2

    share(9, do, told.append)
    done = [file.name.split() for file in tmp_path.iterdir()]
    assert sorted(int(number) for number, _ in done) == [*range(9)]
    assert {pid for number, pid in done if int(number) < 3} == {str(os.getpid())}
    assert len({pid for _, pid in done}) == 2
    assert told == sorted(told)


def test_what_is_known_is_not_shared(monkeypatch):
    monkeypatch.setattr(helper_module, "can_help", lambda: True)
    monkeypatch.setattr(helper_module, "helper_process", lambda _work: pytest.fail("a helper"))
    done = []
    share(9, lambda number: done.append(number) or False, lambda _taken: None)
    share(7, lambda number: done.append(number) or True, lambda _taken: None)
    assert done == [*range(9), *range(7)]
