"""``plcsim doctor``."""

from __future__ import annotations

import argparse
import json
import resource
import sys
import tempfile
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.table import Table
from rich.text import Text

from plcsim.cli.console import CommandConsole, print_error
from plcsim.cli.exit_codes import ExitCode, epilog
from plcsim.cli.output_file import check_output, write_output
from plcsim.core.duration import format_duration, parse_duration_ns
from plcsim.doctor.advice import advise
from plcsim.doctor.host import read_host
from plcsim.doctor.loops import LoopOrder, ScanLoop, floor_loop, measure, probe_rights
from plcsim.doctor.verdict import Comparison, Verdict, explain, judge

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.doctor.host import Host
    from plcsim.doctor.loops import MeasuredLoop, Measurement
    from plcsim.host.realtime import Rights

SCHEMA = "plcsim-doctor/1"

SHORTEST_TICK_NS = 100_000
LONGEST_TICK_NS = 1_000_000_000
FEWEST_CYCLES = 20

_STYLES = {Verdict.HELD: "green", Verdict.MOSTLY: "yellow", Verdict.NOT_HELD: "bold red"}


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "doctor",
        help="measure whether this host can hold a tick",
        description="Measure how late this host wakes plcsim's own loop and a bare loop beside it, "
        "without and with real-time rights, and say in words whether the tick can be held: 99.9 "
        "percent of the cycles start less than 20 percent of the tick late, and no grid point is "
        "missed.",
        examples=(
            ("plcsim doctor", "can this host hold 1 ms?"),
            ("plcsim doctor --tick 500us --seconds 60", "a longer look at a shorter tick"),
            ("plcsim doctor --json host.json", "all figures for other programs"),
        ),
        epilog=epilog(
            DONE="measured, whatever the verdict", FAILED="could not measure", INTERRUPTED=""
        ),
    )
    parser.add_argument(
        "--tick", type=_tick_ns, default=1_000_000, metavar="TIME", help="default: 1ms"
    )
    parser.add_argument(
        "--seconds",
        type=_seconds,
        default=2,
        metavar="N",
        help="length of each of the four measurements (default: 2); longer finds rarer delays",
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures as JSON")
    parser.set_defaults(func=doctor)


def _tick_ns(text: str) -> int:
    try:
        tick_ns = parse_duration_ns(text)
    except ValueError as err:
        raise argparse.ArgumentTypeError(str(err)) from None
    if not SHORTEST_TICK_NS <= tick_ns <= LONGEST_TICK_NS:
        shortest, longest = format_duration(SHORTEST_TICK_NS), format_duration(LONGEST_TICK_NS)
        raise argparse.ArgumentTypeError(f"{text} is outside {shortest}..{longest}")
    return tick_ns


def _seconds(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text) <= 86_400:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of seconds in 1..86400")
    return int(text)


def doctor(options: argparse.Namespace) -> int:
    """Measure, print facts, figures, verdicts and advice."""
    check_output("--json", options.json)
    console = CommandConsole()
    host, rights = read_host(), probe_rights()
    _print_host(console, host, rights)
    cycles = max(FEWEST_CYCLES, options.seconds * 1_000_000_000 // options.tick)
    try:
        with tempfile.TemporaryDirectory(prefix="plcsim-doctor-") as folder:
            comparisons = _compare(Path(folder), options.tick, cycles, rights)
    except KeyboardInterrupt:
        print_error("stopped before the measurement was done")
        return ExitCode.INTERRUPTED
    advice = advise(host, rights, comparisons)
    console.print(_figures_table(comparisons))
    _print_verdicts(console, comparisons, rights, advice)
    if options.json is not None:
        result = _result(host, rights, comparisons, advice)
        write_output("--json", options.json, json.dumps(result, indent=2) + "\n")
    return 0


def _compare(folder: Path, tick_ns: int, cycles: int, rights: Rights) -> list[Comparison]:
    """Measure without rights, then with them where the host gives them."""
    loops = (floor_loop(folder), ScanLoop(folder))
    orders = [LoopOrder(tick_ns, cycles, realtime=False)]
    if rights.complete:
        orders.append(LoopOrder(tick_ns, cycles, realtime=True))
    return [Comparison(*(_measure(loop, order) for loop in loops)) for order in orders]


def _measure(loop: MeasuredLoop, order: LoopOrder) -> Measurement:
    """Measure, telling a terminal what is going on."""
    if sys.stderr.isatty():
        rights = "with" if order.realtime else "without"
        duration = format_duration(order.cycles * order.cycle_ns)
        print(f"measuring the {loop.name} loop {rights} rights, {duration} ...", file=sys.stderr)
    return measure(loop, order)


def _print_host(console: CommandConsole, host: Host, rights: Rights) -> None:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), show_header=False)
    for name, value in _facts(host, rights):
        table.add_row(name, Text(value))
    console.print(table)
    console.print()


