"""OPC UA beside a 1 ms scan: 20 subscriptions of 100 variables, and what the scan notices.

    python benchmarks/opcua.py [--seconds 10] [--rounds 3] [--json FILE]

All variables change twice a second. Each round runs the same project without a client and with
one, in turn; the client (a process of its own) shares the first processor with the service, the
scan has one of its own. Printed are the lateness of the scan's wake-ups and the grid points it
missed, the changes that arrived, and the service's share of a processor. The figures that count
are differences within a run.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from _modbus_site import child_with, cpu_s
from _opcua_subscriber import ITEMS, PUBLISHING_MS, SUBSCRIPTIONS
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

SUBSCRIBER = Path(__file__).parent / "_opcua_subscriber.py"
FIRST_CPU, LAST_CPU = min(os.sched_getaffinity(0)), max(os.sched_getaffinity(0))

PROJECT = """
[task_class.1]
cycle = "1ms"
programs = ["line"]

[opcua]
port = {port}
sampling = "{sampling}ms"
"""
VARIABLES = "VAR values : ARRAY[0..1999] OF Cell; at : UINT; cycle : UDINT; END_VAR\n"
TYPES = "TYPE Cell : STRUCT v : UDINT; END_STRUCT; END_TYPE\n"
PROGRAM = """
PROGRAM _CYCLIC
    cycle := cycle + 1;
    IF cycle MOD 500 = 0 THEN
        FOR at := 0 TO 1999 DO
            values[at].v := values[at].v + 1;
        END_FOR
    END_IF
END_PROGRAM
"""


def make_project(folder: Path, port: int) -> Path:
    project = folder / f"line{port}"
    (project / "line").mkdir(parents=True)
    text = PROJECT.format(port=port, sampling=PUBLISHING_MS // 2)
    (project / "plc.toml").write_text(text)
    (project / "Global.typ").write_text(TYPES)
    (project / "line" / "Variables.var").write_text(VARIABLES)
    (project / "line" / "cyclic.st").write_text(PROGRAM)
    return project


def one_run(folder: Path, seconds: float, *, with_client: bool) -> dict[str, Any]:
    port = free_port()
    project = make_project(folder, port)
    report = folder / f"report{port}.json"
    command = [sys.executable, "-m", "plcsim", "run", "--report", str(report), str(project)]
    process = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    assert process.stderr is not None
    told = []
    while "opcua: serving" not in (text := process.stderr.readline()):
        told.append(text)
        if not text:
            raise SystemExit("the project does not run: " + "".join(told))
    service = child_with(process.pid, "plcsim.opcua.service")
    os.sched_setaffinity(service, {FIRST_CPU})
    before, since = cpu_s(service), time.monotonic()
    found: dict[str, Any] = {"changes": 0}
    if with_client:
        client = [sys.executable, str(SUBSCRIBER), str(port), project.name, str(seconds)]
        pinned = ["taskset", "-c", str(FIRST_CPU), *client]
        done = subprocess.run(pinned, stdout=subprocess.PIPE, text=True, check=True)
        found = json.loads(done.stdout)
    else:
        time.sleep(seconds)  # the scan runs beside nobody for as long as it does beside a client
    found["share"] = (cpu_s(service) - before) / (time.monotonic() - since)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    (timing,) = json.loads(report.read_text())["task_classes"]
    return found | {
        "missed": timing["missed_grid_points"],
        "p50_us": timing["lateness_ns"]["p50"] / 1000,
        "p99_us": timing["lateness_ns"]["p99"] / 1000,
    }


def measure(seconds: float, rounds: int) -> dict[bool, list[dict[str, Any]]]:
    runs: dict[bool, list[dict[str, Any]]] = {False: [], True: []}
    with tempfile.TemporaryDirectory(prefix="plcsim-opcua-") as folder:
        for number in range(rounds):
            for with_client in (False, True) if number % 2 == 0 else (True, False):
                runs[with_client].append(one_run(Path(folder), seconds, with_client=with_client))
    return runs


def show(runs: dict[bool, list[dict[str, Any]]], seconds: float) -> list[Target]:
    table = figures_table(
        "clients", "late p50 us", "p99 us", "missed", "changes/s", "service's share of a CPU"
    )
    middle: dict[bool, dict[str, float]] = {}
    for with_client, rows in runs.items():
        values = {key: statistics.median(row[key] for row in rows) for key in rows[0]}
        middle[with_client] = values
        table.add_row(
            f"{SUBSCRIPTIONS} x {ITEMS}" if with_client else "none",
            f"{values['p50_us']:.1f}",
            f"{values['p99_us']:.1f}",
            " ".join(str(row["missed"]) for row in rows),
            f"{values['changes'] / seconds:,.0f}",
            f"{100 * values['share']:.0f} %",
        )
    console.print(table)
    added = middle[True]["p99_us"] - middle[False]["p99_us"]
    missed = middle[True]["missed"] - middle[False]["missed"]
    return [
        Target("p99 of wake lateness beside subscriptions", added, 20, "us more"),
        Target("grid points missed beside subscriptions", missed, 0, "more (medians)"),
    ]


def main() -> int:
    parser = argparse.ArgumentParser(description="OPC UA subscriptions beside a 1 ms scan.")
    parser.add_argument("--seconds", type=number_above_0, default=10, help="of each run")
    parser.add_argument("--rounds", type=number_above_0, default=3)
    parser.add_argument("--json", type=Path, default=None, metavar="FILE")
    options = parser.parse_args()
    hosts = [print_machine("before")]
    runs = measure(options.seconds, options.rounds)
    targets = show(runs, options.seconds)
    hosts.append(print_machine("after"))
    print_targets(targets)
    write_json(options.json, hosts, targets, runs={str(key): rows for key, rows in runs.items()})
    return 0 if all(target.met for target in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
