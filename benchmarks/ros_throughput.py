"""Messages a second, flat out, ours beside rospy's and roscpp's in the same run; and a ping-pong.

    python benchmarks/ros_throughput.py [--seconds 3] [--rounds 3] [--rivals rospy roscpp]
        [--messages "String 16 B" "1 MB"] [--json FILE]

Each pair of publisher and subscriber is two processes on the loopback with a master of ours; the
subscriber counts what it hears in a span of time. "ours" runs unpaced, without a scan; "ours, 1 ms"
and "ours, 10 ms" run on the grid of a task class, with the default limits of a step. rospy is
measured with its synchronous publisher (queue_size=None), its fastest; roscpp (ros_roscpp.cpp,
compiled here) with as many messages on their way as it takes without dropping any. The pairs
alternate, a round of each after the other: rates are medians of the rounds, ratios medians of each
round's ratio. In the ping-pong rospy answers each String at once. What is not installed is left
out, and its targets with it.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, NamedTuple

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
from _ros_peer import BYTES, HOST, STRING, await_master, make_node
from _rospy import HOST_ENVIRONMENT, rospy_command

from crosnode.transport.budget import UNPACED

HERE = Path(__file__).parent
SIZES = {"String 16 B": (STRING, 16), "1 MB": (BYTES, 1_000_000)}
SHARE = 1.0
"""What ours shall reach of rospy -> rospy: unpaced, and as a subscriber in a scan."""

RIVALS = ("rospy", "roscpp")
SCANS = {"ours, 1 ms": 1_000_000, "ours, 10 ms": 10_000_000}
"""Nanoseconds of cycle of subscribers in a scan."""

PING_PONG_MS = 1.2
"""What a round trip of a scan of 1 ms shall take."""

ROSPY = r"""
import sys, time, rospy
from std_msgs.msg import String, UInt8MultiArray
act, kind, size, seconds = sys.argv[1], sys.argv[2], int(sys.argv[3]), float(sys.argv[4])
cls = String if kind == "String" else UInt8MultiArray
rospy.init_node("rospy_" + act)
if act == "pong":
    publisher = rospy.Publisher("/in", cls, queue_size=None, tcp_nodelay=True)
    rospy.Subscriber("/out", cls, publisher.publish, tcp_nodelay=True)
    rospy.spin()
elif act == "talk":
    publisher = rospy.Publisher("/in", cls, queue_size=None, tcp_nodelay=True)
    message = cls(data="x" * size if cls is String else bytes(size))
    while publisher.get_num_connections() == 0:
        time.sleep(0.01)
    while not rospy.is_shutdown():
        publisher.publish(message)
else:
    count = [0]
    def heard(_message):
        count[0] += 1
    rospy.Subscriber("/in", cls, heard, tcp_nodelay=True, buff_size=1 << 22)
    while not count[0]:
        time.sleep(0.01)
    time.sleep(0.5)  # past the start
    before, start = count[0], time.monotonic()
    time.sleep(seconds)
    print("RATE", (count[0] - before) / (time.monotonic() - start), flush=True)
