"""What /proc tells of the processes of a run."""

import os
import sys

import pytest

from plcsim.web.service import host

PAGE = os.sysconf("SC_PAGE_SIZE")
TICKS = os.sysconf("SC_CLK_TCK")

SERVICE = ["python", "-P", "-m", "plcsim.process.service_main", "plcsim.web.service"]


class Kernel:
    """Tells of processes that are not there."""

    def __init__(self, folder, patch):
        self.folder = folder
        self.policies = {}
        patch.setattr(host, "PROC", folder)
        patch.setattr(os, "sched_getscheduler", lambda pid: self.policies[pid][0])
        patch.setattr(os, "sched_getparam", lambda pid: os.sched_param(self.policies[pid][1]))

    def add(self, pid, words, *, children=(), policy=(os.SCHED_OTHER, 0), pages=100, locked_kib=0):
        """Add a process as proc(5) describes it; its name has what separates fields."""
        place = self.folder / str(pid)
        (place / "task" / str(pid)).mkdir(parents=True)
        (place / "task" / str(pid) / "children").write_text("".join(f"{c} " for c in children))
        fields = ["S", *["0"] * 10, str(3 * TICKS), str(TICKS), *["0"] * 4, "2", *["0"] * 3]
        (place / "stat").write_text(f"{pid} (a) b (c) {' '.join(fields)} {pages} 0\n")
        (place / "cmdline").write_bytes(b"".join(word.encode() + b"\0" for word in words))
        (place / "status").write_text(
            f"Name:\ta) b\nVmLck:\t{locked_kib} kB\nCpus_allowed_list:\t0-1\n"
        )
        self.policies[pid] = policy


@pytest.fixture
def kernel(tmp_path, monkeypatch):
    return Kernel(tmp_path, monkeypatch)


def test_a_run_is_the_supervisor_and_what_it_has_started(kernel):
    kernel.add(10, ["plcsim", "run"], children=[11, 12])
    kernel.add(11, ["python", "-m", "plcsim.process.scan_process", "{}"])
    kernel.add(12, [*SERVICE, '{"table": "web"}'])
    told = host.processes(10, {10: "supervisor"})
    names = ["supervisor", "plcsim.process.scan_process", "web"]
    assert [(p["pid"], p["name"]) for p in told] == list(zip([10, 11, 12], names, strict=True))
    assert told[1] == {
        "pid": 11, "name": "plcsim.process.scan_process", "cpu_s": 4.0, "rss": 100 * PAGE,
        "locked": 0, "policy": "other", "cpus": "0-1", "threads": 2,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("policy", "told"),
    [
        ((os.SCHED_OTHER, 0), "other"),
        ((os.SCHED_FIFO, 50), "FIFO 50"),
        ((os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, 50), "FIFO 50"),  # as a scan has it
        ((os.SCHED_RR, 7), "round robin 7"),
        ((6, 0), "6"),
    ],
)
def test_the_policy_is_told_whatever_children_inherit(kernel, policy, told):
    kernel.add(10, ["plcsim"], policy=policy)
    assert host.processes(10, {})[0]["policy"] == told


def test_no_more_memory_is_told_as_locked_than_is_there(kernel):
    kernel.add(10, ["plcsim"], pages=100, locked_kib=4 << 20, children=[11])
    kernel.add(11, ["plcsim"], pages=100, locked_kib=64)
    assert [p["locked"] for p in host.processes(10, {})] == [100 * PAGE, 64 * 1024]


@pytest.mark.parametrize("order", ["", "[]", "{", '{"table"}'])
def test_a_service_whose_order_is_not_understood_has_its_module_as_name(kernel, order):
    kernel.add(10, [*SERVICE, order])
    assert host.processes(10, {})[0]["name"] == "plcsim.process.service_main"


def test_a_process_that_goes_meanwhile_is_left_out(kernel):
    kernel.add(10, ["plcsim"], children=[11])
    assert [p["pid"] for p in host.processes(10, {})] == [10]
    assert host.processes(12, {}) == []


def test_versions_are_those_of_what_is_there():
    assert host.versions()["Python"] == ".".join(map(str, sys.version_info[:3]))
    assert "plcsim" in host.versions()
