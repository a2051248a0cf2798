"""Seeded hostile input against every listening port of a ROS 1 system of real processes.

    python benchmarks/ros_fuzz.py [--seconds 30] [--seed 7] [--json FILE]

`plcsim master`, the examples talker (here a hundred words a second) and listener, and add_two_ints
with its master beside the scan run as a user runs them. All ports at which they listen are attacked
at once by up to 200 connections, every few seconds all of them at one port. Exit code 1 where a
process ended or went into SERVICE, a cycle time violation was the program's, a word or a call was
lost, memory grew by more than the bound, or a port does not answer afterwards.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from _outcome import console, figures_table, number_above_0, print_machine, write_json
from _ports import free_port
from ros_processes import HOST, PLCSIM, Process, Project, ServiceProcess, answers, still_answers

from crosnode.testing import Attacker, HostilePeers
from plcsim.network import OsNetwork

if TYPE_CHECKING:
    from collections import Counter
    from collections.abc import Callable

    from crosnode.testing import AttackedPort

MOST_OPEN = 200
FLOOD_EVERY_S = 4.0
FLOOD_S = 1.0
"""So long the flood stands, silent, while the system goes on."""
STEP_S = 0.001

MOST_GROWTH_KIB = 32 * 1024
"""A master keeps 16 MiB of parameters and 20000 registrations at most, a connection what it has
read of one document or message. The attack is too short to fill that: more would be a leak."""

RECOVERY_S = 15.0
"""A silent peer keeps its connection for 10 s at most; after that a port must answer."""


class System:
    """All processes under attack.

    Args:
        folder: for copies of projects, logs, reports.
    """

    def __init__(self, folder: Path) -> None:
        self.port, own_port = free_port(), free_port()
        command = [*PLCSIM, "master", "-p", str(self.port), "--host", HOST]
        self.master = Process("master", command, folder / "master.log")
        self.talker = Project("talker", folder)
        self.talker.change("talker/main.py", "_NS = 1_000_000_000", "_NS = 10_000_000")
        self.listener = Project("listener", folder)
        self.adder = Project("add_two_ints", folder)
        embedded = 'master = "embedded"'
        self.adder.change("plc.toml", embedded, f"{embedded}\nmaster_port = {own_port}")
        self.projects = [self.talker, self.listener, self.adder]
        own_master = ServiceProcess("its master", self.adder, "crosnode.plc.master_service")
        self.processes = [self.master, *self.projects, own_master]

    def start(self) -> None:
        """Start all, and wait until words and calls flow."""
        uri = f"http://{HOST}:{self.port}/"
        self.master.start(uri)
        self._await(lambda: answers(self.port))
        for project in self.projects:
            project.start(uri)
        for project in self.projects:
            self._await(project.is_readable)
        self._await(lambda: self.listener.tag("listener.heard"))
        self._await(lambda: self.adder.tag("caller.right"))

    def _await(self, condition: Callable[[], object]) -> None:
        end = time.monotonic() + 30
        while not condition():
            if time.monotonic() > end:
                said = "\n".join(process.said for process in self.processes)
                raise SystemExit(f"the system does not come up\n{said}")
            time.sleep(0.05)

    def stop(self) -> None:
        """End all; the masters last."""
        for process in reversed(self.processes):
            process.stop()


class Flow(NamedTuple):
    """What must not get lost: counts on both sides.

    Attributes:
        name: of the flow.
        given: counts what went out.
        taken: counts what arrived.
    """

    name: str
    given: Callable[[], int]
    taken: Callable[[], int]

    def missing(self) -> int:
        """Return how many have not arrived, without those that are on their way just now."""
        found = []
        for _ in range(100):
            taken = self.taken()
            found.append(self.given() - taken)
            time.sleep(0.005)
        return min(found)


class Watched(NamedTuple):
    """A flow, and what it was when the attack began."""

    flow: Flow
    given: int
    missing: int


class Passed(NamedTuple):
    """What a flow did in the attack."""

    name: str
    sent: int
    lost: int


def flows(system: System) -> list[Flow]:
    talker, listener, adder = system.talker, system.listener, system.adder
    return [
        Flow("words on /chatter", lambda: talker.tag("talker.sent"),
             lambda: listener.tag("listener.heard")),
        Flow("calls of /add_two_ints", lambda: adder.tag("caller.asked"),
             lambda: adder.tag("caller.right")),
    ]  # fmt: skip


def attack(system: System, attacker: Attacker, seconds: float) -> None:
    """Attack for a time, or until a process has ended."""
    start = flooded = time.monotonic()
    while (now := time.monotonic()) < start + seconds:
        if now >= flooded + FLOOD_EVERY_S:
            attacker.flood()
            time.sleep(FLOOD_S)
            attacker.close()
            flooded = time.monotonic()
        attacker.step()
        time.sleep(STEP_S)
        if not all(process.is_running for process in system.processes):
            break
    attacker.close()


class Figures(NamedTuple):
    """What came of an attack.

    Attributes:
        connections: by kind.
        memory: KiB before, after, and at most, by process.
        passed: of each flow.
        reports: of each project.
        faults: in words.
    """

    connections: Counter[str]
    memory: dict[str, tuple[int, int, int]]
    passed: list[Passed]
    reports: dict[str, dict[str, Any]]
    faults: list[str]


def run(system: System, seconds: float, seed: int) -> Figures:
    """Attack a system that is up, stop it, and return the figures."""
    doors = [door for process in system.processes for door in process.doors()]
    console.print(f"{len(doors)} ports of {len(system.processes)} processes, seed {seed}")
    watched = [Watched(flow, flow.given(), flow.missing()) for flow in flows(system)]
    before = {process.name: process.memory_kib() for process in system.processes}
    peers = HostilePeers(seed, "/chatter", "/add_two_ints")
    attacker = Attacker(OsNetwork(), doors, peers, MOST_OPEN)
    attack(system, attacker, seconds)
    faults = [f"{p.name} ended: {p.said}" for p in system.processes if not p.is_running]
    faults += [] if faults else unanswered(doors)
    passed = [
        Passed(flow.name, flow.given() - given, flow.missing() - missing)
        for flow, given, missing in watched
    ]
    memory = {
        process.name: (before[process.name], process.memory_kib(), process.memory_kib("VmHWM"))
        for process in system.processes
    }
    system.stop()
    reports = {project.name: project.report() for project in system.projects}
    faults += [*lost(passed), *grown(memory), *violated(reports)]
    return Figures(attacker.counts, memory, passed, reports, faults)


def unanswered(doors: list[AttackedPort]) -> list[str]:
    """Return the ports that do not answer any more."""
    end = time.monotonic() + RECOVERY_S
    left = doors
    while left and time.monotonic() < end:
        left = [door for door in left if not still_answers(door)]
    return [f"port {door.address.port} ({door.speaks.name}) does not answer" for door in left]


def lost(passed: list[Passed]) -> list[str]:
    silent = [f"{each.name}: none were sent" for each in passed if not each.sent]
    return silent + [f"{each.name}: {each.lost} lost" for each in passed if each.lost]


def grown(memory: dict[str, tuple[int, int, int]]) -> list[str]:
    return [
        f"{name} grew by {most - before} KiB, the bound is {MOST_GROWTH_KIB}"
        for name, (before, _, most) in memory.items()
        if most - before > MOST_GROWTH_KIB
    ]


def violated(reports: dict[str, dict[str, Any]]) -> list[str]:
    found = []
    for name, report in reports.items():
        if report["state"] != "STOPPED":
            found.append(f"{name} ended in {report['state']}: {report['fault']['text']}")
        for each in report["task_classes"]:
            if count := each["violations"]["program"]:
                found.append(f"{name}: {count} cycle time violations by the program")
    return found


def show(figures: Figures) -> None:
    """Print everything."""
    table = figures_table("connections", "")
    for kind, count in sorted(figures.connections.items()):
        table.add_row(kind, f"{count:,}")
    table.add_row("all", f"{figures.connections.total():,}")
    console.print(table)
    table = figures_table("resident KiB", "before", "after", "at most", "at most +")
    for name, (before, after, most) in figures.memory.items():
        table.add_row(name, f"{before:,}", f"{after:,}", f"{most:,}", f"{most - before:,}")
    console.print(table)
    show_scans(figures.reports)
    table = figures_table("flow", "sent", "lost")
    for each in figures.passed:
        table.add_row(each.name, f"{each.sent:,}", f"{each.lost:,}")
    console.print(table)


def show_scans(reports: dict[str, dict[str, Any]]) -> None:
    table = figures_table("scan of 1 ms + 10 ms", "cycles", "missed", "violations: program", "host",
                          "longest cycle ms", "own CPU ms")  # fmt: skip
    for name, report in reports.items():
        for each in report["task_classes"]:
            violations = each["violations"]
            longest = (each[key]["maximum"] / 1e6 for key in ("response_ns", "execution_ns"))
            table.add_row(
                name, f"{each['cycles']:,}", f"{each['missed_grid_points']:,}",
                str(violations["program"]), str(violations["host"]),
                *(f"{value:.2f}" for value in longest),
            )  # fmt: skip
    console.print(table)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=number_above_0, default=30)
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep all figures")
    options = parser.parse_args()
    host = print_machine("before")
    with tempfile.TemporaryDirectory() as folder:
        system = System(Path(folder))
        try:
            system.start()
            figures = run(system, options.seconds, options.seed)
        finally:
            system.stop()
    show(figures)
    for fault in figures.faults:
        console.print(f"FAULT {fault}", soft_wrap=True)
    console.print(f"faults: {len(figures.faults)}")
    write_json(options.json, [host], [], seed=options.seed, **figures._asdict())
    return 1 if figures.faults else 0


if __name__ == "__main__":
    sys.exit(main())
