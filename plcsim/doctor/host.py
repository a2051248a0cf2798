"""What decides how punctual a host is, as its kernel tells it.

Every function takes the root of the file system, so that tests can show it another host.
"""

from __future__ import annotations

import os
import platform
import re
import resource
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from plcsim.host import processors
from plcsim.host.running_time import tells_standstills

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path("/")

_CONTAINER_FILES = (".dockerenv", "run/.containerenv")


@dataclass(frozen=True)
class Host:
    """A host in facts.

    Attributes:
        kernel: release of the kernel.
        preemption: PREEMPT_RT, PREEMPT_DYNAMIC, PREEMPT, or "none".
        python: implementation and version of this interpreter.
        cpu_model: as /proc/cpuinfo names it, "" where it does not.
        cpus: processors that are online.
        allowed: processors that this process may use.
        isolated: processors kept free of other work, such as "2-3"; "" for none.
        governors: frequency governors in use; empty where the kernel does not scale frequencies.
        hypervisor: what the machine is a guest of, "" on real hardware.
        container: whether this process runs in a container.
        cpu: the one that is measured, with real-time rights; None for any.
        quota_percent: CPU time a cgroup allows, 100 for one processor; None without a quota.
        fifo_share_is_0: a cgroup of version 1 gives no time to SCHED_FIFO, whoever asks.
        rtprio_limit: RLIMIT_RTPRIO, the highest SCHED_FIFO priority without privilege, -1 for any.
        memlock_limit: RLIMIT_MEMLOCK in bytes, -1 for no limit.
        tells_standstills: time for which the machine stands still is not taken for the program's.
        load: programs that want to run, mean of the last minute.
    """

    kernel: str
    preemption: str
    python: str
    cpu_model: str
    cpus: int
    allowed: int
    isolated: str
    governors: tuple[str, ...]
    hypervisor: str
    container: bool
    cpu: int | None
    quota_percent: int | None
    fifo_share_is_0: bool
    rtprio_limit: int
    memlock_limit: int
    tells_standstills: bool
    load: float


class CpuTicks(NamedTuple):
    """CPU time of the whole machine since boot, in ticks of the kernel (proc(5), /proc/stat)."""

    stolen: int
    total: int

    def stolen_percent_since(self, earlier: CpuTicks) -> float:
        """Return the share of CPU time that the hypervisor gave to others since ``earlier``."""
        total = self.total - earlier.total
        return 100 * (self.stolen - earlier.stolen) / total if total else 0.0


def read_host(root: Path = ROOT) -> Host:
    """Return the facts of this host."""
    name = os.uname()
    return Host(
        kernel=name.release,
        preemption=preemption(name.version, root),
        python=f"{platform.python_implementation()} {platform.python_version()}",
        cpu_model=_cpu_field("model name", root),
        cpus=os.cpu_count() or 1,
        allowed=len(os.sched_getaffinity(0)),
        isolated=_text(root / "sys/devices/system/cpu/isolated"),
        governors=governors(root),
        hypervisor=hypervisor(root),
        container=any((root / file).exists() for file in _CONTAINER_FILES),
        cpu=processors.free_cpu(),
        quota_percent=quota_percent(root),
        fifo_share_is_0=fifo_share_is_0(root),
        rtprio_limit=resource.getrlimit(resource.RLIMIT_RTPRIO)[0],
        memlock_limit=resource.getrlimit(resource.RLIMIT_MEMLOCK)[0],
        tells_standstills=tells_standstills(),
        load=read_load(root),
    )


def read_load(root: Path = ROOT) -> float:
    """Return the load average of the last minute, 0 where the kernel does not tell."""
    return float(_text(root / "proc/loadavg").partition(" ")[0] or 0)


def read_cpu_ticks(root: Path = ROOT) -> CpuTicks:
    """Return the first line of /proc/stat; both 0 where there is none."""
    first = _text(root / "proc/stat").partition("\n")[0].split()
    ticks = [int(field) for field in first[1:9]]  # guest time, fields 9 and 10, is in user time
    return CpuTicks(ticks[7] if len(ticks) == 8 else 0, sum(ticks))


def preemption(version: str, root: Path = ROOT) -> str:
    """Return the preemption model in the kernel's version text (uname -v), "none" without one."""
    if _text(root / "sys/kernel/realtime") == "1":
        return "PREEMPT_RT"
    found = re.search(r"PREEMPT\w*", version)
    return found[0] if found else "none"


def governors(root: Path = ROOT) -> tuple[str, ...]:
    """Return the frequency governors in use, each once."""
    files = root.glob("sys/devices/system/cpu/cpu[0-9]*/cpufreq/scaling_governor")
    return tuple(sorted({_text(file) for file in files} - {""}))


def hypervisor(root: Path = ROOT) -> str:
    """Return what the machine is a guest of, "" where nothing says that it is one."""
    kind = _text(root / "sys/hypervisor/type")
    if not kind and "hypervisor" not in _cpu_field("flags", root).split():
        return ""
    dmi = root / "sys/class/dmi/id"
    names = (_text(dmi / "sys_vendor"), _text(dmi / "product_name"))
    return kind or " ".join(filter(None, names)) or "a hypervisor that does not name itself"


def quota_percent(root: Path = ROOT) -> int | None:
    """Return the tightest CPU quota of the cgroups this process is in (cgroups(7), v1 and v2)."""
    shares = [share for folder in _cgroups(root) if (share := _quota_of(folder)) is not None]
    return min(shares, default=None)


def fifo_share_is_0(root: Path = ROOT) -> bool:
    """Return True where a cgroup forbids SCHED_FIFO: it then fails for root, too (sched(7))."""
    return any(_text(folder / "cpu.rt_runtime_us") == "0" for folder in _cgroups(root))


def _cgroups(root: Path) -> Iterator[Path]:
    """Iterate over the folders of the cgroups that rule this process' CPU time."""
    mounts = root / "sys/fs/cgroup"
    for line in _text(root / "proc/self/cgroup").splitlines():
        _, controllers, path = line.split(":", 2)
        if controllers and "cpu" not in controllers.split(","):
            continue
        folder = mounts / controllers / path.lstrip("/")
        while folder.is_relative_to(mounts):
            yield folder
            folder = folder.parent


def _quota_of(folder: Path) -> int | None:
    quota, _, period = _text(folder / "cpu.max").partition(" ")
    if not quota:
        quota = _text(folder / "cpu.cfs_quota_us")
        period = _text(folder / "cpu.cfs_period_us")
    if quota.isdecimal() and period.isdecimal() and int(period):
        return 100 * int(quota) // int(period)
    return None


def _cpu_field(name: str, root: Path) -> str:
    found = re.search(rf"^{name}\s*: (.*)$", _text(root / "proc/cpuinfo"), re.MULTILINE)
    return found[1].strip() if found else ""


def _text(file: Path) -> str:
    """Return what a file of the kernel says, "" where there is none to read."""
    try:
        return file.read_text("utf-8", "replace").strip()
    except OSError:
        return ""
