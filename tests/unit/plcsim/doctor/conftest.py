"""Measurements and hosts made by hand."""

import pytest

from plcsim.core.statistics import Histogram
from plcsim.doctor.host import Host
from plcsim.doctor.loops import LoopOrder, Measurement
from plcsim.doctor.verdict import Comparison

MS = 1_000_000
PUNCTUAL = [20_000] * 10_000


def measurement_of(lateness_ns, missed=0, loop="plcsim", *, realtime=True, stolen_percent=0.0):
    histogram = Histogram()
    for late_ns in lateness_ns:
        histogram.record(late_ns)
    order = LoopOrder(MS, len(lateness_ns), realtime)
    return Measurement(loop, order, missed, histogram.summary(), stolen_percent)


@pytest.fixture(scope="session")
def measured():
    """``measured(lateness_ns, missed=0)``: a measurement of a 1 ms loop."""
    return measurement_of


@pytest.fixture
def punctual():
    """A comparison in which both loops held the tick."""
    return Comparison(measurement_of(PUNCTUAL, loop="C"), measurement_of(PUNCTUAL))


@pytest.fixture
def late():
    """A comparison in which neither did."""
    lateness_ns = [900_000] * 1000
    return Comparison(measurement_of(lateness_ns, loop="C"), measurement_of(lateness_ns))


@pytest.fixture
def host():
    """A host with nothing to complain of."""
    return Host(
        kernel="6.12",
        preemption="PREEMPT_RT",
        python="CPython 3.11",
        cpu_model="",
        cpus=4,
        allowed=4,
        isolated="3",
        governors=("performance",),
        hypervisor="",
        container=False,
        cpu=3,
        quota_percent=None,
        fifo_share_is_0=False,
        rtprio_limit=98,
        memlock_limit=-1,
        tells_standstills=True,
        load=0.1,
    )
