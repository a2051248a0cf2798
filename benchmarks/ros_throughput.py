"""Messages a second, flat out, ours beside rospy's in the same run.

    python benchmarks/ros_throughput.py [--seconds 3] [--json FILE]

Each pair of publisher and subscriber is two processes on the loopback with a master of ours; the
subscriber counts what it hears in a span of time. "ours" runs unpaced, without a scan. rospy is
measured with its synchronous publisher (queue_size=None), its fastest. What is not installed is
left out, and its targets with it.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

from _outcome import Target, console, number_above_0, print_machine
from _ros_peer import HOST, make_node
from node_step import BYTES, STRING, free_port
from rich.table import Table

from crosnode.budget import UNPACED

HERE = Path(__file__).parent
PYTHON = "/usr/bin/python3"
SIZES = {"String 16 B": (STRING, 16), "1 MB": (BYTES, 1_000_000)}

ROSPY = r"""
import sys, time, rospy
from std_msgs.msg import String, UInt8MultiArray
act, kind, size, seconds = sys.argv[1], sys.argv[2], int(sys.argv[3]), float(sys.argv[4])
cls = String if kind.endswith("String") else UInt8MultiArray
rospy.init_node("rospy_" + act)
if act == "talk":
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
    time.sleep(0.5)
    before, start = count[0], time.monotonic()
    time.sleep(seconds)
    print("RATE", (count[0] - before) / (time.monotonic() - start), flush=True)
"""


def has_rospy() -> bool:
    probe = [PYTHON, "-c", "import rospy, std_msgs.msg"]
    return subprocess.run(probe, capture_output=True, check=False).returncode == 0


def environment(port: int) -> dict[str, str]:
    return {"ROS_MASTER_URI": f"http://{HOST}:{port}/", "ROS_IP": HOST, "PATH": "/usr/bin:/bin"}


def rospy(port: int, act: str, kind: str, size: int, seconds: float) -> subprocess.Popen[str]:
    command = [PYTHON, "-W", "ignore", "-c", ROSPY, act, kind, str(size), str(seconds)]
    return subprocess.Popen(command, env=environment(port), stdout=subprocess.PIPE, text=True)


def our_rate(port: int, kind: str, seconds: float) -> float:
    """Count what a subscriber of ours hears, decoded, in a span of time."""
    context, node = make_node("measured", port, step=UNPACED)
    subscriber = node.register_subscriber("/in", kind, queue_size=100_000)
    count, before, start_ns, end_ns = 0, 0, 0, 0
    while True:
        now_ns = context.release_ns = time.monotonic_ns()
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


def rospy_rate(port: int, kind: str, size: int, seconds: float) -> float:
    peer = rospy(port, "listen", kind, size, seconds)
    output, _ = peer.communicate(timeout=60)
    return float(output.split("RATE")[1])


def measure(publisher: str, subscriber: str, kind: str, size: int, seconds: float) -> float:
    """Return messages a second from one to the other."""
    port = free_port()
    peer = [sys.executable, str(HERE / "_ros_peer.py"), str(port)]
    talk = ["talk", "/in", kind, "0", str(size)] if publisher == "ours" else ["idle", "0"]
    processes: list[subprocess.Popen[Any]] = [subprocess.Popen([*peer, *talk])]
    time.sleep(1.5)
    if publisher == "rospy":
        processes.append(rospy(port, "talk", kind, size, 0))
    try:
        if subscriber == "ours":
            return our_rate(port, kind, seconds)
        return rospy_rate(port, kind, size, seconds)
    finally:
        for process in processes:
            process.kill()
            process.wait()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=number_above_0, default=3)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    host = print_machine("before")
    pairs = [("ours", "ours")]
    if has_rospy():
        pairs += [("rospy", "rospy"), ("rospy", "ours"), ("ours", "rospy")]
    else:
        console.print("rospy is not installed: nothing to compare with")
    rates = {
        (name, *pair): measure(*pair, kind, size, options.seconds)
        for name, (kind, size) in SIZES.items()
        for pair in pairs
    }
    table = Table("message", "publisher", "subscriber", "messages/s", "MB/s")
    for (name, publisher, subscriber), rate in rates.items():
        table.add_row(name, publisher, subscriber, f"{rate:,.0f}",
                      f"{rate * SIZES[name][1] / 1e6:,.1f}")  # fmt: skip
    console.print(table)
    targets = []
    for name, share in (("String 16 B", 0.5), ("1 MB", 1.0)):
        if (yardstick := rates.get((name, "rospy", "rospy"))) is not None:
            ours = rates[name, "ours", "ours"]
            targets.append(
                Target(f"{name}: ours / rospy", ours / yardstick, share, "x", at_least=True)
            )
    for target in targets:
        word = "met" if target.met else "MISSED"
        console.print(f"{word:7}{target.name}: {target.value:.2f} {target.unit}, "
                      f"asked >= {target.limit:g}")  # fmt: skip
    if options.json:
        figures = [[*key, rate] for key, rate in rates.items()]
        options.json.write_text(json.dumps({"host": asdict(host), "rates": figures}, default=str))
    return 0 if all(target.met for target in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
