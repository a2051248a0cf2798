"""Modbus TCP under load: requests/s beside two yardsticks, and what the scan notices of it.

    python benchmarks/modbus_load.py [--only abcde] [--seconds 3] [--scan-seconds 60] [--rounds 6]
        [--soak-minutes 0] [--json FILE]

(a) requests/s and CPU time of the server for each request, beside pymodbus' own server and a
libmodbus server in C. (b) lateness and missed grid points of a 1 ms scan with 0, 4 and 50 clients
at full rate, and with a busy processor but no client. (c) the time of write, program, read back.
(d) the service killed under load. (e) memory and everything else over many minutes of reads and
writes. For (a) the server has the first processor and the client (in C) the last one; for (b) and
(e) both have the first one, the scan the last one. Needs gcc; without libmodbus-dev its column is
left out.

A virtual machine loses grid points whether there are clients or not, and not evenly. So (b) runs in
short rounds in which every load has its turn, each round beginning with another one, and compares
stalls (groups of missed grid points): all points of a stall have one cause. Two counts of stalls
differ by chance up to about twice the root of their sum; that is printed beside the difference. A
stall that comes while the hypervisor takes time from the scan's processor is counted as such; how
often it does so at any time is printed beside it, because only more than that says something.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from _modbus_site import (
    BLOCK,
    ECHO,
    TORN,
    TORN_AT,
    WRITTEN,
    WRITTEN_AT,
    Site,
    build,
    child_with,
    cpu_s,
    make_project,
    registers,
    result_of,
    run_client,
    running,
    start_client,
    wait_for,
)
from _ports import free_port
from _stalls import StallWatch

CONNECTIONS = (1, 10, 50)
REGISTERS = (10, 125)
FIRST_CPU, LAST_CPU = min(os.sched_getaffinity(0)), max(os.sched_getaffinity(0))

STOCK = """
import sys
from pymodbus.server import StartTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice

data = SimData(0, count=1000, values=0, datatype=DataType.REGISTERS)
StartTcpServer(SimDevice(1, simdata=[data]), address=("127.0.0.1", int(sys.argv[1])))
"""


def throughput(client: Path, server: int, port: int, seconds: float) -> dict[str, Any]:
    """Return requests/s and microseconds of the server's CPU for each request, by load."""
    found = {}
    for connections in CONNECTIONS:
        for count in REGISTERS:
            best: dict[str, Any] = {"per_s": 0}
            for _ in range(2):
                before = cpu_s(server)
                load = run_client(client, "load", port, connections, count, seconds, cpu=LAST_CPU)
                used_s = cpu_s(server) - before
                per_s = load["requests"] / load["seconds"]
                if per_s > best["per_s"]:
                    cpu_us = 1e6 * used_s / max(1, load["requests"])
                    best = {"per_s": round(per_s), "cpu_us": round(cpu_us, 1), **load}
            found[f"{connections}c/{count}r"] = best
    return found


def compare(folder: Path, client: Path, seconds: float) -> dict[str, Any]:
    """Return table (a)."""
    results: dict[str, Any] = {}
    port = free_port()
    project = make_project(folder, port, BLOCK)
    plcsim = [sys.executable, "-m", "plcsim.cli.main", "run", "--quiet", str(project)]
    with running(plcsim, port, None) as process:
        service = child_with(process.pid, "plcsim.modbus.service")
        os.sched_setaffinity(service, {FIRST_CPU})
        results["plcsim"] = throughput(client, service, port, seconds)
    port = free_port()
    with running([sys.executable, "-c", STOCK, str(port)], port, FIRST_CPU) as process:
        results["pymodbus"] = throughput(client, process.pid, port, seconds)
    server = build(folder, "modbus_libmodbus_server", "-I/usr/include/modbus", "-lmodbus")
    if server is not None:
        port = free_port()
        with running([str(server), str(port)], port, FIRST_CPU) as process:
            results["libmodbus"] = throughput(client, process.pid, port, seconds)
    return results


def show_comparison(results: dict[str, Any]) -> None:
    names = list(results)
    print("(a) requests/s | server CPU us for each request")
    print(f"{'':12}" + "".join(f"{name:>20}" for name in names) + f"{'plcsim/pymodbus':>18}")
    for load in results["plcsim"]:
        cells = [
            f"{results[n][load]['per_s']:>10,} | {results[n][load]['cpu_us']:>6}" for n in names
        ]
        ratio = results["plcsim"][load]["per_s"] / max(1, results["pymodbus"][load]["per_s"])
        print(f"{load:12}" + "".join(f"{cell:>20}" for cell in cells) + f"{ratio:>17.1f}x")


BUSY = "busy"
LOADS: tuple[int | str, ...] = (0, 4, BUSY, 50)
"""Clients at full rate; "busy" is a control: none, but the first processor computes meanwhile."""


