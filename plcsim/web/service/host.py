"""What /proc tells of the processes of a run: their memory, rights and use of the processor."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Final

PROC: Final = Path("/proc")

_POLICIES: Final = {
    os.SCHED_OTHER: "other",
    os.SCHED_FIFO: "FIFO",
    os.SCHED_RR: "round robin",
    os.SCHED_BATCH: "batch",
    os.SCHED_IDLE: "idle",
}
_TICKS: Final = os.sysconf("SC_CLK_TCK")
_PAGE: Final = os.sysconf("SC_PAGE_SIZE")
_PACKAGES: Final = ("plcsim", "wasmtime", "numpy", "pymodbus", "starlette", "uvicorn", "websockets")


def processes(supervisor: int, names: dict[int, str]) -> list[dict[str, Any]]:
    """Return the processes of a run.

    Args:
        supervisor: its process id.
        names: of processes that are known, by process id.
    """
    found = []
    for pid in (supervisor, *_children(supervisor)):
        described = _process(pid, names.get(pid, ""))
        if described is not None:
            found.append(described)
    return found


def _children(pid: int) -> list[int]:
    """Return the processes that one has started, by whichever of its threads."""
    found: list[int] = []
    for task in (PROC / f"{pid}/task").glob("*/children"):
        with contextlib.suppress(OSError, ValueError):
            found += map(int, task.read_text().split())
    return found


def _process(pid: int, name: str) -> dict[str, Any] | None:
    """Return what is known of a process, None where it has gone."""
    try:
        stat = (PROC / f"{pid}/stat").read_text().rpartition(")")[2].split()
        words = (PROC / f"{pid}/cmdline").read_bytes().split(b"\0")
        status = dict(
            line.split(":", 1) for line in (PROC / f"{pid}/status").read_text().splitlines()
        )
        policy = _policy(pid)
    except OSError:
        return None
    resident = int(stat[21]) * _PAGE
    # a process that locks what it has locks addresses, too, behind which there is no memory yet
    locked = min(resident, int(status.get("VmLck", "0 kB").split()[0]) * 1024)
    return {
        "pid": pid,
        "name": name or _name(words),
        "cpu_s": (int(stat[11]) + int(stat[12])) / _TICKS,
        "rss": resident,
        "locked": locked,
        "policy": policy,
        "cpus": status.get("Cpus_allowed_list", "").strip(),
        "threads": int(stat[17]),
    }


def _policy(pid: int) -> str:
    """Return how a process is scheduled, with its priority where that counts (sched(7))."""
    policy = os.sched_getscheduler(pid) & ~os.SCHED_RESET_ON_FORK
    priority = os.sched_getparam(pid).sched_priority
    return _POLICIES.get(policy, str(policy)) + (f" {priority}" if priority else "")


def _name(words: list[bytes]) -> str:
    text = [word.decode("utf-8", "replace") for word in words]
    modules = [text[i + 1] for i, word in enumerate(text[:-1]) if word == "-m"]
    if modules and modules[0].endswith("service_main"):
        with contextlib.suppress(ValueError, KeyError, TypeError, IndexError):
            return str(json.loads(text[text.index(modules[0]) + 2])["table"])
    return modules[0] if modules else Path(text[0]).name


@cache
def versions() -> dict[str, str]:
    """Return the versions of what runs here."""
    found = {"Python": ".".join(map(str, sys.version_info[:3])), "Linux": os.uname().release}
    for package in _PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found
