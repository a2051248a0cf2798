"""Everybody at once beside a 1 ms scan: browsers, a trace, OPC UA and Modbus.

    python benchmarks/web.py [--seconds 20] [--rounds 4] [--browsers 10] [--trace-seconds 60]
        [--json FILE]

A project in Structured Text with 200 REALs that change in every cycle and 2,000 more that change
twice a second runs with pages, OPC UA and Modbus TCP. A leg is one run of it, with rights where the
host gives them; every leg has 4 Modbus clients that ask as fast as the processor they share lets
them (nice 19: behind everybody else). In turns a leg has these clients and no others ("none"), or
also browsers that watch 200 tags ten times a second, one of which traces 8 tags in every cycle, and
a client of OPC UA with 20 subscriptions of 100 variables ("all"). All clients and services share
a processor that is not the scan's. The last leg has all clients for as long as the
trace is to be, and the first page is asked for while they are there.

A host that is shared takes its processors away, with clients and without. So both kinds of legs are
interleaved and equally many, lateness is compared pair by pair, and missed grid points as stalls:
all points of a stall have one cause, and each is a violation here (the tolerance is 1 us), by the
host, or by programs and controller ("own"; a hypervisor that takes time without a word makes some
of these too). Two counts of stalls differ by chance up to about twice the root of their sum. The
figures of a leg are those of the whole run, the start of the services included.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path
from typing import Any, Final

from _browsers import TAGS, TRACED
from _modbus_site import build, child_with
from _opcua_subscriber import ITEMS, SUBSCRIPTIONS
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

HERE: Final = Path(__file__).parent
ALL_CPUS: Final = os.sched_getaffinity(0)
REGISTERS: Final = 125
MODBUS_CLIENTS: Final = 4
SERVICES: Final = ("web", "opcua", "modbus")
SETTLE_S: Final = 3
"""The last part of a leg, in which clients that began late come to their end."""

PROJECT = """
[task_class.1]
cycle = "1ms"
tolerance = "1us"
on_violation = "log"
programs = ["line"]

[web]
port = {web}

[opcua]
port = {opcua}
tags = ["line.values"]

[modbus]
port = {modbus}
audit = ""
"""
TYPES = "TYPE Cell : STRUCT v : UDINT; END_STRUCT; END_TYPE\n"
VARIABLES = f"""
VAR
    cycle : UDINT;
    at : UINT;
    fast : ARRAY[0..{TAGS - 1}] OF REAL;
    values : ARRAY[0..{SUBSCRIPTIONS * ITEMS - 1}] OF Cell;
    registers : ARRAY[1..{REGISTERS}] OF UINT;
END_VAR
"""
PROGRAM = f"""
PROGRAM _CYCLIC
    cycle := cycle + 1;
    FOR at := 0 TO {TAGS - 1} DO
        fast[at] := fast[at] + 0.5;
    END_FOR
    FOR at := 1 TO {REGISTERS} DO
        registers[at] := UDINT_TO_UINT(cycle);
    END_FOR
    IF cycle MOD 500 = 0 THEN
        FOR at := 0 TO {SUBSCRIPTIONS * ITEMS - 1} DO
            values[at].v := values[at].v + 1;
        END_FOR
    END_IF