def beside_a_scan(folder: Path, client: Path, seconds: float, rounds: int) -> list[dict[str, Any]]:
    """Return the runs of (b): ``seconds`` of each load, in rounds."""
    rows = []
    for number in range(rounds):
        turn = number % len(LOADS)
        for load in (*LOADS[turn:], *LOADS[:turn]):
            rows.append(one_scan(folder, client, load, seconds / rounds))
            print(f"  round {number + 1}, load {load}: {rows[-1]['missed']} missed", flush=True)
    return rows


def one_scan(folder: Path, client: Path, load: int | str, seconds: float) -> dict[str, Any]:
    row: dict[str, Any] = {"load": load}
    with Site(folder, BLOCK) as site:
        row["rss_before_kib"] = site.resident_kib()
        with StallWatch(site.project, LAST_CPU) as watch:
            if load == BUSY:
                compute_for(seconds)
            elif load:
                row |= run_client(client, "load", site.port, load, 125, seconds, cpu=FIRST_CPU)
            else:
                time.sleep(seconds)
        row["rss_after_kib"] = site.resident_kib()
    return row | site.figures | watch.stalls._asdict() | {"missed": watch.missed}


def compute_for(seconds: float) -> None:
    loop = f"import time; end = time.time() + {seconds}\nwhile time.time() < end: pass"
    subprocess.run(["taskset", "-c", str(FIRST_CPU), sys.executable, "-c", loop], check=True)


def show_scan(rows: list[dict[str, Any]], seconds: float) -> None:
    print(
        f"(b) a 1 ms scan beside clients that read 125 registers at full rate, {seconds:g} s each"
    )
    print(
        "load  requests/s  torn  hung  missed  stalls  in stolen time (of all)  "
        "late p50 us  p99 us  RSS scan, service KiB"
    )
    sums = {load: total([row for row in rows if row["load"] == load]) for load in LOADS}
    for load, found in sums.items():
        share = 100 * found["stolen_windows"] / max(1, found["windows"])
        scan, service = found["growth"]
        print(
            f"{load:>4}  {found['per_s']:10,.0f}  {found['torn']:4}  {found['hung']:4}"
            f"  {found['missed']:6}  {found['stalls']:6}"
            f"  {found['stolen_stalls']:14} ({share:4.0f} %)"
            f"  {found['p50']:11.1f}  {found['p99']:6.1f}  {scan:+}, {service:+}"
        )
    for load in LOADS[1:]:
        more = sums[load]["stalls"] - sums[0]["stalls"]
        chance = 2 * math.sqrt(sums[load]["stalls"] + sums[0]["stalls"])
        late = sums[load]["p99"] - sums[0]["p99"]
        print(
            f"{load} beside none: {more:+} stalls, by chance up to {chance:.1f}; p99 {late:+.1f} us"
        )