"""


class Pair(NamedTuple):
    """Who publishes and who subscribes: "ours", "rospy" or "roscpp"."""

    publisher: str
    subscriber: str


Rates = dict[tuple[str, Pair], list[float]]
"""Messages a second of each round, by message and pair."""


def roscpp_command(folder: Path) -> list[str] | None:
    """Compile the roscpp peer and return what runs it, None where roscpp is not installed."""
    if not (shutil.which("g++") and shutil.which("pkg-config")):
        return None
    probe = ["pkg-config", "--cflags", "--libs", "roscpp", "std_msgs"]
    flags = subprocess.run(probe, capture_output=True, text=True, check=False)
    if flags.returncode:
        return None
    target = folder / "ros_roscpp"
    compiler = ["g++", "-O2", "-std=c++17", "-w", str(HERE / "ros_roscpp.cpp"), "-o", str(target)]
    subprocess.run([*compiler, *flags.stdout.split(), "-pthread"], check=True)
    return [str(target)]


class Rival:
    """A peer that is not ours.

    Args:
        command: what runs it.
    """

    def __init__(self, command: list[str]) -> None:
        self._command = command

    def start(
        self, port: int, act: str, kind: str, size: int, seconds: float = 0
    ) -> subprocess.Popen[str]:
        """Start it with the master at ``port``; ``act`` is "talk" or "listen"."""
        command = [*self._command, act, kind.partition("/")[2], str(size), str(seconds)]
        environment = {
            "ROS_MASTER_URI": f"http://{HOST}:{port}/", **HOST_ENVIRONMENT
        }  # fmt: skip
        return subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)

    def rate(self, port: int, kind: str, size: int, seconds: float) -> float:
        """Return messages a second that it hears."""
        with self.start(port, "listen", kind, size, seconds) as peer:
            try:
                output, _ = peer.communicate(timeout=60)
            finally:
                peer.kill()
        return float(output.split("RATE")[1])


def rest(release_ns: int, cycle_ns: int) -> int:
    """Wait for the next release of a scan, as it does; return which."""
    while release_ns <= time.monotonic_ns():  # as after a missed grid point
        release_ns += cycle_ns
    time.sleep(max(0, release_ns - time.monotonic_ns()) / 1e9)
    return release_ns


def our_rate(port: int, kind: str, seconds: float, cycle_ns: int = 0) -> float:
    """Count what a subscriber of ours hears, decoded, in a span of time; in a scan with a cycle."""
    limits = {} if cycle_ns else {"step": UNPACED}
    context, node = make_node("measured", port, **limits)
    subscriber = node.register_subscriber("/in", kind, queue_size=100_000)
    count, before, start_ns, end_ns = 0, 0, 0, 0
    release_ns = time.monotonic_ns()
    while True:
        release_ns = rest(release_ns, cycle_ns) if cycle_ns else time.monotonic_ns()
        now_ns = context.release_ns = release_ns
        node.do_events_loop()
        while subscriber.pop() is not None:
            count += 1
        if not start_ns and count:
            start_ns = now_ns + 500_000_000
            end_ns = start_ns + int(seconds * 1e9)
        if start_ns and not before and now_ns >= start_ns:
            before, start_ns = count, now_ns
        if end_ns and now_ns >= end_ns:
            break
    node.destroy(steps=200)
    return (count - before) / ((now_ns - start_ns) / 1e9)


def ping_pong(port: int, cycle_ns: int, count: int) -> list[int]:
    """Return nanoseconds from a send to the answer in hand, of pings from a scan, one by one."""
    context, node = make_node("ping", port)
    publisher = node.register_publisher("/out", STRING)
    subscriber = node.register_subscriber("/in", STRING)
    release_ns, sent_ns = time.monotonic_ns(), 0
    took: list[int] = []
    while len(took) < count:
        release_ns = context.release_ns = rest(release_ns, cycle_ns)
        node.do_events_loop()
        heard = subscriber.pop() is not None
        if heard:
            took.append(time.monotonic_ns() - sent_ns)
        if publisher.subscribers and subscriber.publishers and (heard or not sent_ns):
            sent_ns = time.monotonic_ns()
            publisher.send(publisher.new(data="ping"))
    node.destroy(steps=200)
    return took[count // 10 :]  # past the start


class Measurement:
    """Measures pairs; one for a run.

    Args:
        rivals: those that are installed.
        seconds: of each measurement.
    """

    def __init__(self, rivals: dict[str, Rival], messages: list[str], seconds: float) -> None:
        self.pairs = [Pair("ours", "ours")]
        for name in rivals:
            self.pairs += [Pair(name, name), Pair(name, "ours"), Pair("ours", name)]
        talkers = "rospy" if "rospy" in rivals else "ours"
        self.pairs += [Pair(talkers, scan) for scan in SCANS]
        self.ping_pong_ns: list[int] = []
        self._rivals = rivals
        self._messages = messages
        self._seconds = seconds

    def round(self, rates: Rates) -> None:
        """Measure each pair once with each message."""
        for name in self._messages:
            kind, size = SIZES[name]
            for pair in self.pairs:
                rates.setdefault((name, pair), []).append(self._rate(pair, kind, size))
        if "rospy" in self._rivals:
            self._ping_pong()

    def _ping_pong(self) -> None:
        port = free_port()
        master = [sys.executable, str(HERE / "_ros_peer.py"), str(port), "idle", "0"]
        processes: list[subprocess.Popen[Any]] = [subprocess.Popen(master)]
        try:
            await_master(port)
            processes.append(self._rivals["rospy"].start(port, "pong", STRING, 16))
            self.ping_pong_ns += ping_pong(port, 1_000_000, 1_000)
        finally:
            for process in processes:
                process.kill()
                process.wait()

    def _rate(self, pair: Pair, kind: str, size: int) -> float:
        port = free_port()
        peer = [sys.executable, str(HERE / "_ros_peer.py"), str(port)]
        talk = ["talk", "/in", kind, "0", str(size)] if pair.publisher == "ours" else ["idle", "0"]
        processes: list[subprocess.Popen[Any]] = [subprocess.Popen([*peer, *talk])]
        try:
            await_master(port)
            if pair.publisher != "ours":
                processes.append(self._rivals[pair.publisher].start(port, "talk", kind, size))
            if pair.subscriber.startswith("ours"):
                return our_rate(port, kind, self._seconds, SCANS.get(pair.subscriber, 0))
            return self._rivals[pair.subscriber].rate(port, kind, size, self._seconds)
        finally:
            for process in processes:
                process.kill()
                process.wait()


def ratio(rates: Rates, name: str, pair: Pair, rival: str) -> float | None:
    """Return a pair's share of a rival's own rate: the median of the rounds' ratios."""
    yardstick = rates.get((name, Pair(rival, rival)))
    if yardstick is None:
        return None
    shares = (rate / other for rate, other in zip(rates[name, pair], yardstick, strict=True))
    return statistics.median(shares)


