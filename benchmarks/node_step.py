"""How much CPU time a step of the node takes at 1 and 10 ms, and whether anything is lost.

    python benchmarks/node_step.py [--seconds 10] [--only TEXT ...] [--json FILE]

The node runs alone in a loop on an absolute grid, as in a task class, with the default limits of a
step; master and peers are another process, which numbers what it sends. Times are the thread's own
CPU time, so what the host adds by running others is not in them, but for interrupts and for what it
does within the virtual machine. A step's budget is 0.3 ms for each millisecond of cycle. Yardsticks
of the same run: a step of a node with nothing connected, a fixed loop in Python, a rospy node with
the same 500 String/s in and out, where rospy is installed; and in each cycle, half a cycle after
the step and after a sleep of its own, other work in Python, of the standard library and of much
code as a step is, that takes as long as the median of the steps in one cycle, and as long as their
longest twentieth in the next. Where that is too long it is the host, which is expected to do the
same to the steps ("host"); two such counts differ by chance. `node_rounds.py` says which long steps
are the node's own.
"""

from __future__ import annotations

import argparse
import difflib
import email
import itertools
import os
import shlex
import statistics
import subprocess
import sys
import textwrap
import time
import xmlrpc.client
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from _outcome import (
    Target,
    console,
    figures_table,
    number_above_0,
    print_machine,
    print_targets,
    write_json,
)
from _ports import free_port
from _ros_peer import BYTES, IMAGE, STRING, await_master, make_node, number_of
from _rospy import HOST_ENVIRONMENT, rospy_command
from _stalls import by_chance

from plcsim.host import garbage, realtime

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from crosnode.node import CrosNode

HERE = Path(__file__).parent
NS_PER_MS = 1_000_000
BUDGET_SHARE = 0.3
"""Of a cycle."""

OVER = 1.2
"""Times its budget that a step may take."""

TWENTIETH = 20
TURNS = 1000
"""Of a loop in Python."""

MAIL = "From: a@b.c\nTo: d@e.f\nSubject: cell\n\nready\n"
PIECES = (
    lambda: shlex.split("roslaunch cell 'arm left' --wait"),
    lambda: textwrap.wrap("what a step costs beside what the host alone does to it", 20),
    lambda: difflib.get_close_matches("Strng", ("String", "Header")),
    lambda: email.message_from_string(MAIL).get_payload(),
    lambda: xmlrpc.client.loads(xmlrpc.client.dumps(("/plc", 1), "getPid")),
)
"""Of work that is not ours, about as long as each other."""

MOST_S = 30
"""Seconds in which the first message must be there."""

VGA = 640 * 480 * 3

ROSPY = r"""
import sys, time, rospy
from std_msgs.msg import String
rospy.init_node("yardstick")
heard = [0]
def take(message):
    heard[0] += 1
rospy.Subscriber("/in", String, take, tcp_nodelay=True, queue_size=1000)
publisher = rospy.Publisher("/out", String, queue_size=None, tcp_nodelay=True)
message = String(data="from the cycle")
while not heard[0] or not publisher.get_num_connections():
    time.sleep(0.01)
seconds, cpu = float(sys.argv[1]), time.process_time()
end = due = time.monotonic()
end += seconds
while due < end:
    publisher.publish(message)
    due += 0.002
    time.sleep(max(0, due - time.monotonic()))
print("CPU", (time.process_time() - cpu) / seconds, flush=True)
"""


class Case(NamedTuple):
    """A load: what the peer does, and what our program does in each cycle.

    Attributes:
        name: of the load.
        peer: orders of `_ros_peer.py`.
        tick_ms: cycle.
        publish_every: cycles between two messages of the program, 0 for none.
    """

    name: str
    peer: str
    tick_ms: int = 1
    publish_every: int = 0

    @property
    def limit_ns(self) -> float:
        """What no step may take."""
        return OVER * BUDGET_SHARE * self.tick_ms * NS_PER_MS

    @property
    def rate(self) -> float | None:
        """Messages a second that the peer sends and numbers; None for none, or without a pause."""
        act, *arguments = self.peer.split()
        return float(arguments[2]) or None if act == "talk" else None


