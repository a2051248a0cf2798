"""What a message costs: encoding lists, and receiving many small ones, beside rospy's own code.

    python benchmarks/ros_messages.py [--rounds 5] [--json FILE]

A JointTrajectory of 100 points for six joints is encoded, and 1,000 std_msgs/String that came as
one block of bytes are taken apart and decoded: ours as a subscriber's connection and ``pop`` do it,
rospy's by ``rospy.msg.deserialize_messages``. Both in one process each of the same machine,
alternating; the figure of a round is the least own CPU time of many repeats, ratios are medians of
the rounds'.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from _outcome import Target, console, figures_table, number_above_0, print_machine, print_targets
from _outcome import write_json as write
from _rospy import HOST_ENVIRONMENT, rospy_command

from crosnode.messages import MessageTypes
from crosnode.node.queues import DropOldestQueue
from crosnode.tcpros import MessagesReceived, SubscriberConnection, TcprosLimits, TypeInfo
from crosnode.tcpros.header import encode_header

if TYPE_CHECKING:
    from collections.abc import Callable

POINTS, JOINTS, STRINGS = 100, 6, 1_000
REPEATS = 60
ENCODE, RECEIVE = "encode a JointTrajectory of 100 points", "receive a String"
LIMITS = {ENCODE: 1.5, RECEIVE: 3.0}
"""Times what rospy takes."""

ROSPY = r"""
import sys, time
from io import BytesIO
import genpy
from rospy.msg import deserialize_messages
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
points, joints, strings, repeats = (int(word) for word in sys.argv[1:])
value = [0.5] * joints
message = JointTrajectory(joint_names=["joint"] * joints, points=[
    JointTrajectoryPoint(value, value, value, value, genpy.Duration(1)) for _ in range(points)])
one = BytesIO()
String("from the cycle!!").serialize(one)
block = (len(one.getvalue()).to_bytes(4, "little") + one.getvalue()) * strings
def encode():
    message.serialize(BytesIO())
def receive():
    taken, buffer = [], BytesIO()
    buffer.write(block)
    deserialize_messages(buffer, taken, String)
    assert len(taken) == strings
def least(act):
    took = []
    for _ in range(repeats):
        begin = time.thread_time_ns()
        act()
        took.append(time.thread_time_ns() - begin)
    return min(took)
print("NS", least(encode), least(receive) / strings)
"""


def least(act: Callable[[], object]) -> int:
    """Return the least own CPU time of many times."""
    took = []
    for _ in range(REPEATS):
        begin_ns = time.thread_time_ns()
        act()
        took.append(time.thread_time_ns() - begin_ns)
    return min(took)


def ours() -> dict[str, float]:
    """Return nanoseconds of each."""
    types = MessageTypes()
    trajectory, string = (
        types.message("trajectory_msgs/JointTrajectory"),
        types.message("std_msgs/String"),
    )
    value = [0.5] * JOINTS
    point = types.message("trajectory_msgs/JointTrajectoryPoint")
    points = [point.new(positions=value, velocities=value, accelerations=value, effort=value)
              for _ in range(POINTS)]  # fmt: skip
    message = trajectory.new(joint_names=["joint"] * JOINTS, points=points)
    body = string.encode(string.new(data="from the cycle!!"))
    block = (len(body).to_bytes(4, "little") + body) * STRINGS
    info = TypeInfo(string.name, string.md5sum)
    connection = SubscriberConnection("/in", info, "/plc", tcp_nodelay=True,
                                      limits=TcprosLimits(), now_ns=0)  # fmt: skip
    connection.receive_data(encode_header({"md5sum": string.md5sum, "type": string.name}))
    connection.next_event(0)

    def receive() -> None:
        queue: DropOldestQueue[bytes | memoryview] = DropOldestQueue(STRINGS)
        connection.most = STRINGS
        connection.receive_data(block)
        while isinstance(event := connection.next_event(0), MessagesReceived):
            queue.extend(event.bodies)
        count = 0
        while (body := queue.pop()) is not None:
            string.decode(body)
            count += 1
        assert count == STRINGS

    return {ENCODE: least(lambda: trajectory.encode(message)), RECEIVE: least(receive) / STRINGS}


def rospys(command: list[str]) -> dict[str, float]:
    """Return nanoseconds of each for rospy."""
    numbers = [str(each) for each in (POINTS, JOINTS, STRINGS, REPEATS)]
    told = subprocess.run([*command, *numbers], env=HOST_ENVIRONMENT, capture_output=True,
                          text=True, check=True)  # fmt: skip
    encode, receive = told.stdout.split("NS")[1].split()
    return {ENCODE: float(encode), RECEIVE: float(receive)}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=number_above_0, default=5)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    hosts = [print_machine("before")]
    command = rospy_command(ROSPY)
    rounds = [(ours(), rospys(command) if command else None) for _ in range(options.rounds)]
    hosts.append(print_machine("after"))
    table = figures_table("what", "ours us", "rospy us", "ours / rospy")
    targets = []
    for name, limit in LIMITS.items():
        own = statistics.median(each[name] for each, _ in rounds) / 1e3
        others = [(each[name], rival[name]) for each, rival in rounds if rival]
        if not others:
            table.add_row(name, f"{own:.2f}", "not installed", "")
            continue
        ratio = statistics.median(mine / theirs for mine, theirs in others)
        rival_us = statistics.median(theirs for _, theirs in others) / 1e3
        table.add_row(name, f"{own:.2f}", f"{rival_us:.2f}", f"{ratio:.2f} x")
        targets.append(Target(f"{name}: ours / rospy", ratio, limit, "x"))
    console.print(table)
    print_targets(targets)
    write(options.json, hosts, targets, rounds=rounds)
    return 0 if all(target.met for target in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
