"""Only the advice that applies."""

from dataclasses import replace

import pytest

from plcsim.doctor.advice import advise
from plcsim.doctor.verdict import Comparison
from plcsim.host.realtime import Rights

ALL = Rights(("SCHED_FIFO 50", "CPU 3", "locked memory", "no deep sleep"), ())
NONE = Rights((), ("SCHED_FIFO: Operation not permitted",))


def subjects(lines):
    return [line.partition(":")[0] for line in lines]


def test_a_host_that_holds_the_tick_with_all_rights_needs_no_advice(host, punctual):
    slow = replace(host, governors=("powersave",), preemption="none", isolated="", load=9.0)
    assert advise(slow, ALL, [punctual]) == []


def test_a_good_host_that_is_late_all_the_same_gets_no_advice_that_does_not_apply(host, late):
    assert advise(host, ALL, [late]) == []


def test_without_sched_fifo_there_are_two_ways_to_it(host, punctual):
    lines = advise(host, NONE, [punctual])
    assert subjects(lines) == ["ulimit", "setcap"]
    assert "prlimit --pid $$ --rtprio=98" in lines[0]
    assert "setcap cap_sys_nice=ep" in lines[1]


def test_a_virtual_machine_whose_standstills_look_like_work_is_told(host, punctual):
    blind = replace(host, tells_standstills=False)
    assert advise(blind, ALL, [punctual]) == []
    guest = replace(blind, hypervisor="KVM")
    assert subjects(advise(guest, ALL, [punctual])) == ["standstills"]


def test_in_a_container_the_way_through_its_runtime_comes_first(host, punctual):
    lines = advise(replace(host, container=True), NONE, [punctual])
    assert subjects(lines) == ["container", "ulimit", "setcap"]


def test_a_cgroup_that_forbids_it_to_everybody_is_named_alone(host, punctual):
    lines = advise(replace(host, container=True, fifo_share_is_0=True), NONE, [punctual])
    assert subjects(lines) == ["cgroup"]


@pytest.mark.parametrize(
    ("refused", "expected"),
    [
        ("locked memory: the limit is 8192 KiB", "ulimit"),
        ("no deep sleep: Permission denied", "deep sleep"),
        ("CPU 9: Invalid argument", None),
    ],
)
def test_a_right_that_was_refused_is_explained(host, punctual, refused, expected):
    rights = Rights(("SCHED_FIFO 50",), (refused,))
    assert subjects(advise(host, rights, [punctual])) == ([expected] if expected else [])


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"governors": ("performance", "powersave")}, "governor"),
        ({"quota_percent": 50}, "CPU quota"),
        ({"load": 3.0}, "chrt"),
        ({"cpus": 1, "isolated": ""}, "CPUs"),
        ({"isolated": ""}, "isolcpus"),
        ({"preemption": "PREEMPT_DYNAMIC"}, "kernel"),
    ],
)
def test_what_disturbs_a_late_host_is_named(host, late, change, expected):
    assert subjects(advise(replace(host, **change), ALL, [late])) == [expected]


def test_stolen_time_is_named_from_one_percent_on(host, late):
    for percent, expected in ((0.9, []), (1.0, ["steal"])):
        stolen = Comparison(late.floor._replace(stolen_percent=percent), late.scan)
        assert subjects(advise(host, ALL, [stolen])) == expected


def test_the_kernel_is_not_to_be_changed_before_the_rights_are_there(host, late):
    plain = replace(host, preemption="none", isolated="")
    assert subjects(advise(plain, NONE, [late])) == ["ulimit", "setcap"]


def test_the_best_rights_count(host, punctual, late):
    plain = replace(host, preemption="none")
    assert advise(plain, ALL, [late, punctual]) == []
    assert subjects(advise(plain, ALL, [punctual, late])) == ["kernel"]