NOTHING, STRINGS = "nothing connected", "500 String/s in and out"
CASES = [
    Case(NOTHING, "idle 0"),
    Case("idle, 10 connections", "idle 10"),
    Case(STRINGS, f"talk /in {STRING} 500 16,echo /out {STRING}", publish_every=2),
    *(
        Case(f"{name}, {tick_ms} ms", f"talk /in {kind} {rate} {size}", tick_ms)
        for name, kind, rate, size in (
            ("5000 String/s in", STRING, 5000, 16),
            ("50 Hz of 1 MB in", BYTES, 50, 1_000_000),
            ("1 MB without a pause in", BYTES, 0, 1_000_000),
            ("30 Hz of VGA in", IMAGE, 30, VGA),
        )
        for tick_ms in (1, 10)
    ),
    Case("8 nodes call getBusInfo", "call 8"),
]


class Program:
    """What a program does with the node, and what it counts."""

    def __init__(self, case: Case, node: CrosNode) -> None:
        self.received = self.lost = 0
        self._every = case.publish_every
        self._is_numbered = case.rate is not None
        self._next: int | None = None
        self._subscriber = self._publisher = None
        if "talk" in case.peer:
            self._subscriber = node.register_subscriber(
                "/in", case.peer.split()[2], queue_size=1000
            )
        if case.publish_every:
            self._publisher = node.register_publisher("/out", STRING, queue_size=100)
        for number in range(10 if "idle 10" in case.peer else 0):
            if number % 2:
                node.register_subscriber(f"/idle{number}", STRING)
            else:
                node.register_publisher(f"/idle{number}", STRING)

    @property
    def is_connected(self) -> bool:
        """Whether a publisher of what it subscribes to is connected."""
        return self._subscriber is not None and self._subscriber.publishers > 0

    def cycle(self, cycle: int) -> None:
        """Do what the program does in a cycle."""
        if self._subscriber:
            while (message := self._subscriber.pop()) is not None:
                self.received += 1
                if self._is_numbered:
                    number = number_of(message)
                    self.lost += 0 if self._next is None else number - self._next
                    self._next = number + 1
        if self._publisher and cycle % self._every == 0:
            self._publisher.send(self._publisher.new(data="from the cycle"))


class Figures(NamedTuple):
    """What a case came to: nanoseconds of own CPU time, sorted, and messages.

    Attributes:
        steps_ns: of the node.
        others_ns: of other work in between, as long as the median, and as the longest twentieth.
        connected_tick: cycle in which the publisher was connected; its first message comes when it
            has one to say.
    """

    case: Case
    steps_ns: list[int]
    received_per_s: float
    lost: int
    connected_tick: int | None
    cpu_share: float
    others_ns: tuple[list[int], list[int]]

    def at(self, share: float) -> int:
        """Return the step that a share of all does not exceed."""
        return self.steps_ns[min(len(self.steps_ns) - 1, int(share * len(self.steps_ns)))]

    @property
    def over(self) -> int:
        """Steps above budget and a fifth."""
        return sum(each > self.case.limit_ns for each in self.steps_ns)

    @property
    def by_host(self) -> int:
        """Steps that the host alone makes too long."""
        median, longest = (
            sum(each > self.case.limit_ns for each in others) / max(1, len(others))
            for others in self.others_ns
        )
        return round(len(self.steps_ns) * (median * (TWENTIETH - 1) + longest) / TWENTIETH)


def loop(turns: int) -> int:
    """Return the own CPU time of a loop in Python, nanoseconds."""
    begin_ns = time.thread_time_ns()
    for number in range(turns):
        _ = number * number + number
    return time.thread_time_ns() - begin_ns


def work(pieces: Iterator[Callable[[], object]], count: int) -> int:
    """Return the own CPU time of so many pieces of work, nanoseconds."""
    begin_ns = time.thread_time_ns()
    for piece in itertools.islice(pieces, count):
        piece()
    return time.thread_time_ns() - begin_ns