END_PROGRAM
"""


class Leg:
    """One run of the project.

    Args:
        folder: a new one is made in it.
        client: of Modbus, in C.
    """

    def __init__(self, folder: Path, client: Path) -> None:
        self.ports = {table: free_port() for table in SERVICES}
        self._client = client
        self._cpu = 0
        self._project = Path(tempfile.mkdtemp(dir=folder, prefix="line"))
        self._report = self._project / "report.json"
        files = {
            "plc.toml": PROJECT.format(**self.ports),
            "Global.typ": TYPES,
            "line/Variables.var": VARIABLES,
            "line/cyclic.st": PROGRAM,
            "tags.csv": "tag,area,offset\n"
            + "".join(f"line.registers[{i}],hr,{i - 1}\n" for i in range(1, REGISTERS + 1)),
        }
        for name, text in files.items():
            file = self._project / name
            file.parent.mkdir(exist_ok=True)
            file.write_text(text)

    def run(self, seconds: float, browsers: int, *, with_page: bool = False) -> dict[str, Any]:
        """Return what a leg of so many seconds came to; without browsers also without OPC UA."""
        command = [sys.executable, "-m", "plcsim", "run", "--report", str(self._report)]
        told = self._project / "told.txt"  # a pipe that nobody reads would hold up the logbook
        with told.open("w") as file:
            process = subprocess.Popen(
                [*command, str(self._project)], stdout=subprocess.DEVNULL, stderr=file
            )
        await_services(process, told)
        scan = os.sched_getaffinity(child_with(process.pid, "plcsim.process.scan_process"))
        self._cpu = min(ALL_CPUS - scan or ALL_CPUS)  # without rights the scan may run anywhere
        for table in SERVICES:
            os.sched_setaffinity(child_with(process.pid, f"plcsim.{table}.service"), {self._cpu})
        started_s = time.monotonic()
        clients = self._start(seconds, browsers)
        found: dict[str, Any] = {"kind": "all" if browsers else "none"}
        if with_page:
            time.sleep(seconds / 2)  # in the middle of the leg all clients are there
            found |= first_page(self.ports["web"])
        for each in clients:
            found |= ended(each)
        time.sleep(max(0.0, started_s + seconds + SETTLE_S - time.monotonic()))
        process.send_signal(signal.SIGINT)
        process.wait(timeout=60)
        return found | {"seconds": seconds} | figures(self._report)

    def _start(self, seconds: float, browsers: int) -> list[subprocess.Popen[str]]:
        port, python = self.ports, sys.executable
        load = [
            "nice",
            "-n",
            "19",
            self._client,
            "load",
            port["modbus"],
            MODBUS_CLIENTS,
            REGISTERS,
            int(seconds),
        ]
        commands: list[list[Any]] = [load]
        if browsers:
            commands += [
                [python, HERE / "_browsers.py", port["web"], browsers, seconds],
                [python, HERE / "_opcua_subscriber.py", port["opcua"], self._project.name, seconds],
            ]
        pinned = ["taskset", "-c", self._cpu]
        return [
            subprocess.Popen(
                [str(word) for word in (*pinned, *command)], stdout=subprocess.PIPE, text=True
            )
            for command in commands
        ]


def await_services(process: subprocess.Popen[bytes], told: Path) -> None:
    """Wait until all services serve."""
    deadline_s = time.monotonic() + 180
    while True:
        text = told.read_text()
        if all(f"\n{table}: " in f"\n{text}" for table in SERVICES):
            return
        if process.poll() is not None or time.monotonic() > deadline_s:
            process.kill()
            raise SystemExit(f"the project does not run: {text[-2000:]}")
        time.sleep(0.1)  # the next look at the file


def ended(client: subprocess.Popen[str]) -> dict[str, Any]:
    """Return what a client printed at its end, without what all of them print."""
    text, _ = client.communicate()
    if client.returncode:
        raise SystemExit(f"{client.args!r} ended with {client.returncode}")
    told: dict[str, Any] = json.loads(text)
    if "requests" in told:  # the one of Modbus
        return {"requests_per_s": told["requests"] / told["seconds"], "torn": told["torn"]}
    return told


def figures(report: Path) -> dict[str, Any]:
    """Return what the report of a run says of the scan."""
    told = json.loads(report.read_text())
    (timing,) = told["task_classes"]
    causes = timing["violations"]
    return {
        "rights": ", ".join(told["realtime_rights"]) or "no rights",
        "cycles": timing["cycles"],
        "missed": timing["missed_grid_points"],
        "stalls": causes["host"],
        "own": sum(count for cause, count in causes.items() if cause != "host"),
        "p50_us": timing["lateness_ns"]["p50"] / 1000,
        "p99_us": timing["lateness_ns"]["p99"] / 1000,
        "controller_us": timing["controller_ns"]["mean"] / 1000,
    }


def first_page(port: int) -> dict[str, Any]:
    """Return seconds and bytes of the first page with all that it names, by one request each."""
    front = HERE.parent / "plcsim" / "web" / "front"
    kinds = (".css", ".js", ".svg")
    names = [f.relative_to(front).as_posix() for f in front.rglob("*") if f.suffix in kinds]
    started_s, weight = time.monotonic(), 0
    for name in ("", *sorted(names)):
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/{name}", timeout=30) as answer:
            weight += len(answer.read())
    return {"page_s": time.monotonic() - started_s, "page_bytes": weight}


def measure(options: argparse.Namespace) -> list[dict[str, Any]]:
    """Run all legs; each is printed when it has ended."""
    legs: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory(prefix="plcsim-web-") as place:
        folder = Path(place)
        client = build(folder, "modbus_client", "-pthread")
        if client is None:
            raise SystemExit("gcc is needed for the client of Modbus")
        console.print(
            "leg    cycles  missed (stalls; own)  late p50 us  p99 us  LATCH+PUBLISH us  Modbus/s"
            "  values/s of a browser  trace: samples, missing, lost  OPC UA changes/s",
            soft_wrap=True,
        )
        for number in range(options.rounds):
            kinds = (0, options.browsers) if number % 2 == 0 else (options.browsers, 0)
            for browsers in kinds:
                legs.append(Leg(folder, client).run(options.seconds, browsers))
                show(legs[-1], options.seconds)
        legs.append(
            Leg(folder, client).run(options.trace_seconds, options.browsers, with_page=True)
        )
        show(legs[-1], options.trace_seconds)
    return legs


def show(leg: dict[str, Any], seconds: float) -> None:
    """Print one leg."""
    more = ""
    if leg["kind"] == "all":
        more = (
            f"  {leg['updates_per_s']:21.1f}"
            f"  {leg['samples']:14}, {leg['missing']:7}, {leg['lost']:4}"
            f"  {leg['changes'] / seconds:16,.0f}"
        )
    console.print(
        f"{leg['kind']:4}  {leg['cycles']:7}  {leg['missed']:6} ({leg['stalls']:6}; {leg['own']:3})"
        f"  {leg['p50_us']:11.1f}  {leg['p99_us']:6.1f}  {leg['controller_us']:16.1f}"
        f"  {leg['requests_per_s']:8,.0f}{more}",
        soft_wrap=True,
    )


def targets_of(legs: list[dict[str, Any]]) -> list[Target]:
    """Print the comparison, and return what it is to reach."""
    *paired, last = legs
    of = {kind: [leg for leg in paired if leg["kind"] == kind] for kind in ("none", "all")}
    table = figures_table(
        "medians", "late p50 us", "p99 us", "missed", "stalls", "own", "LATCH+PUBLISH us"
    )
    for kind, rows in of.items():
        keys = ("p50_us", "p99_us", "missed", "stalls", "own", "controller_us")
        table.add_row(kind, *(f"{statistics.median(row[key] for row in rows):.1f}" for key in keys))
    console.print()
    console.print(table)
    sums = {kind: {key: sum(row[key] for row in rows) for key in ("missed", "stalls", "own")}
            for kind, rows in of.items()}  # fmt: skip
    chance = {key: 2 * math.sqrt(sums["all"][key] + sums["none"][key]) for key in ("stalls", "own")}
    for kind, row in sums.items():
        console.print(
            f"{kind}: {row['missed']} grid points missed in {row['stalls']} stalls by the host and "
            f"{row['own']} own, in {len(of[kind])} legs",
            soft_wrap=True,
        )
    torn = sum(leg["torn"] for leg in legs)
    console.print(f"rights: {last['rights']}; torn blocks of Modbus: {torn}", soft_wrap=True)
    pairs = zip(of["all"], of["none"], strict=True)
    late = statistics.median(a["p99_us"] - n["p99_us"] for a, n in pairs)
    missing = max(leg["missing"] for leg in legs if leg["kind"] == "all")
    return [
        Target("p99 of wake lateness beside all clients (median of pairs)", late, 20, "us more"),
        *(
            Target(
                f"stalls {name} that all clients add",
                sums["all"][key] - sums["none"][key],
                math.floor(chance[key]),
                "(by chance)",
            )
            for key, name in (("stalls", "by the host"), ("own", "of its own"))
        ),
        Target("samples missing in any trace", missing, 0, ""),
        Target(
            f"samples of the trace of {TRACED} tags in {last['seconds']:.0f} s",
            last["samples"],
            980 * (last["seconds"] - 1),
            "",
            at_least=True,
        ),
        Target("first page beside all clients", last["page_s"], 1, "s"),
        Target("page weight", last["page_bytes"], 500_000, "bytes"),
    ]


def main() -> int:
    """Measure and print; return 1 where a target is not met."""
    parser = argparse.ArgumentParser(description="Browsers, a trace, OPC UA beside a 1 ms scan.")
    parser.add_argument("--seconds", type=number_above_0, default=20, help="of each leg")
    parser.add_argument("--rounds", type=number_above_0, default=4, help="pairs of legs")
    parser.add_argument("--browsers", type=number_above_0, default=10)
    parser.add_argument("--trace-seconds", type=number_above_0, default=60)
    parser.add_argument("--json", type=Path, default=None, metavar="FILE")
    options = parser.parse_args()
    hosts = [print_machine("before")]
    legs = measure(options)
    targets = targets_of(legs)
    hosts.append(print_machine("after"))
    print_targets(targets)
    write_json(options.json, hosts, targets, legs=legs)
    return 0 if all(target.met for target in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
