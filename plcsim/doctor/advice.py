"""What would make a host more punctual: one line each, only what applies, cheapest first."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.doctor.verdict import Verdict, judge

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.doctor.host import Host
    from plcsim.doctor.verdict import Comparison
    from plcsim.host.realtime import Rights

STOLEN_PERCENT = 1
"""From this share of stolen time on, the hypervisor is worth a word."""


def advise(host: Host, rights: Rights, comparisons: Sequence[Comparison]) -> list[str]:
    """Return the advice.

    Args:
        host: the facts.
        rights: what a fresh process gets.
        comparisons: what was measured; the last one with the best rights that the host gives.
    """
    lines = list(_about_rights(host, rights))
    if judge(comparisons[-1].scan) is not Verdict.HELD:
        stolen = max(m.stolen_percent for pair in comparisons for m in pair) >= STOLEN_PERCENT
        lines += _about_disturbers(host, stolen=stolen)
        if rights.complete:
            lines += _about_kernel(host)
    return lines


def _about_rights(host: Host, rights: Rights) -> Iterator[str]:
    refused = {right.partition(":")[0] for right in rights.refused}
    if "SCHED_FIFO" in refused and host.fifo_share_is_0:
        yield (
            "cgroup: this one gives no time to SCHED_FIFO (cpu.rt_runtime_us is 0), so no other "
            "right helps; docker run --cpu-rt-runtime=950000 gives some"
        )
    elif "SCHED_FIFO" in refused:
        if host.container:
            yield "container: start it with --cap-add SYS_NICE, or with --ulimit rtprio=98"
        yield (
            "ulimit: give your account 'rtprio 98' and 'memlock unlimited' in "
            "/etc/security/limits.conf and log in again; for this shell only: "
            "sudo prlimit --pid $$ --rtprio=98 --memlock=unlimited"
        )
        interpreter = Path(sys.executable).resolve()
        yield (
            "setcap: or give the right to everything this interpreter runs: "
            f"sudo setcap cap_sys_nice=ep {interpreter}"
        )
    if "locked memory" in refused:
        yield "ulimit: 'memlock unlimited' in /etc/security/limits.conf lets memory be locked"
    if "no deep sleep" in refused:
        yield "deep sleep: let your account write /dev/cpu_dma_latency (a udev rule)"
    if host.hypervisor and not host.tells_standstills:
        yield (
            "standstills: time for which this virtual machine stands still is taken for the "
            "program's; sudo sysctl kernel.perf_event_paranoid=1 lets it be told apart"
        )


def _about_disturbers(host: Host, *, stolen: bool) -> Iterator[str]:
    if set(host.governors) - {"performance"}:
        yield "governor: sudo cpupower frequency-set -g performance"
    if host.quota_percent is not None:
        yield (
            f"CPU quota: a cgroup stops the process beyond {host.quota_percent} % of a CPU; lift "
            "it (docker --cpus, systemd CPUQuota=, cpu.max)"
        )
    if stolen:
        yield "steal: the hypervisor gives the CPU to others; ask for dedicated CPUs"
    if host.load > host.cpus / 2:
        yield "chrt: start other work with chrt --idle 0 COMMAND, so that it gives way"
    if host.cpus == 1:
        yield "CPUs: on a single one everything else is in the way; add another"


def _about_kernel(host: Host) -> Iterator[str]:
    if host.cpus > 1 and not host.isolated:
        last = host.cpus - 1
        yield (
            f"isolcpus: boot with isolcpus={last} nohz_full={last} rcu_nocbs={last} and set "
            f"cpu = {last} in plc.toml, so that nothing else runs there"
        )
    if host.preemption != "PREEMPT_RT":
        yield (
            "kernel: PREEMPT_RT bounds what the kernel itself holds up (Debian: "
            "linux-image-rt-amd64, Ubuntu: sudo pro enable realtime-kernel)"
        )