def as_long(steps_ns: list[int], others_ns: list[int]) -> tuple[int, int]:
    """Return the pieces of work as long as the median and as the longest twentieth of the steps.

    Args:
        steps_ns: of a node.
        others_ns: of all pieces, in between.
    """
    if not steps_ns or not others_ns:
        return len(PIECES), len(PIECES)
    longest_ns = statistics.quantiles(steps_ns, n=TWENTIETH)[-1]
    piece_ns = statistics.median(others_ns) / len(PIECES)
    median_ns = statistics.median(steps_ns)
    return max(1, int(median_ns / piece_ns)), max(1, int(longest_ns / piece_ns))


def run(case: Case, seconds: int, rights: realtime.Rights) -> Figures:
    """Run a case; a second from the first message on is not counted, in which all connect."""
    port = free_port()
    command = [sys.executable, str(HERE / "_ros_peer.py"), str(port), *case.peer.split()]
    peer = subprocess.Popen(command, preexec_fn=ordinary)  # noqa: PLW1509  # no threads here
    try:
        await_master(port)
        time.sleep(0.5)  # the peer has registered, and stands as a talker that was there before
        context, node = make_node("plc", port)
        program = Program(case, node)
        realtime.settle(rights)  # as the scan does
        tick_ns = case.tick_ms * NS_PER_MS
        release_ns, connected, start, cpu_ns = time.monotonic_ns(), None, program.received, 0
        steps_ns: list[int] = []
        others_ns: tuple[list[int], list[int]] = [], []
        pieces, counts = itertools.cycle(PIECES), as_long([], [])
        ticks = 1000 // case.tick_ms
        begin = 0 if "talk" in case.peer else ticks
        for cycle in range((seconds + MOST_S) * ticks):
            if begin and cycle == begin + seconds * ticks:
                break
            if begin and cycle == begin:
                counts = as_long(steps_ns, [*others_ns[0], *others_ns[1]])
                for each in (steps_ns, *others_ns):
                    each.clear()
                start, cpu_ns = program.received, time.process_time_ns()
            context.release_ns = release_ns
            begin_ns = time.thread_time_ns()
            node.do_events_loop()
            steps_ns.append(time.thread_time_ns() - begin_ns)
            program.cycle(cycle)
            if connected is None and program.is_connected:
                connected = cycle + 1
            if not begin and program.received:
                begin = cycle + ticks
            release_ns += tick_ns
            rest_ns = release_ns - tick_ns // 2 - time.monotonic_ns()
            if rest_ns > 0:
                time.sleep(rest_ns / 1e9)
                others_ns[cycle % 2].append(work(pieces, counts[cycle % 2]))
            rest_ns = release_ns - time.monotonic_ns()
            if rest_ns > 0:
                garbage.collect_while_idle(rest_ns)  # as the scan does
                rest_ns = release_ns - time.monotonic_ns()
            if rest_ns > 0:
                time.sleep(rest_ns / 1e9)
        cpu_ns = time.process_time_ns() - cpu_ns
        received = (program.received - start) / seconds
    finally:
        peer.kill()
        peer.wait()
    share = cpu_ns / (seconds * 1e9)
    return Figures(case, sorted(steps_ns), received, program.lost, connected, share, others_ns)


def ordinary() -> None:
    """Give up what a peer inherits: it gets no real-time rights, and the other processors."""
    own = os.sched_getaffinity(0)
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    os.sched_setaffinity(0, set(range(os.cpu_count() or 1)) - own or own)


def rospy_share(seconds: int) -> float | None:
    """Return the processors that a rospy node takes with 500 String/s in and out."""
    command = rospy_command(ROSPY)
    if command is None:
        return None
    port = free_port()
    orders = f"talk /in {STRING} 500 16,echo /out {STRING}".split()
    environment = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}/", **HOST_ENVIRONMENT}
    peer = subprocess.Popen([sys.executable, str(HERE / "_ros_peer.py"), str(port), *orders],
                            preexec_fn=ordinary)  # noqa: PLW1509  # no threads here  # fmt: skip
    try:
        await_master(port)
        told = subprocess.run([*command, str(seconds)], env=environment, capture_output=True,
                              text=True, check=True, timeout=seconds + 60,
                              preexec_fn=ordinary).stdout  # fmt: skip
    finally:
        peer.kill()
        peer.wait()
    return float(told.split("CPU")[1])


