"""A controller on the virtual clock, as the scan process of `plcsim run --virtual` makes it."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from plcsim.clock import VirtualClock
from plcsim.controller import Controller, ProgramSetup, Setup, TaskClassSetup
from plcsim.network import VirtualNetwork
from plcsim.scan_process import _PageHeartbeat

if TYPE_CHECKING:
    from plcsim.task import Program

CYCLE_NS = 1_000_000


def controller_of(program: type[Program]) -> Controller:
    """Return a controller that runs one program in one task class of 1 ms, its INIT done."""
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    page = _PageHeartbeat()
    page.clock = clock
    task_class = TaskClassSetup(1, CYCLE_NS, [ProgramSetup("program", program)])
    controller = Controller(Setup([task_class]), network=network, clock=clock, heartbeat=page)
    controller.boot()
    return controller


def time_scans_ns(controller: Controller, scans: int) -> float:
    """Run a number of scans; return the wall time of one in nanoseconds."""
    start_ns = time.perf_counter_ns()
    controller.run(cycles=scans)
    return (time.perf_counter_ns() - start_ns) / scans
