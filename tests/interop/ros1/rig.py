"""A ROS 1 system of real processes on ports of its own: master, tools, peers, and our node."""

import contextlib
import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from crosnode.graph.arguments import node_settings
from crosnode.graph.hosts import is_ipv6_wanted, parse_hosts
from crosnode.graph.uri import make_uri
from crosnode.messages import MessageTypes
from crosnode.node import CrosNode, NodeOptions
from crosnode.node.ros_time import Epoch
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.network import OsNetwork
from tests.ports import free_port

PYTHON = "/usr/bin/python3"
HERE = Path(__file__).parent
ROOT = HERE.parents[2]
PROGRAMS = ROOT / "programs"
NS_PER_MS = 1_000_000
PATIENCE_S = 100.0
"""So long what should come is waited for, however busy the host is; it is no claim."""


class Process:
    """A process whose output is read without waiting for it."""

    def __init__(self, command: list[str], env: dict[str, str], log: Path) -> None:
        self.log = log
        with log.open("wb") as file:
            self._popen = subprocess.Popen(
                command, env=env, stdout=file, stderr=subprocess.STDOUT, start_new_session=True
            )

    @property
    def text(self) -> str:
        return re.sub(r"\x1b\[[0-9;]*m", "", self.log.read_text(errors="replace"))

    @property
    def is_running(self) -> bool:
        return self._popen.poll() is None

    def kill(self, number: int = signal.SIGKILL, patience_s: float = 10) -> None:
        if self.is_running:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._popen.pid, number)
        try:
            self._popen.wait(patience_s)
        except subprocess.TimeoutExpired:
            os.killpg(self._popen.pid, signal.SIGKILL)
            self._popen.wait()


class Ros:
    """A master, and whatever a test starts beside it.

    Args:
        master: "rosmaster" or "plcsim".
        folder: for logs.
        host: number, or a name of ``hosts``, under which all are reached; "::1" and names are IPv6.
        hosts: what the processes find as /etc/hosts, in a mount namespace of their own.
    """

    def __init__(self, master: str, folder: Path, host: str = "127.0.0.1", hosts: str = "") -> None:
        self.kind = master
        self.folder = folder
        self.port = free_port()
        self.host = host
        self.hosts = parse_hosts(hosts, ipv6=True)
        self.uri = make_uri("http", host, self.port)
        self._prefix: list[str] = []
        if hosts:
            file = folder / "hosts"
            file.write_text(hosts)
            self._prefix = in_own_namespace(file)
        keep = ("PATH", "HOME", "LANG", "PYTHONHASHSEED")
        self.env = {key: os.environ[key] for key in keep if key in os.environ} | {
            "ROS_MASTER_URI": self.uri,
            "ROS_HOME": str(folder / "home"),
            "ROS_LOG_DIR": str(folder / "log"),
            "ROS_PACKAGE_PATH": f"{PROGRAMS / 'talker' / 'packages'}:/usr/share",
            "PYTHONUNBUFFERED": "1",
            "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1",
        }
        if host == "127.0.0.1":
            self.env["ROS_IP"] = host
        else:
            self.env |= {"ROS_IPV6": "on", "ROS_HOSTNAME" if hosts else "ROS_IP": host}
        self._processes: list[Process] = []
        self._nodes: list[tuple[Context, CrosNode]] = []
        self.steps: list[Callable[[], object]] = []
        self.start_master()

    def start_master(self) -> None:
        commands = {
            "rosmaster": [PYTHON, "/usr/bin/rosmaster", "--core", "-p", str(self.port)],
            "plcsim": [sys.executable, "-m", "plcsim.cli.main", "master", "-p", str(self.port)],
        }
        self.master = self.start(commands[self.kind])
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            ip = self.hosts.get(self.host, self.host)
            with contextlib.suppress(OSError), socket.create_connection((ip, self.port)):
                return
            time.sleep(0.02)
        raise AssertionError(f"no master: {self.master.text}")

    def start(self, command: list[str]) -> Process:
        log = self.folder / f"{len(self._processes)}.log"
        self._processes.append(Process([*self._prefix, *command], self.env, log))
        return self._processes[-1]

    def rospy(self, *arguments: str) -> Process:
        return self.start([PYTHON, str(HERE / "peers" / "rospy_peer.py"), *arguments])

    def tool(self, name: str, *arguments: str, seconds: float = PATIENCE_S) -> str:
        """Run a command-line tool of ROS while our nodes go on; return what it says."""
        process = self.start(["timeout", str(seconds), PYTHON, f"/usr/bin/{name}", *arguments])
        self.until(lambda: not process.is_running, seconds + 5)
        return process.text

    def program(self, name: str) -> Process:
        """Run one of our example projects in its own scan process."""
        command = [sys.executable, "-m", "plcsim.cli.main", "run", str(PROGRAMS / name)]
        return self.start(command)

    def node(self, name: str, *arguments: str) -> CrosNode:
        context = Context(Memory(), OsNetwork())
        context.release_ns = time.monotonic_ns()
        settings = node_settings(name, arguments, self.env)
        types = MessageTypes([PROGRAMS / "talker" / "packages"])
        epoch = Epoch(time.time_ns() - context.release_ns)
        ipv6 = is_ipv6_wanted(self.env)
        options = NodeOptions(epoch=epoch, ipv6=ipv6, hosts=self.hosts)
        node = CrosNode(context, settings, types, options)
        self._nodes.append((context, node))
        return node

    def step(self) -> None:
        """Let our nodes do a cycle."""
        for context, node in self._nodes:
            context.release_ns = time.monotonic_ns()
            node.do_events_loop()
        for step in self.steps:
            step()

    def tick(self) -> None:
        """Let our nodes do a cycle of a millisecond."""
        self.step()
        time.sleep(0.001)

    def ticks_until(self, condition: Callable[[], Any], most: int = 2_000) -> int:
        """Run on a grid of a millisecond until something is so; return the cycles it took."""
        release_ns = time.monotonic_ns()
        for count in range(most):
            if condition():
                return count
            self.step()
            release_ns += NS_PER_MS
            time.sleep(max(0, release_ns - time.monotonic_ns()) / 1e9)
        raise AssertionError(f"not so within {most} cycles")

    def until(self, condition: Callable[[], Any], seconds: float = PATIENCE_S) -> float:
        """Run until something is so; return the seconds it took."""
        start = time.monotonic()
        while not condition():
            if time.monotonic() - start > seconds:
                texts = [f"{p.log.name}: {p.text[-800:]}" for p in self._processes]
                raise AssertionError("not so in time\n" + "\n".join(texts))
            self.tick()
        return time.monotonic() - start

    def run(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.tick()

    def close(self) -> None:
        for _, node in self._nodes:
            node.destroy(steps=2_000)
        for process in reversed(self._processes):
            process.kill(signal.SIGINT if process is not self.master else signal.SIGKILL, 3)


def in_own_namespace(hosts: Path) -> list[str]:
    """Return what runs a command with another /etc/hosts, which needs rights."""
    script = 'mount --bind "$0" /etc/hosts && exec "$@"'
    return ["unshare", "--mount", "sh", "-c", script, str(hosts)]


@contextlib.contextmanager
def ros_system(
    master: str, folder: Path, host: str = "127.0.0.1", hosts: str = ""
) -> Iterator[Ros]:
    ros = Ros(master, folder, host, hosts)
    try:
        yield ros
    finally:
        ros.close()
