"""Everybody at once beside a 1 ms scan: browsers, a trace, OPC UA and Modbus.

    python benchmarks/web.py [--seconds 10] [--rounds 3] [--browsers 10] [--trace-seconds 60]
        [--json FILE]

A project in Structured Text with 200 REALs that change in every cycle and 2,000 more that change
twice a second runs with pages, OPC UA and Modbus TCP, with rights where the host gives them. In
turns there is

- nobody;
- a plain busy process, which asks nothing of anybody ("busy"): the yardstick, because
  a host lets two busy virtual processors wait for each other, whatever keeps them busy;
- 4 clients of Modbus that ask as fast as the processor lets them ("modbus");
- everybody ("all"): these (nice 19, behind the others), browsers that watch 200 tags ten times a
  second, one of which traces 8 tags in every cycle, and a client of OPC UA with 20 subscriptions of
  100 variables.

Services, clients and the busy process share one processor, which is not the scan's; with "busy",
"modbus" and "all" it has no idle time. The last leg is "all" for as long as the trace is to be, and
the first page is asked for in it.

It is one run of the project, so all legs are the same scan: the record of each of its cycles says
how late it began (the scan writes them for this program as for the page of the task classes). What
is seen while clients come and go is in no leg, but printed as "joining". A host that is shared
takes its processors away, with clients and without. So legs are compared within their round; missed
grid points are counted as stalls: all points of a stall have one cause, and each is a violation
here (the tolerance is 1 us), by the host, or by programs and controller ("own"; a hypervisor that
takes time without a word makes some of these too). Two counts of stalls differ by chance up to
about twice the root of their sum.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
import time
import urllib.request
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from _browsers import TRACED
from _children import end_at_sigterm
from _cycle_watch import Cycles
from _modbus_site import build
from _outcome import (
    Target,
    console,
    figures_table,
    number_above_0,
    print_machine,
    print_targets,
    write_json,
)
from _stalls import by_chance
from _web_site import HERE, Clients, Site

KINDS: Final = ("nobody", "busy", "modbus", "all")


@dataclass
class Leg:
    """A part of the run.

    Attributes:
        kind: one of `KINDS`.
        seconds: how long.
        cycles: of the scan.
        found: what clients saw.
    """

    kind: str
    seconds: float
    cycles: Cycles
    found: dict[str, Any]

    def to_json(self) -> dict[str, Any]:
        """Return its figures."""
        return {"kind": self.kind, "seconds": self.seconds, **figures(self.cycles), **self.found}


def figures(cycles: Cycles) -> dict[str, float]:
    """Return what is told of a part of a run."""
    return {
        "cycles": len(cycles.late_ns),
        "p50_us": cycles.late_us(50),
        "p99_us": cycles.late_us(99),
        "second_us": cycles.second_us,
        "missed": cycles.missed,
        "stalls": cycles.stalls,
        "own": cycles.own,
        "stolen_ms": cycles.stolen * 10,
        "controller_us": cycles.controller_us,
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


def measure(options: argparse.Namespace) -> tuple[list[Leg], str, Cycles]:
    """Run all legs; each is printed when it has ended."""
    clients = {
        "nobody": Clients(),
        "busy": Clients(busy=True),
        "modbus": Clients(modbus=True),
        "all": Clients(modbus=True, browsers=options.browsers),
    }
    legs: list[Leg] = []
    with tempfile.TemporaryDirectory(prefix="plcsim-web-") as place:
        client = build(Path(place), "modbus_client", "-pthread")
        if client is None:
            raise SystemExit("gcc is needed for the client of Modbus")
        with Site(Path(place), client) as site:
            for number in range(options.rounds):
                turn = number % len(KINDS)
                for kind in (*KINDS[turn:], *KINDS[:turn]):
                    found = site.leg(options.seconds, clients[kind])
                    legs.append(Leg(kind, options.seconds, *found))
                    show(legs[-1])
            found = site.leg(
                options.trace_seconds, clients["all"], lambda: first_page(site.ports["web"])
            )
            legs.append(Leg("all", options.trace_seconds, *found))
            show(legs[-1])
            rights = site.stop()["realtime_rights"]
    return legs, ", ".join(rights) or "no rights", site.joining


def show(leg: Leg) -> None:
    """Print one leg."""
    found, cycles = leg.found, leg.cycles
    more = ""
    if "requests_per_s" in found:
        more += f"  {found['requests_per_s']:,.0f} requests/s of Modbus"
    if "samples" in found:
        more += (
            f", {found['updates_per_s']:.1f} updates/s of a browser, {found['samples']} samples "
            f"({found['missing']} missing, {found['lost']} lost), "
            f"{found['changes_per_s']:,.0f} changes/s by OPC UA"
        )
    lost = f", {cycles.lost} records lost" if cycles.lost else ""
    console.print(
        f"{leg.kind:6}  {leg.seconds:.0f} s  p50 {cycles.late_us(50):.1f}  "
        f"p99 {cycles.late_us(99):.1f} us  {cycles.missed} missed, {cycles.stalls} stalls, "
        f"{cycles.own} own{lost}{more}",
        soft_wrap=True,
    )


def compare(legs: list[Leg], joining: Cycles) -> dict[str, Cycles]:
    """Print each kind with all its legs but the last; return these."""
    pooled = {kind: Cycles() for kind in KINDS}
    for leg in legs[:-1]:
        pooled[leg.kind].add(leg.cycles)
    table = figures_table(
        "beside", "cycles", "p50 us", "p99 us", "p99 of 1 s", "missed", "stalls", "own",
        "stolen ms", "LATCH+PUBLISH us",
    )  # fmt: skip
    for kind, cycles in (*pooled.items(), ("joining", joining)):
        numbers = figures(cycles)
        table.add_row(kind, *(f"{n:.1f}" if "_us" in k else f"{n}" for k, n in numbers.items()))
    console.print()
    console.print(table)
    return pooled


def differences_us(legs: list[Leg], kind: str) -> list[float]:
    """Return for each round how much later everybody is than a kind, at p99; print it."""
    late = {k: [leg.cycles.late_us(99) for leg in legs[:-1] if leg.kind == k] for k in KINDS}
    pairs = list(zip(late["all"], late[kind], strict=True))
    console.print(
        f"p99 beside all and beside {kind}: "
        + ", ".join(f"{a:.0f} - {b:.0f} = {a - b:+.0f} us (x {a / b:.2f})" for a, b in pairs),
        soft_wrap=True,
    )
    return [a - b for a, b in pairs]


def targets_of(legs: list[Leg], joining: Cycles) -> list[Target]:
    """Print the comparison, and return what it is to reach."""
    pooled = compare(legs, joining)
    late = {kind: statistics.median(differences_us(legs, kind)) for kind in KINDS[:-1]}
    last = legs[-1]
    added = {}
    for key in ("stalls", "own"):
        a, b = (getattr(pooled[kind], key) for kind in ("all", "nobody"))
        added[key] = a - b, by_chance(a, b)
    everybody = [leg.found for leg in legs if leg.kind == "all"]
    torn = sum(leg.found.get("torn", 0) for leg in legs)
    return [
        *(
            Target(f"p99 of wake lateness, all beside {kind} (median of rounds)", us, 20, "us more")
            for kind, us in late.items()
        ),
        *(
            Target(f"stalls {name} that all clients add", *added[key], "(by chance)")
            for key, name in (("stalls", "by the host"), ("own", "of its own"))
        ),
        Target("torn blocks of Modbus", torn, 0, ""),
        Target("samples missing in any trace", max(f["missing"] for f in everybody), 0, ""),
        Target(
            f"samples of the trace of {TRACED} tags in {last.seconds:.0f} s",
            last.found["samples"],
            980 * (last.seconds - 1),
            "",
            at_least=True,
        ),
        Target("first page beside all clients", last.found["page_s"], 1, "s"),
        Target("page weight", last.found["page_bytes"], 500_000, "bytes"),
    ]


def main() -> int:
    """Measure and print; return 1 where a target is not met."""
    parser = argparse.ArgumentParser(description="Browsers, a trace, OPC UA beside a 1 ms scan.")
    parser.add_argument("--seconds", type=number_above_0, default=10, help="of each leg")
    parser.add_argument("--rounds", type=number_above_0, default=3, help="of four legs")
    parser.add_argument("--browsers", type=number_above_0, default=10)
    parser.add_argument("--trace-seconds", type=number_above_0, default=60)
    parser.add_argument("--json", type=Path, default=None, metavar="FILE")
    options = parser.parse_args()
    end_at_sigterm()
    hosts = [print_machine("before")]
    legs, rights, joining = measure(options)
    console.print(f"rights: {rights}", soft_wrap=True)
    targets = targets_of(legs, joining)
    hosts.append(print_machine("after"))
    print_targets(targets)
    write_json(options.json, hosts, targets, legs=[leg.to_json() for leg in legs])
    return 0 if all(target.met for target in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