def print_rates(rates: Rates) -> None:
    """Print each pair with its rate and its share of each rival's."""
    table = figures_table("message", "publisher > subscriber", "messages/s", "MB/s",
                          *(f"/ {rival}" for rival in RIVALS))  # fmt: skip
    for (name, pair), rounds in rates.items():
        rate = statistics.median(rounds)
        shares = (ratio(rates, name, pair, rival) for rival in RIVALS)
        table.add_row(
            name, f"{pair.publisher} > {pair.subscriber}", f"{rate:,.0f}",
            f"{rate * SIZES[name][1] / 1e6:,.1f}",
            *("not installed" if share is None else f"{share:.2f} x" for share in shares),
        )  # fmt: skip
    console.print(table)


def found_targets(rates: Rates) -> list[Target]:
    """Return the targets against rospy, outside of a scan and in one with default limits.

    roscpp is a yardstick without a target.
    """
    pairs = [Pair("ours", "ours"), *(Pair("rospy", scan) for scan in SCANS)]
    shares = {
        (name, pair): ratio(rates, name, pair, "rospy")
        for name in SIZES
        for pair in pairs
        if (name, pair) in rates
    }
    return [
        Target(f"{name}: {pair.publisher} > {pair.subscriber} / rospy", share, SHARE, "x",
               at_least=True)
        for (name, pair), share in shares.items()
        if share is not None
    ]  # fmt: skip


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=number_above_0, default=3)
    parser.add_argument("--rounds", type=number_above_0, default=3)
    parser.add_argument("--rivals", nargs="+", choices=RIVALS, default=RIVALS)
    parser.add_argument("--messages", nargs="+", choices=SIZES, default=list(SIZES))
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    hosts = [print_machine("before")]
    rates: Rates = {}
    with tempfile.TemporaryDirectory() as folder:
        commands = {"rospy": rospy_command(ROSPY), "roscpp": roscpp_command(Path(folder))}
        rivals = {name: Rival(commands[name]) for name in options.rivals if commands[name]}
        measurement = Measurement(rivals, options.messages, options.seconds)
        for _ in range(options.rounds):
            measurement.round(rates)
    hosts.append(print_machine("after"))
    print_rates(rates)
    targets = found_targets(rates)
    if took := sorted(measurement.ping_pong_ns):
        median_ms = took[len(took) // 2] / 1e6
        targets.append(Target("ping-pong, scan of 1 ms: median", median_ms, PING_PONG_MS, "ms"))
    print_targets(targets)
    figures = [[name, *pair, rounds] for (name, pair), rounds in rates.items()]
    write_json(options.json, hosts, targets, rates=figures)
    return 0 if all(target.met for target in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