def loop_ns() -> int:
    """Return the least own CPU time of a fixed loop in Python, of many times."""
    return min(loop(TURNS) for _ in range(200))


def targets(found: dict[str, Figures]) -> list[Target]:
    """Return what the issue asks: ratios within the run, nothing lost, no step over its budget."""
    made = []
    if STRINGS in found and NOTHING in found:
        ratio = found[STRINGS].at(0.5) / found[NOTHING].at(0.5)
        made.append(Target(f"{STRINGS}: median / empty step", ratio, 2.5, "x"))
    ticks = [f.connected_tick or 0 for f in found.values() if f.case.tick_ms == 1]
    if any(ticks):
        made.append(Target("publisher connected", max(ticks), 20, "ticks"))
    for name, figures in found.items():
        if "talk" not in figures.case.peer:
            continue
        if rate := figures.case.rate:
            made.append(Target(f"{name}: lost", figures.lost, 0, "messages"))
            made.append(
                Target(
                    f"{name}: received", figures.received_per_s, 0.98 * rate, "/s", at_least=True
                )
            )
        limit = f"{figures.case.limit_ns / 1e3:,.0f} us"
        made.append(Target(f"{name}: steps over {limit}", figures.over, 0, "steps"))
        over, host = figures.over, figures.by_host
        chance = f"steps (by chance, host {host})"
        made.append(
            Target(f"{name}: more than the host", over - host, by_chance(over, host), chance)
        )
    return made


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=number_above_0, default=10)
    parser.add_argument(
        "--only", nargs="+", default=[""], help="cases with one of these in their name"
    )
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    hosts = [print_machine("before")]
    rights = realtime.acquire(50, None)
    console.print(f"rights: {', '.join(rights.granted) or 'none'}")
    least_ns = loop_ns()
    cases = [case for case in CASES if any(text in case.name for text in options.only)]
    found = {case.name: run(case, options.seconds, rights) for case in cases}
    rospy = rospy_share(options.seconds) if STRINGS in found else None
    hosts.append(print_machine("after"))
    empty_ns = found[NOTHING].at(0.5) if NOTHING in found else None
    table = figures_table(
        "load (own CPU time of a step)", "p50 us", "/ empty", "/ loop", "p99", "p99.9", "longest",
        "over", "host", "received/s", "lost", "tick", "CPU %",
    )  # fmt: skip
    for name, f in found.items():
        median = f.at(0.5)
        times = (f"{each / 1e3:.0f}" for each in (f.at(0.99), f.at(0.999), f.steps_ns[-1]))
        table.add_row(
            name, f"{median / 1e3:.0f}", f"{median / empty_ns:.2f} x" if empty_ns else "",
            f"{median / least_ns:.2f} x", *times, str(f.over), str(f.by_host),
            f"{f.received_per_s:.0f}", str(f.lost), str(f.connected_tick or ""),
            f"{100 * f.cpu_share:.1f}",
        )  # fmt: skip
    console.print(table)
    console.print(f"a loop of 1000 turns in Python: {least_ns / 1e3:.1f} us")
    told = "not installed, or not asked for"
    if rospy is not None:
        share = found[STRINGS].cpu_share / rospy
        told = f"{100 * rospy:.1f} % of a processor; ours in a scan of 1 ms {share:.2f} x of it"
    console.print(f"rospy, {STRINGS}: {told}")
    made = targets(found)
    print_targets(made)
    rows = [[name, f.received_per_s, f.lost, f.over, f.by_host, f.at(0.5), f.at(0.99),
             f.steps_ns[-1]] for name, f in found.items()]  # fmt: skip
    write_json(options.json, hosts, made, loop_ns=least_ns, rospy=rospy, figures=rows)
    return 0 if all(target.met for target in made) else 1


if __name__ == "__main__":
    sys.exit(main())
