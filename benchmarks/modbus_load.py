"""Modbus TCP under load: requests/s beside two yardsticks, and what the scan notices of it.

    python benchmarks/modbus_load.py [--seconds 3] [--scan-seconds 20] [--rounds 3] [--json FILE]

All of one run: (a) requests/s and CPU time of the server for each request, beside pymodbus' own
server and a libmodbus server in C; (b) lateness and missed grid points of a 1 ms scan with 0, 4 and
50 clients at full rate; (c) the time of write, program, read back; (d) the service killed under
load. For (a) the server has the first processor and the client (in C) the last one; for (b) both
have the first one, the scan the last one. Needs gcc; without libmodbus-dev its column is left out.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import shutil
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

HERE = Path(__file__).parent
CONNECTIONS = (1, 10, 50)
REGISTERS = (10, 125)

PROGRAM = """
from plcsim import Program
from st_types import ARRAY, UINT, var


class Load(Program):
    echo_in = var(UINT)
    echo_out = var(UINT)
    block = var(ARRAY(UINT, (1, 125)))
    count = var(UINT)

    def cyclic(self) -> None:
        self.echo_out = self.echo_in
        self.count += 1
        self.block.write(self.count.to_bytes(2, "little") * 125)
"""

STOCK = """
import sys
from pymodbus.server import StartTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice

data = SimData(0, count=1000, values=0, datatype=DataType.REGISTERS)
StartTcpServer(SimDevice(1, simdata=[data]), address=("127.0.0.1", int(sys.argv[1])))
"""


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        return int(probe.getsockname()[1])


def build(folder: Path, name: str, *flags: str) -> Path | None:
    """Compile one of the C programs here; None where its library is missing."""
    target = folder / name
    command = ["gcc", "-O2", "-o", str(target), str(HERE / f"{name}.c"), *flags]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return target if done.returncode == 0 else None


def make_project(folder: Path, port: int, rows: list[str]) -> Path:
    project = folder / f"project{port}"
    (project / "load").mkdir(parents=True)
    (project / "load" / "main.py").write_text(PROGRAM)
    (project / "tags.csv").write_text("\n".join(["tag,area,offset", *rows]) + "\n")
    (project / "plc.toml").write_text(
        f'[task_class.1]\ncycle = "1ms"\ntolerance = "1s"\nprograms = ["load"]\n'
        f'[modbus]\nport = {port}\naudit = ""\n'
    )
    return project


BLOCK = [f"load.block[{i}],hr,{i - 1}" for i in range(1, 126)]
ECHO = ["load.echo_in,hr,0", "load.echo_out,hr,1"]


def wait_for(port: int, process: subprocess.Popen[bytes]) -> None:
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        try:
            with socket.create_connection(("127.0.0.1", port), 1) as probe:
                probe.sendall(bytes.fromhex("000100000006010300000001"))
                if probe.recv(260)[7:8] == b"\x03":
                    return
        except OSError:
            pass
        if process.poll() is not None:
            raise SystemExit(f"{process.args!r} ended")
        time.sleep(0.05)
    raise SystemExit(f"nothing serves port {port}")


@contextmanager
def running(command: list[str], port: int, cpu: int | None) -> Iterator[subprocess.Popen[bytes]]:
    """Run a server; where a processor is given, it stays on it."""
    pinned = command if cpu is None else ["taskset", "-c", str(cpu), *command]
    process = subprocess.Popen(pinned, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        wait_for(port, process)
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def cpu_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_kib(pid: int) -> int:
    text = Path(f"/proc/{pid}/status").read_text()
    return int(text.split("VmRSS:")[1].split()[0])


def child_with(pid: int, module: str) -> int:
    """Return the child process that runs a module."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            parent = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
            if parent == pid and module in (folder / "cmdline").read_text():
                return int(folder.name)
        except (OSError, ValueError):
            continue
    raise SystemExit(f"no process runs {module}")


