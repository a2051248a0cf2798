"""The other side of the ROS benchmarks: a master and a node of ours in a process of its own.

    python _ros_peer.py PORT talk TOPIC TYPE RATE SIZE | idle COUNT | echo TOPIC | call COUNT

It runs unpaced, so that the measured side is the one that limits. With `in-step` before PORT it
does what is due whenever a time comes on its standard input, 8 bytes of nanoseconds, and answers a
byte.
"""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any

from ros_processes import answers

from crosnode.graph.arguments import node_settings
from crosnode.master.server import MasterOptions, MasterServer
from crosnode.node import CrosNode, NodeOptions
from crosnode.transport.budget import UNPACED, StepBudget
from crosnode.xmlrpc import XmlRpcLimits
from crosnode.xmlrpc.api_caller import ApiCall, ApiCaller, CallState
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.network import OsNetwork

if TYPE_CHECKING:
    from collections.abc import Iterator

HOST = "127.0.0.1"
STRING = "std_msgs/String"
BYTES = "std_msgs/UInt8MultiArray"
IMAGE = "sensor_msgs/Image"
DIGITS = 8
"""Of the number that a message with a rate begins with."""

TIME_BYTES = 8
"""Of a time that a peer is told."""


def environment(port: int) -> dict[str, str]:
    return {"ROS_MASTER_URI": f"http://{HOST}:{port}/"}


def make_node(
    name: str, port: int, now_ns: int | None = None, **options: Any
) -> tuple[Context, CrosNode]:
    context = Context(Memory(), OsNetwork())
    context.release_ns = time.monotonic_ns() if now_ns is None else now_ns
    settings = node_settings(name, (), environment(port), host=HOST)
    return context, CrosNode(context, settings, options=NodeOptions(bind_ip=HOST, **options))


def message_for(publisher: Any, size: int, number: int = 0) -> Any:
    """Return a message of a size that begins with a number."""
    text = f"{number:0{DIGITS}}".ljust(size, "x")
    if publisher.message_type.name == STRING:
        return publisher.new(data=text)
    return publisher.new(data=text.encode())


def number_of(message: Any) -> int:
    """Return the number that a message begins with."""
    return int(bytes(message.data[:DIGITS]) if not isinstance(message.data, str)
               else message.data[:DIGITS])  # fmt: skip


def await_master(port: int) -> None:
    """Wait until the master of a pair answers."""
    end = time.monotonic() + 20
    while not answers(port):
        if time.monotonic() > end:
            raise SystemExit(f"no master at port {port}")
        time.sleep(0.05)  # rosmaster does not tell when it listens


class Talk:
    """Publishes messages of a size: so many a second, or as many as a subscriber takes."""

    def __init__(self, node: CrosNode, topic: str, type_name: str, rate: str, size: str) -> None:
        self.publisher = node.register_publisher(topic, type_name, queue_size=20_000)
        self.body = self.publisher.message_type.encode(message_for(self.publisher, int(size)))
        self.period_ns = int(1e9 / float(rate)) if float(rate) else 0
        self.due_ns = 0
        self.size, self.number = int(size), 0

    def step(self, now_ns: int) -> None:
        publisher = self.publisher
        if not publisher.subscribers:
            self.due_ns = now_ns
            return
        if not self.period_ns:
            room = min(20_000, 8 * (1 << 20) // max(1, len(self.body)))
            for owner in list(publisher.links.values()):  # sending may end a link
                for _ in range(room - len(owner.queue)):
                    publisher.send_raw(self.body)
            return
        while now_ns >= self.due_ns:
            publisher.send(message_for(publisher, self.size, self.number))
            self.number += 1
            self.due_ns += self.period_ns


class Echo:
    """Subscribes to a topic and throws the messages away."""

    def __init__(self, node: CrosNode, topic: str, type_name: str) -> None:
        self.subscriber = node.register_subscriber(topic, type_name, queue_size=1)

    def step(self, now_ns: int) -> None:
        self.subscriber.queue.release()


class Idle:
    """Holds so many connections, half of them in each direction, and says nothing."""

    def __init__(self, node: CrosNode, count: str) -> None:
        for number in range(int(count)):
            if number % 2:
                node.register_publisher(f"/idle{number}", "std_msgs/String")
            else:
                node.register_subscriber(f"/idle{number}", "std_msgs/String")

    def step(self, now_ns: int) -> None:
        pass


class MethodCall:
    """Calls getBusInfo of the node ``/plc`` over so many connections, as often as it answers."""

    def __init__(self, node: CrosNode, count: str) -> None:
        core = node.core
        self.callers = [ApiCaller(core.loop, core.hosts, XmlRpcLimits()) for _ in range(int(count))]
        self.node = node
        self.lookup: ApiCall | None = None

    def step(self, now_ns: int) -> None:
        if self.lookup is None or self.lookup.state is CallState.FAILED:
            self.lookup = self.node.call_master("lookupNode", "/plc")
        elif self.lookup.state is CallState.DONE:
            for caller in self.callers:
                if caller.is_idle:
                    call = ApiCall(str(self.lookup.value), "getBusInfo", ["/peer"])
                    caller.start(call, keep=True)
                caller.step(now_ns, StepBudget(UNPACED))


ACTS: dict[str, Any] = {"talk": Talk, "echo": Echo, "idle": Idle, "call": MethodCall}


def told_times() -> Iterator[int]:
    """Give each time that comes on standard input, and answer when what was due then is done."""
    while told := sys.stdin.buffer.read(TIME_BYTES):
        yield int.from_bytes(told, "little")
        sys.stdout.buffer.write(b".")
        sys.stdout.buffer.flush()


def own_times(pause_s: float) -> Iterator[int]:
    """Give the time, again and again."""
    while True:
        yield time.monotonic_ns()
        if pause_s:
            time.sleep(pause_s)


def main() -> None:
    is_told = sys.argv[1] == "in-step"
    port, *orders = sys.argv[1 + is_told :]
    context, node = make_node("peer", int(port), step=UNPACED)
    master = MasterServer(context, MasterOptions(host=HOST, port=int(port), bind_ip=HOST))
    acts = []
    for order in " ".join(orders).split(","):
        name, *arguments = order.split()
        acts.append(ACTS[name](node, *arguments))
    is_flat_out = any(isinstance(act, Talk) and not act.period_ns for act in acts)
    for now_ns in told_times() if is_told else own_times(0 if is_flat_out else 0.0005):
        context.release_ns = now_ns
        master.step()
        for act in acts:
            act.step(now_ns)
        node.do_events_loop()


if __name__ == "__main__":
    main()