def total(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Return sums over the rounds of one load, and medians of what cannot be added."""
    names = ("torn", "hung", "missed", "windows", "stolen_windows", "stalls", "stolen_stalls")
    found: dict[str, Any] = {name: sum(row.get(name, 0) for row in rows) for name in names}
    for p in ("p50", "p99"):
        found[p] = statistics.median(row["lateness_ns"][p] / 1000 for row in rows)
    found["per_s"] = statistics.median(r.get("requests", 0) / r.get("seconds", 1) for r in rows)
    found["growth"] = [
        max(row["rss_after_kib"][i] - row["rss_before_kib"][i] for row in rows) for i in (0, 1)
    ]
    return found


def write_and_read_back(folder: Path, client: Path, seconds: float) -> dict[str, Any]:
    """Return the figures of (c)."""
    with Site(folder, ECHO) as site:
        return run_client(client, "echo", site.port, seconds)


def show_echo(echo: dict[str, Any]) -> None:
    print(
        f"(c) write, program, read back at 1 ms: {echo['loops']} times, "
        f"p50 {echo['p50_us']} us, p99 {echo['p99_us']} us"
    )


KILLS = 5


def killed(folder: Path, client: Path) -> dict[str, Any]:
    """Return the figures of (d): the service is killed under load, again and again."""
    back_s = []
    with Site(folder, BLOCK) as site:
        for _ in range(KILLS):
            load = subprocess.Popen(
                [str(client), "load", str(site.port), "4", "125", "60"], stderr=subprocess.DEVNULL
            )
            time.sleep(1)  # let it come to its full rate
            os.kill(site.service, signal.SIGKILL)
            killed_at = time.monotonic()
            load.wait()  # its connections are reset
            wait_for(site.port, site.process)
            back_s.append(round(time.monotonic() - killed_at, 3))
    return {"back_s": back_s, **site.figures}


def show_killed(kills: dict[str, Any]) -> None:
    print(
        f"(d) service killed {KILLS} times under load: back after {kills['back_s']} s, "
        f"{kills['missed']} of {kills['cycles']} grid points missed, "
        f"late p99 {kills['lateness_ns']['p99'] / 1000:.1f} us"
    )


def soak(folder: Path, client: Path, minutes: int) -> dict[str, Any]:
    """Return the figures of (e): 4 clients that read, one that writes; memory minute by minute."""
    print(f"(e) {minutes} min of 4 clients that read 125 registers and one that writes 120")
    print("minute  RSS scan, service KiB  missed")
    kib = []
    with Site(folder, [*BLOCK, *WRITTEN, *TORN]) as site:
        with StallWatch(site.project, LAST_CPU) as watch:
            kib.append(site.resident_kib())
            seconds = 60 * minutes
            loads = (
                start_client(client, "load", site.port, 4, 125, seconds, cpu=FIRST_CPU),
                start_client(client, "write", site.port, WRITTEN_AT, 120, seconds, cpu=FIRST_CPU),
            )
            start = time.monotonic()
            for minute in range(1, minutes + 1):
                time.sleep(max(0.0, start + 60 * minute - 0.5 - time.monotonic()))
                kib.append(site.resident_kib())
                print(f"{minute:6}  {kib[-1][0]:13}, {kib[-1][1]:6}  {watch.missed:6}", flush=True)
            read, written = map(result_of, loads)
        torn = int.from_bytes(registers(site.port, TORN_AT), "big")
    growth = [kib[-1][i] - kib[1][i] for i in (0, 1)]
    stalls = watch.stalls._asdict()
    return {"read": read, "written": written, "torn_writes": torn, "rss_kib": kib,
            "growth_kib": growth, **stalls, **site.figures}  # fmt: skip


def show_soak(found: dict[str, Any]) -> None:
    for name in ("read", "written"):
        one = found[name]
        print(
            f"{name}: {one['requests']:,} requests, "
            f"exceptions by code {one['exceptions'] or 'none'}, {one['hung']} hung, "
            f"p50 {one['p50_us']} us, p99 {one['p99_us']} us"
        )
    late = found["lateness_ns"]
    print(
        f"torn: {found['read']['torn']} reads, {found['torn_writes']} writes; "
        f"{found['missed']} of {found['cycles']} grid points missed in {found['stalls']} stalls, "
        f"{found['stolen_stalls']} of them in stolen time; "
        f"late p50 {late['p50'] / 1000:.1f} us, p99 {late['p99'] / 1000:.1f} us"
    )
    scan, service = found["growth_kib"]
    print(f"growth after the first minute: scan {scan:+} KiB, service {service:+} KiB")


def main() -> int:
    options = _options()
    if shutil.which("gcc") is None:
        raise SystemExit("gcc is needed for the client")
    machine = f"{platform.machine()}, {os.cpu_count()} processors, Linux {platform.release()}"
    print(f"{machine}, Python {platform.python_version()}", flush=True)
    results: dict[str, Any] = {"machine": machine}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        client = build(folder, "modbus_client")
        if client is None:
            raise SystemExit("modbus_client.c does not compile")
        for part in options.only:
            results[part] = _run_part(part, folder, client, options)
    if options.json:
        options.json.write_text(json.dumps(results, indent=2) + "\n")
    return 0


def _run_part(part: str, folder: Path, client: Path, options: argparse.Namespace) -> object:
    """Run one part, print its figures and return them."""
    found: Any = None
    match part:
        case "a":
            show_comparison(found := compare(folder, client, options.seconds))
        case "b":
            found = beside_a_scan(folder, client, options.scan_seconds, options.rounds)
            show_scan(found, options.scan_seconds)
        case "c":
            show_echo(found := write_and_read_back(folder, client, options.seconds))
        case "d":
            show_killed(found := killed(folder, client))
        case "e" if options.soak_minutes:
            show_soak(found := soak(folder, client, options.soak_minutes))
    return found


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Modbus TCP under load, and the scan beside it.")
    parser.add_argument("--only", type=_parts, default="abcde", metavar="PARTS", help="such as be")
    parser.add_argument("--seconds", type=float, default=3.0, help="of each load of (a), of (c)")
    parser.add_argument("--scan-seconds", type=float, default=60.0, help="of each load of (b)")
    parser.add_argument("--rounds", type=int, default=6, help="of (b), one after another")
    parser.add_argument("--soak-minutes", type=int, default=0, help="of (e); 0 leaves it out")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep all figures")
    return parser.parse_args()


def _parts(text: str) -> str:
    if not text or set(text) - set("abcde"):
        raise argparse.ArgumentTypeError(f"{text!r} is not some of abcde")
    return text


if __name__ == "__main__":
    sys.exit(main())
