"""Facts of a host, read from a file system that shows another one."""

import os

import pytest

from plcsim.doctor.host import (
    CpuTicks,
    fifo_share_is_0,
    governors,
    hypervisor,
    preemption,
    quota_percent,
    read_cpu_ticks,
    read_host,
    read_load,
)


@pytest.fixture
def show(tmp_path):
    """``show(path, text)``: put a file of the kernel under the root of the other host."""

    def show(path, text):
        file = tmp_path / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    return show


@pytest.mark.parametrize(
    ("version", "expected"),
    [
        ("#1 SMP PREEMPT_RT Debian 6.12.1-1 (2025-01-01)", "PREEMPT_RT"),
        ("#1 SMP PREEMPT_DYNAMIC @0", "PREEMPT_DYNAMIC"),
        ("#1 SMP PREEMPT Thu Jan 1", "PREEMPT"),
        ("#1 SMP Thu Jan 1", "none"),
    ],
)
def test_the_preemption_model_stands_in_the_version(tmp_path, version, expected):
    assert preemption(version, tmp_path) == expected


def test_sys_kernel_realtime_tells_a_preempt_rt_kernel_too(tmp_path, show):
    show("sys/kernel/realtime", "1\n")
    assert preemption("#1 SMP PREEMPT RT", tmp_path) == "PREEMPT_RT"


def test_each_governor_is_named_once(tmp_path, show):
    for cpu, governor in enumerate(("powersave", "performance", "powersave")):
        show(f"sys/devices/system/cpu/cpu{cpu}/cpufreq/scaling_governor", f"{governor}\n")
    assert governors(tmp_path) == ("performance", "powersave")


def test_a_host_that_tells_nothing_has_no_governor_quota_or_hypervisor(tmp_path):
    assert governors(tmp_path) == ()
    assert quota_percent(tmp_path) is None
    assert hypervisor(tmp_path) == ""
    assert read_load(tmp_path) == 0
    assert read_cpu_ticks(tmp_path) == CpuTicks(0, 0)


def test_a_guest_is_known_by_the_flag_of_its_processor_and_named_by_dmi(tmp_path, show):
    show("proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu vme hypervisor lahf_lm\n")
    assert hypervisor(tmp_path) == "a hypervisor that does not name itself"
    show("sys/class/dmi/id/sys_vendor", "QEMU\n")
    show("sys/class/dmi/id/product_name", "Standard PC\n")
    assert hypervisor(tmp_path) == "QEMU Standard PC"
    show("sys/hypervisor/type", "xen\n")
    assert hypervisor(tmp_path) == "xen"


def test_real_hardware_is_not_a_guest_whatever_dmi_says(tmp_path, show):
    show("proc/cpuinfo", "flags\t\t: fpu vme\n")
    show("sys/class/dmi/id/sys_vendor", "Somebody\n")
    assert hypervisor(tmp_path) == ""


def test_the_tightest_quota_on_the_way_to_the_root_counts(tmp_path, show):
    show("proc/self/cgroup", "0::/a/b\n")
    show("sys/fs/cgroup/a/b/cpu.max", "max 100000\n")
    show("sys/fs/cgroup/a/cpu.max", "150000 100000\n")
    show("sys/fs/cgroup/cpu.max", "200000 100000\n")
    assert quota_percent(tmp_path) == 150


def test_a_quota_of_cgroups_version_1_is_read(tmp_path, show):
    show("proc/self/cgroup", "5:memory:/a\n4:cpu,cpuacct:/a\n")
    show("sys/fs/cgroup/cpu,cpuacct/a/cpu.cfs_quota_us", "50000\n")
    show("sys/fs/cgroup/cpu,cpuacct/a/cpu.cfs_period_us", "100000\n")
    show("sys/fs/cgroup/memory/a/cpu.max", "1 100000\n")
    assert quota_percent(tmp_path) == 50


def test_no_quota_of_version_1_is_minus_1(tmp_path, show):
    show("proc/self/cgroup", "4:cpu:/\n")
    show("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n")
    show("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n")
    assert quota_percent(tmp_path) is None


@pytest.mark.parametrize(("runtime", "forbidden"), [("0\n", True), ("950000\n", False)])
def test_a_cgroup_of_version_1_may_forbid_sched_fifo(tmp_path, show, runtime, forbidden):
    assert not fifo_share_is_0(tmp_path)
    show("proc/self/cgroup", "4:cpu:/docker/x\n")
    show("sys/fs/cgroup/cpu/docker/x/cpu.rt_runtime_us", runtime)
    assert fifo_share_is_0(tmp_path) is forbidden


def test_stolen_time_is_the_eighth_figure_and_guest_time_is_not_counted_twice(tmp_path, show):
    show("proc/stat", "cpu  10 0 5 70 0 1 2 12 9 9\ncpu0 1 1 1 1 1 1 1 1 1 1\n")
    assert read_cpu_ticks(tmp_path) == CpuTicks(stolen=12, total=100)


def test_the_stolen_share_is_that_of_the_time_between():
    later, earlier = CpuTicks(30, 400), CpuTicks(10, 200)
    assert later.stolen_percent_since(earlier) == pytest.approx(10)
    assert earlier.stolen_percent_since(earlier) == 0


def test_this_host_has_a_kernel_and_processors():
    host = read_host()
    assert host.kernel == os.uname().release
    assert 1 <= host.allowed <= host.cpus


def test_a_container_is_known_by_the_file_its_runtime_leaves(tmp_path, show):
    assert not read_host(tmp_path).container
    show("run/.containerenv", "")
    assert read_host(tmp_path).container