def _facts(host: Host, rights: Rights) -> Iterator[tuple[str, str]]:
    """Iterate over the facts as a person reads them."""
    yield "kernel", f"{host.kernel}, preemption: {host.preemption}"
    isolated = f", isolated: {host.isolated}" if host.isolated else ", none isolated"
    yield "CPUs", f"{host.cpus}, {host.allowed} allowed{isolated}  {host.cpu_model}".rstrip()
    if host.isolated:
        yield "measured on", f"CPU {host.cpu}; cpu = {host.cpu} in plc.toml lets a scan run there"
    yield "governor", ", ".join(host.governors) or "none (frequencies are not scaled here)"
    yield "machine", f"guest of {host.hypervisor}" if host.hypervisor else "real hardware"
    if host.hypervisor:
        yield "its standstills", "told apart" if host.tells_standstills else "taken for the program"
    yield "container", "yes" if host.container else "no"
    quota = host.quota_percent
    yield "CPU quota", "none" if quota is None else f"{quota} % of one CPU"
    yield "RLIMIT_RTPRIO", _limit(host.rtprio_limit)
    yield "RLIMIT_MEMLOCK", f"{_limit(host.memlock_limit)} (bytes)"
    yield "load", f"{host.load:.2f}"
    yield "Python", host.python
    yield "C compiler", _compiler()
    yield "rights given", ", ".join(rights.granted) or "none"
    if rights.refused:
        yield "rights refused", ", ".join(rights.refused)


def _compiler() -> str:
    """Return what compiles programs in C, or how to get it."""
    from plcsim.ansi_c.toolchain import MISSING, system_clang, zig  # noqa: PLC0415  # for this line only

    found = zig() or system_clang()
    return MISSING if found is None else f"{found.name}, for programs in C"


def _limit(limit: int) -> str:
    return "unlimited" if limit == resource.RLIM_INFINITY else f"{limit:,}"


def _figures_table(comparisons: list[Comparison]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in ("lateness", "rights", "p50", "p99", "p99.9", "max", "missed", "of", "steal"):
        table.add_column(column, justify="left" if column in {"lateness", "rights"} else "right")
    for m in (measurement for comparison in comparisons for measurement in comparison):
        late = m.lateness
        durations = (late.p50_ns, late.p99_ns, late.p99_9_ns, late.maximum_ns)
        table.add_row(
            f"{m.loop} loop",
            "with" if m.order.realtime else "without",
            *(format_duration(d) for d in durations),
            str(m.missed),
            str(m.order.cycles),
            f"{m.stolen_percent:.1f} %",
        )
    return table


def _print_verdicts(
    console: CommandConsole, comparisons: list[Comparison], rights: Rights, advice: list[str]
) -> None:
    console.print()
    for comparison in comparisons:
        style = _STYLES[judge(comparison.scan)]
        console.print(Text(explain(comparison), style=style))
    if not rights.complete:
        refused = ", ".join(rights.refused)
        console.print(Text(f"Real-time rights are not given here ({refused}).", style="yellow"))
    if advice:
        console.print("\nTo get better:")
    for line in advice:
        console.print(Text(f"- {line}"))


def _result(
    host: Host, rights: Rights, comparisons: list[Comparison], advice: list[str]
) -> dict[str, Any]:
    """Return everything as JSON: what was seen, measured and concluded."""
    return {
        "schema": SCHEMA,
        "host": asdict(host),
        "rights": rights._asdict(),
        "measurements": [m.as_json() for c in comparisons for m in c],
        "verdicts": [
            {
                "realtime": c.scan.order.realtime,
                "verdict": judge(c.scan).name.lower(),
                "text": explain(c),
            }
            for c in comparisons
        ],
        "advice": advice,
    }