def run_client(client: Path, *arguments: object, cpu: int | None = None) -> dict[str, Any]:
    command = [str(client), *map(str, arguments)]
    if cpu is not None:
        command = ["taskset", "-c", str(cpu), *command]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def throughput(client: Path, server: int, port: int, seconds: float, cpu: int) -> dict[str, Any]:
    """Return requests/s and microseconds of the server's CPU for each request, by load."""
    found = {}
    for connections in CONNECTIONS:
        for registers in REGISTERS:
            best: dict[str, Any] = {"per_s": 0}
            for _ in range(2):
                before = cpu_s(server)
                load = run_client(client, "load", port, connections, registers, seconds, cpu=cpu)
                used_s = cpu_s(server) - before
                per_s = load["requests"] / load["seconds"]
                if per_s > best["per_s"]:
                    cpu_us = 1e6 * used_s / max(1, load["requests"])
                    best = {"per_s": round(per_s), "cpu_us": round(cpu_us, 1), **load}
            found[f"{connections}c/{registers}r"] = best
    return found


def compare(folder: Path, client: Path, seconds: float) -> dict[str, Any]:
    """Return table (a)."""
    first, last = min(os.sched_getaffinity(0)), max(os.sched_getaffinity(0))
    results: dict[str, Any] = {}
    port = free_port()
    project = make_project(folder, port, BLOCK)
    plcsim = [sys.executable, "-m", "plcsim.cli.main", "run", "--quiet", str(project)]
    with running(plcsim, port, None) as process:
        service = child_with(process.pid, "plcsim.services.modbus")
        os.sched_setaffinity(service, {first})
        results["plcsim"] = throughput(client, service, port, seconds, last)
    port = free_port()
    with running([sys.executable, "-c", STOCK, str(port)], port, first) as process:
        results["pymodbus"] = throughput(client, process.pid, port, seconds, last)
    server = build(folder, "modbus_libmodbus_server", "-I/usr/include/modbus", "-lmodbus")
    if server is not None:
        port = free_port()
        with running([str(server), str(port)], port, first) as process:
            results["libmodbus"] = throughput(client, process.pid, port, seconds, last)
    return results


BUSY = "busy"
LOADS: tuple[int | str, ...] = (0, BUSY, 4, 50)
"""Clients at full rate; "busy" is a control: none, but the first processor computes meanwhile."""


def beside_a_scan(folder: Path, client: Path, seconds: float, rounds: int) -> list[dict[str, Any]]:
    """Return table (b): rounds of one run for each load, so that the host's mood is in all."""
    return [
        one_scan(folder, client, load, seconds / rounds) for _ in range(rounds) for load in LOADS
    ]


def one_scan(folder: Path, client: Path, load: int | str, seconds: float) -> dict[str, Any]:
    first, port = min(os.sched_getaffinity(0)), free_port()
    project = make_project(folder, port, BLOCK)
    report = folder / f"report{port}.json"
    command = [sys.executable, "-m", "plcsim.cli.main", "run", "--quiet",
               "--report", str(report), str(project)]  # fmt: skip
    row: dict[str, Any] = {"load": load}
    with running(command, port, None) as process:
        service = child_with(process.pid, "plcsim.services.modbus")
        scan = child_with(process.pid, "plcsim.scan_process")
        row["rss_before_kib"] = [resident_kib(scan), resident_kib(service)]
        if load == BUSY:
            compute_for(seconds, first)
        elif load:
            row |= run_client(client, "load", port, load, 125, seconds, cpu=first)
        else:
            time.sleep(seconds)
        row["rss_after_kib"] = [resident_kib(scan), resident_kib(service)]
    (scanned,) = json.loads(report.read_text())["task_classes"]
    row["cycles"] = scanned["cycles"]
    row["missed"] = scanned["missed_grid_points"]
    row["lateness_ns"] = scanned["lateness_ns"]
    return row


def compute_for(seconds: float, cpu: int) -> None:
    loop = f"import time; end = time.time() + {seconds}\nwhile time.time() < end: pass"
    subprocess.run(["taskset", "-c", str(cpu), sys.executable, "-c", loop], check=True)


def write_and_read_back(folder: Path, client: Path, seconds: float) -> dict[str, Any]:
    """Return table (c)."""
    port = free_port()
    project = make_project(folder, port, ECHO)
    command = [sys.executable, "-m", "plcsim.cli.main", "run", "--quiet", str(project)]
    with running(command, port, None):
        return run_client(client, "echo", port, seconds)


