"""How long a step of the node takes at a tick of 1 ms, and whether it keeps up.

    python benchmarks/node_step.py [--seconds 10] [--json FILE]

The node runs alone in a loop on an absolute grid, as in a task class; master and peers are another
process. Beside the targets stands the same loop around a step of an empty node (nothing connected)
as yardstick of the machine.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import subprocess
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

from _outcome import Target, console, number_above_0, print_machine
from _ports import free_port
from _ros_peer import make_node
from rich.table import Table

from plcsim.core.statistics import Histogram
from plcsim.host import garbage, realtime

HERE = Path(__file__).parent
TICK_NS = 1_000_000
STEP_BUDGET_NS = 300_000
STRING = "std_msgs/String"
BYTES = "std_msgs/UInt8MultiArray"


class Case:
    """One load: what the peer does, and what our program does in each cycle.

    Attributes:
        name: of the load.
        peer: orders of `_ros_peer.py`.
        received: messages so far.
    """

    def __init__(self, name: str, peer: str, *, publish_every: int = 0, size: int = 0) -> None:
        self.name = name
        self.peer = peer
        self.publish_every = publish_every
        self.received = 0
        self._size = size

    def register(self, node: Any) -> None:
        """Register what the load needs."""
        self.subscriber = self.publisher = None
        if "talk" in self.peer:
            type_name = self.peer.split()[2]
            self.subscriber = node.register_subscriber("/in", type_name, queue_size=1000)
        if self.publish_every:
            self.publisher = node.register_publisher("/out", STRING, queue_size=100)
        for number in range(10 if "idle" in self.peer else 0):
            if number % 2:
                node.register_subscriber(f"/idle{number}", STRING)
            else:
                node.register_publisher(f"/idle{number}", STRING)

    def cycle(self, cycle: int) -> None:
        """Do what the program does in a cycle."""
        if self.subscriber:
            while self.subscriber.pop() is not None:
                self.received += 1
        if self.publisher and cycle % self.publish_every == 0:
            self.publisher.send(self.publisher.new(data="from the cycle"))


CASES = [
    Case("nothing connected", "idle 0"),
    Case("idle, 10 connections", "idle 10"),
    Case(
        "500 String/s in and out", f"talk /in {STRING} 500 16,echo /out {STRING}", publish_every=2
    ),
    Case("50 Hz of 1 MB in", f"talk /in {BYTES} 50 1000000"),
    Case("5000 String/s in", f"talk /in {STRING} 5000 16"),
    Case("8 nodes call getBusInfo", "call 8"),
]


def run(case: Case, seconds: int) -> dict[str, Any]:
    """Run a case; the first second, in which all connect, is not counted."""
    port = free_port()
    command = [sys.executable, str(HERE / "_ros_peer.py"), str(port), *case.peer.split()]
    peer = subprocess.Popen(command, preexec_fn=ordinary)  # noqa: PLW1509  # no threads here
    try:
        time.sleep(1.5)  # the peer has registered, and stands as a talker that was there before
        context, node = make_node("plc", port, clock_ns=time.perf_counter_ns)
        case.register(node)
        statistics = Histogram()
        gc.collect()
        gc.freeze()
        release_ns = time.monotonic_ns()
        first = None
        received = [0, 0]
        for cycle in range((seconds + 1) * 1000):
            if cycle == 1000:
                statistics.reset()
                received[0] = case.received
            context.release_ns = release_ns
            node.do_events_loop()
            statistics.record(node.statistics.last_ns)
            case.cycle(cycle)
            if first is None and case.received:
                first = cycle + 1
            release_ns += TICK_NS
            rest_ns = release_ns - time.monotonic_ns()
            if rest_ns > 0:
                garbage.collect_while_idle(rest_ns)  # as the scan does
                rest_ns = release_ns - time.monotonic_ns()
            if rest_ns > 0:
                time.sleep(rest_ns / 1e9)
        received[1] = case.received
        summary = statistics.summary()
        dropped = case.subscriber.queue.dropped if case.subscriber else 0
    finally:
        peer.kill()
        peer.wait()
    return {
        "case": case.name, "first_tick": first, "dropped": dropped,
        "received_per_s": (received[1] - received[0]) / seconds, **summary._asdict(),
        "over_budget": over(statistics, STEP_BUDGET_NS * 12 // 10),
    }  # fmt: skip


def over(histogram: Histogram, limit_ns: int) -> int:
    """Return how many steps took longer than a limit."""
    return sum(count for end_ns, count in histogram.buckets() if end_ns > limit_ns)


def ordinary() -> None:
    """Give up what a peer inherits: it gets no real-time rights, and the other processors."""
    own = os.sched_getaffinity(0)
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    os.sched_setaffinity(0, set(range(os.cpu_count() or 1)) - own or own)


def targets(figures: list[dict[str, Any]]) -> list[Target]:
    _, idle, strings, large, many, _ = figures
    return [
        Target("idle, 10 connections: median", idle["p50_ns"] / 1e3, 80, "us"),
        Target("500 String/s in and out: median", strings["p50_ns"] / 1e3, 150, "us"),
        Target("500 String/s in and out: p99", strings["p99_ns"] / 1e3, 400, "us"),
        Target("50 Hz of 1 MB: steps over 360 us", large["over_budget"], 0, "steps"),
        Target("50 Hz of 1 MB: received", large["received_per_s"], 49.5, "/s", at_least=True),
        Target("5000 String/s: received", many["received_per_s"], 4975, "/s", at_least=True),
        Target("first message", max(f["first_tick"] or 0 for f in (strings, many)), 20, "ticks"),
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=number_above_0, default=10)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    host = print_machine("before")
    rights = realtime.acquire(50, None)
    console.print(f"rights: {', '.join(rights.granted) or 'none'}")
    figures = [run(case, options.seconds) for case in CASES]
    table = Table("load", "p50", "p99", "p99.9", "max", "over 360 us", "received/s", "first tick")
    for f in figures:
        times = [f"{f[key] / 1e3:.0f} us" for key in ("p50_ns", "p99_ns", "p99_9_ns", "maximum_ns")]
        table.add_row(f["case"], *times, str(f["over_budget"]), f"{f['received_per_s']:.0f}",
                      str(f["first_tick"] or ""))  # fmt: skip
    console.print(table)
    found = targets(figures)
    for target in found:
        sign = ">=" if target.at_least else "<="
        word = "met" if target.met else "MISSED"
        console.print(f"{word:7}{target.name}: {target.value:.1f} {target.unit}, "
                      f"asked {sign} {target.limit:g}")  # fmt: skip
    if options.json:
        options.json.write_text(json.dumps({"host": asdict(host), "figures": figures}, default=str))
    return 0 if all(target.met for target in found) else 1


if __name__ == "__main__":
    sys.exit(main())
