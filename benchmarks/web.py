"""The pages beside a 1 ms scan: what the scan notices, what a trace loses, what a page weighs.

    python benchmarks/web.py [--seconds 20] [--rounds 3] [--browsers 10] [--trace-seconds 60]
        [--json FILE]

(a) lateness, missed grid points and CPU time of LATCH and PUBLISH of a scan of 1 ms, with rights
where the host gives them, in turns: no pages, pages that nobody looks at, and browsers that watch
200 tags ten times a second each, one of which traces 8 tags in every cycle. A host that is shared
loses grid points by itself; so each figure stands beside that of the other turns of the same run.
(b) samples of the trace that are missing: by their cycle numbers, and by what the page says.
(c) time and bytes of the first page with all that it loads, from the first request on.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path
from typing import Any

from _ports import free_port
from websockets.asyncio.client import connect

TAGS = 200
TRACED = 8
PROGRAM = f"""
from plcsim import Program
from st_types import ARRAY, REAL, UDINT, var

class Main(Program):
    count = var(UDINT)
    values = var(ARRAY(REAL, (1, {TAGS})))

    def cyclic(self):
        self.count += 1
        for index in range(1, {TRACED}):
            self.values[index] += 0.5
"""
WATCHED = [f"main.values[{index}]" for index in range(1, TAGS + 1)]
TRACE = ["main.count", *WATCHED[: TRACED - 1]]
PAGE = ("", "style.css", "main.js", "dom.js", "format.js", "link.js", "control.js", "forces.js",
        "icon.svg", "vendor/uplot/uPlot.min.css", "pages/classes.js", "pages/logbook.js",
        "pages/network.js", "pages/source.js", "pages/system.js", "pages/trace.js",
        "pages/variables.js", "vendor/uplot/uPlot.iife.min.js")  # fmt: skip


def make_project(folder: Path, web: str) -> Path:
    project = folder / "project"
    (project / "main").mkdir(parents=True, exist_ok=True)
    (project / "main" / "main.py").write_text(PROGRAM)
    (project / "plc.toml").write_text(
        f'[task_class.1]\ncycle = "1ms"\ntolerance = "10s"\nprograms = ["main"]\n{web}'
    )
    return project


class Browser:
    """A browser that watches tags; one of them traces."""

    def __init__(self, port: int, *, traces: bool) -> None:
        self._port = port
        self._traces = traces
        self.messages = 0
        self.cycles: list[int] = []
        self.lost = 0

    async def run(self, seconds: float) -> None:
        url, origin = f"ws://127.0.0.1:{self._port}/live", f"http://127.0.0.1:{self._port}"
        async with connect(url, origin=origin, max_size=None, compression="deflate") as socket:
            await socket.send(json.dumps({"id": 1, "do": "watch", "tags": WATCHED}))
            if self._traces:
                await socket.send(json.dumps({"id": 2, "do": "trace", "tags": TRACE}))
            try:
                async with asyncio.timeout(seconds):
                    while True:
                        self._take(await socket.recv())
            except TimeoutError:
                pass

    def _take(self, message: str | bytes) -> None:
        self.messages += 1
        if isinstance(message, bytes):
            _, count, _, self.lost = struct.unpack_from("<IIII", message)
            cycles = struct.unpack_from(f"<{count}d", message, 16 + 8 * count)
            self.cycles += map(int, cycles)

    @property
    def missing(self) -> int:
        """Cycles between the first and the last that have no sample."""
        return self.cycles[-1] - self.cycles[0] + 1 - len(self.cycles) if self.cycles else -1


def await_pages(port: int) -> None:
    deadline = time.monotonic() + 60
    while True:
        try:
            urllib.request.urlopen(f"http://127.0.0.1:{port}/icon.svg", timeout=5).close()
        except OSError:
            if time.monotonic() > deadline:
                raise
            time.sleep(0.1)  # the pages are asked until they are there
        else:
            return


def one_run(folder: Path, kind: str, browsers: int, seconds: float) -> dict[str, Any]:
    """Run the project once; return the figures of its report and what browsers saw."""
    port = free_port()
    project = make_project(folder, "" if kind == "no pages" else f"[web]\nport = {port}\n")
    report = folder / "report.json"
    command = [sys.executable, "-m", "plcsim", "run", "--quiet", "--for", f"{seconds + 12:.0f}s",
               "--report", str(report), str(project)]  # fmt: skip
    clients: list[Browser] = []
    with subprocess.Popen(command) as process:
        if kind != "no pages":
            await_pages(port)
        if kind == "browsers":
            clients = [Browser(port, traces=number == 0) for number in range(browsers)]
            asyncio.run(look(clients, seconds))
        process.wait()
    (task_class,) = json.loads(report.read_text())["task_classes"]
    found = {
        "kind": kind,
        "cycles": task_class["cycles"],
        "missed": task_class["missed_grid_points"],
        "late_p50_us": task_class["lateness_ns"]["p50"] / 1000,
        "late_p99_us": task_class["lateness_ns"]["p99"] / 1000,
        "controller_us": task_class["controller_ns"]["mean"] / 1000,
    }
    if clients:
        found |= {
            "messages_per_s": sum(each.messages for each in clients) / seconds / len(clients),
            "samples": len(clients[0].cycles),
            "missing": clients[0].missing,
            "lost": clients[0].lost,
        }
    return found


async def look(clients: list[Browser], seconds: float) -> None:
    await asyncio.gather(*(client.run(seconds) for client in clients))


def first_page(folder: Path) -> dict[str, Any]:
    """Return seconds and bytes of the first page, each file by a request of its own."""
    port = free_port()
    project = make_project(folder, f"[web]\nport = {port}\n")
    command = [sys.executable, "-m", "plcsim", "run", "--quiet", str(project)]
    with subprocess.Popen(command) as process:
        await_pages(port)
        times, weight = [], 0
        for _ in range(5):
            start_s, weight = time.monotonic(), 0
            for name in PAGE:
                with urllib.request.urlopen(f"http://127.0.0.1:{port}/{name}") as answer:
                    weight += len(answer.read())
            times.append(time.monotonic() - start_s)
        process.terminate()
        process.wait()
    return {"seconds": statistics.median(times), "bytes": weight}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--browsers", type=int, default=10)
    parser.add_argument("--trace-seconds", type=float, default=60)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    print(f"load of the host: {os.getloadavg()[0]:.1f}, {os.cpu_count()} processors")
    results: dict[str, Any] = {"runs": []}
    kinds = ("no pages", "nobody looks", "browsers")
    print("(a)            missed  late p50 us  p99 us  LATCH+PUBLISH us  messages/s  missing, lost")
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for number in range(options.rounds):
            for kind in (*kinds[number % 3 :], *kinds[: number % 3]):
                run = one_run(folder, kind, options.browsers, options.seconds)
                results["runs"].append(run)
                show(run)
        for kind in kinds[1:]:
            print(f"    {kind}: {added(results['runs'], kind)}")
        if options.trace_seconds:
            run = results["trace"] = one_run(folder, "browsers", 1, options.trace_seconds)
            print(f"(b) {run['samples']} samples, {run['missing']} missing, {run['lost']} lost")
        page = results["page"] = first_page(folder)
        print(f"(c) first page: {page['seconds'] * 1000:.0f} ms, {page['bytes']:,} bytes")
    if options.json:
        options.json.write_text(json.dumps(results, indent=2) + "\n")


def show(run: dict[str, Any]) -> None:
    told = ""
    if run["kind"] == "browsers":
        told = f"{run['messages_per_s']:>12.1f}  {run['missing']:>7}, {run['lost']}"
    print(
        f"{run['kind']:14} {run['missed']:>6}  {run['late_p50_us']:>11.1f}  "
        f"{run['late_p99_us']:>6.0f}  {run['controller_us']:>16.1f}{told}",
        flush=True,
    )


def added(runs: list[dict[str, Any]], kind: str) -> str:
    """Return what a kind adds to the runs without pages, by medians."""

    def median(of: str, key: str) -> float:
        return statistics.median(run[key] for run in runs if run["kind"] == of)

    parts = [
        f"{name} {median(kind, key) - median('no pages', key):+.1f}"
        for key, name in (
            ("late_p50_us", "lateness p50 us"),
            ("late_p99_us", "p99 us"),
            ("controller_us", "LATCH+PUBLISH us"),
            ("missed", "missed"),
        )
    ]
    return ", ".join(parts)


if __name__ == "__main__":
    main()