KILLS = 5


def killed(folder: Path, client: Path) -> dict[str, Any]:
    """Return table (d): the service is killed under load, again and again."""
    port = free_port()
    project = make_project(folder, port, BLOCK)
    report = folder / "killed.json"
    command = [sys.executable, "-m", "plcsim.cli.main", "run", "--quiet",
               "--report", str(report), str(project)]  # fmt: skip
    back_s = []
    with running(command, port, None) as process:
        for _ in range(KILLS):
            load = subprocess.Popen(
                [str(client), "load", str(port), "4", "125", "60"], stderr=subprocess.DEVNULL
            )
            time.sleep(1)
            os.kill(child_with(process.pid, "plcsim.services.modbus"), signal.SIGKILL)
            killed_at = time.monotonic()
            load.wait()  # its connections are reset
            wait_for(port, process)
            back_s.append(round(time.monotonic() - killed_at, 3))
    (scanned,) = json.loads(report.read_text())["task_classes"]
    return {
        "back_s": back_s,
        "cycles": scanned["cycles"],
        "missed": scanned["missed_grid_points"],
        "lateness_ns": scanned["lateness_ns"],
    }


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


def show_scan(rows: list[dict[str, Any]]) -> None:
    print("(b) a 1 ms scan beside clients that read 125 registers at full rate; medians of rounds")
    print(
        "load  requests/s  torn  hung   cycles  missed  late p50 us  p99 us   RSS scan, service KiB"
    )
    for load in LOADS:
        same = [row for row in rows if row["load"] == load]
        late = {
            p: statistics.median(r["lateness_ns"][p] / 1000 for r in same) for p in ("p50", "p99")
        }
        per_s = statistics.median(r.get("requests", 0) / r.get("seconds", 1) for r in same)
        torn, hung, cycles, missed = (
            sum(r.get(name, 0) for r in same) for name in ("torn", "hung", "cycles", "missed")
        )
        growth = [max(r["rss_after_kib"][i] - r["rss_before_kib"][i] for r in same) for i in (0, 1)]
        print(
            f"{load:>4}  {per_s:10,.0f}  {torn:4}  {hung:4}  {cycles:7}  {missed:6}"
            f"  {late['p50']:11.1f}  {late['p99']:6.1f}   +{growth[0]}, +{growth[1]}"
        )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])  # type: ignore[union-attr]
    parser.add_argument("--seconds", type=float, default=3.0, help="of each load of (a)")
    parser.add_argument("--scan-seconds", type=float, default=20.0, help="of each run of (b), (c)")
    parser.add_argument("--rounds", type=int, default=3, help="of (b), one after another")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep all figures")
    options = parser.parse_args()
    if shutil.which("gcc") is None:
        raise SystemExit("gcc is needed for the client")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        client = build(folder, "modbus_client")
        if client is None:
            raise SystemExit("modbus_client.c does not compile")
        comparison = compare(folder, client, options.seconds)
        scans = beside_a_scan(folder, client, options.scan_seconds, options.rounds)
        echo = write_and_read_back(folder, client, options.scan_seconds)
        kills = killed(folder, client)
    machine = f"{platform.machine()}, {os.cpu_count()} processors, Linux {platform.release()}"
    print(f"{machine}, Python {platform.python_version()}")
    show_comparison(comparison)
    show_scan(scans)
    print(
        f"(c) write, program, read back at 1 ms: {echo['loops']} times, "
        f"p50 {echo['p50_us']} us, p99 {echo['p99_us']} us"
    )
    print(
        f"(d) service killed {KILLS} times under load: back after {kills['back_s']} s, "
        f"{kills['missed']} of {kills['cycles']} grid points missed, "
        f"late p99 {kills['lateness_ns']['p99'] / 1000:.1f} us"
    )
    if options.json:
        values = {"machine": machine, "comparison": comparison, "scan": scans, "echo": echo,
                  "killed": kills}  # fmt: skip
        options.json.write_text(json.dumps(values, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
