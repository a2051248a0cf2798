"""The longest steps of a node that are its own: the same steps again, and the least of all rounds.

    python benchmarks/node_rounds.py [--rounds 7] [--ticks 2200] [--only TEXT ...] [--json FILE]

A host of virtual machines takes time from a step without a word, and the thread's CPU clock runs on
meanwhile: an empty step of 900 us is not the node's. A host can only add. So the same steps are
done in several rounds, and what a step takes in the round in which it takes least is the most that
can be the node's own.

Each round is a process of its own, from the first step of a node on: master and peers are another
process, which does what is due before a step and says so; then the step is done, with a time that
is counted, not read. So a step finds in its sockets what it found in the other rounds, byte by
byte. All else is as in a scan: rights, memory, and Python's collector, which runs between steps. A
step of a round is compared with those alone that had as much to do: that left as much of each part
of their budget, and for which about as many pages were laid out. What came a little earlier or
later than in the other rounds has its like there a few steps before or behind. One that has no like
counts as it is.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import time
from collections import defaultdict
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

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
from _ros_peer import TIME_BYTES, make_node
from node_step import CASES, NS_PER_MS, Case, Program, ordinary

from plcsim.host import garbage, realtime

if TYPE_CHECKING:
    from collections.abc import Iterator

    from crosnode.transport.budget import StepBudget

HERE = Path(__file__).parent
BEFORE = 100
"""Cycles in which the peer is there before the node."""

FAULTS = 16
"""Pages laid out within a step that may differ where steps are the same."""

LATER_NS = 3_600_000_000_000
"""By which the counted time is ahead of the clock, which a peer has read at its start."""

NEAR = 5
"""Steps by which a round may be ahead of the others."""

SHOWN = 8
"""Numbers of steps over their budget in a row of the table."""

IDLE_NS = 700_000
"""Of a millisecond of cycle, in which Python's garbage may be collected."""


class Step(NamedTuple):
    """A step of one round.

    Attributes:
        ns: own CPU time.
        left: of each part of its budget.
        faults: pages laid out.
    """

    ns: int
    left: tuple[int, ...]
    faults: int

    @property
    def like(self) -> tuple[object, ...]:
        """What steps of different rounds have in common where they are the same."""
        return (*self.left, self.faults // FAULTS)


class Place(NamedTuple):
    """A step of all rounds.

    Attributes:
        number: of the step, 0 is the node's first.
        least_ns: of the rounds that were the same; of several such, the one that takes longest.
        most_ns: of all rounds.
        likes: kinds of rounds.
    """

    number: int
    least_ns: int
    most_ns: int
    likes: int


class Figures(NamedTuple):
    """What a case came to.

    Attributes:
        places: of all steps, by the least of their rounds.
        over: numbers of the steps that are above budget and a fifth by themselves.
        by_host: steps of single rounds that are so, though the same step is not in another.
    """

    places: list[Place]
    over: list[int]
    by_host: int


def do_round(case: Case, ticks: int) -> Iterator[Step]:
    """Do the steps of a round in this process, with a peer beside it."""
    port = free_port()
    command = [sys.executable, str(HERE / "_ros_peer.py"), "in-step", str(port), *case.peer.split()]
    peer = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                            preexec_fn=ordinary)  # noqa: PLW1509  # no threads here  # fmt: skip
    assert peer.stdin
    assert peer.stdout
    try:
        rights = realtime.acquire(50, None)
        tick_ns = case.tick_ms * NS_PER_MS
        now_ns = time.monotonic_ns() + LATER_NS  # behind all that the peer has read itself
        for cycle in range(-BEFORE, ticks):
            now_ns += tick_ns
            for part in range(case.tick_ms):  # a peer has steps of a millisecond
                peer.stdin.write(
                    (now_ns - tick_ns + part * NS_PER_MS).to_bytes(TIME_BYTES, "little")
                )
                peer.stdin.flush()
                assert peer.stdout.read(1)
            if cycle < 0:
                continue
            if cycle == 0:
                context, node = make_node("plc", port, now_ns)
                program = Program(case, node)
                realtime.settle(rights)  # as the scan does
            context.release_ns = now_ns
            faults = page_faults()
            begin_ns = time.thread_time_ns()
            node.do_events_loop()
            ns = time.thread_time_ns() - begin_ns
            yield Step(ns, left_of(node.core.budget), page_faults() - faults)
            program.cycle(cycle)
            garbage.collect_while_idle(case.tick_ms * IDLE_NS)  # as the scan does
    finally:
        peer.kill()
        peer.wait()
    if program.lost:
        raise SystemExit(f"{case.name}: {program.lost} messages lost")


def left_of(budget: StepBudget) -> tuple[int, ...]:
    """Return what a step has left of what it may do."""
    return (budget.work, budget.bytes_in, budget.bytes_out, budget.bytes_parsed, budget.messages,
            budget.polls)  # fmt: skip


def page_faults() -> int:
    """Return the pages laid out for this thread so far."""
    return resource.getrusage(resource.RUSAGE_THREAD).ru_minflt


def places_of(rounds: list[list[Step]]) -> list[Place]:
    """Return what each step came to in all rounds, which have as many steps."""
    return [place_of(number, rounds) for number in range(len(rounds[0]))]


def place_of(number: int, rounds: list[list[Step]]) -> Place:
    """Return what a step came to."""
    likes = defaultdict(list)
    for steps in rounds:
        likes[steps[number].like].append(steps[number].ns)
    least_ns = max(
        min(times if len(times) > 1 else times + near_by(number, like, rounds))
        for like, times in likes.items()
    )
    return Place(number, least_ns, max(steps[number].ns for steps in rounds), len(likes))


def near_by(number: int, like: tuple[object, ...], rounds: list[list[Step]]) -> list[int]:
    """Return the times of the steps like one of a single round, in the others and near by."""
    near = slice(max(0, number - NEAR), number + NEAR + 1)
    others = (steps for steps in rounds if steps[number].like != like)
    return [step.ns for steps in others for step in steps[near] if step.like == like]


def run_rounds(case: Case, rounds: int, ticks: int) -> list[list[Step]]:
    """Run the rounds of a case, each in a process."""
    found = []
    for _ in range(rounds):
        command = [sys.executable, __file__, "--round", case.name, "--ticks", str(ticks)]
        told = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout
        found.append([Step(ns, tuple(left), faults) for ns, left, faults in json.loads(told)])
    return found


def figures_of(case: Case, rounds: list[list[Step]]) -> Figures:
    """Return what the rounds of a case came to."""
    places = sorted(places_of(rounds), key=lambda place: place.least_ns)
    over = sorted(place.number for place in places if place.least_ns > case.limit_ns)
    added = sum(step.ns > case.limit_ns for steps in rounds for step in steps)
    return Figures(places, over, added - len(over) * len(rounds))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=number_above_0, default=7)
    parser.add_argument("--ticks", type=number_above_0, default=2200)
    parser.add_argument(
        "--only", nargs="+", default=[""], help="cases with one of these in their name"
    )
    parser.add_argument("--json", type=Path)
    parser.add_argument("--round", metavar="CASE", help="do one round here, and print its steps")
    options = parser.parse_args()
    if options.round:
        (case,) = [case for case in CASES if case.name == options.round]
        print(json.dumps(list(do_round(case, options.ticks))))
        return 0
    hosts = [print_machine("before")]
    cases = [case for case in CASES if any(text in case.name for text in options.only)]
    found = {}
    for case in cases:
        found[case.name] = figures_of(case, run_rounds(case, options.rounds, options.ticks))
    hosts.append(print_machine("after"))
    made = [
        Target(
            f"{case.name}: own steps over {case.limit_ns / 1e3:,.0f} us", len(f.over), 0, "steps"
        )
        for case, f in zip(cases, found.values(), strict=True)
    ]
    print_figures(found)
    print_targets(made)
    rows = {name: [place._asdict() for place in f.places] for name, f in found.items()}
    write_json(options.json, hosts, made, steps=rows)
    return 0 if all(target.met for target in made) else 1


def print_figures(found: dict[str, Figures]) -> None:
    """Print a row for each case: the least of the rounds, and what the host adds."""
    table = figures_table(
        "load (least CPU time of a step)", "steps", "unlike", "p50 us", "p99", "longest", "number",
        "most", "own over", "by host", "which",
    )  # fmt: skip
    for name, f in found.items():
        places, longest = f.places, f.places[-1]
        shares = [places[int(share * len(places))] for share in (0.5, 0.99)]
        table.add_row(
            name, str(len(places)), str(sum(place.likes > 1 for place in places)),
            *(f"{each.least_ns / 1e3:.0f}" for each in (*shares, longest)),
            str(longest.number), f"{longest.most_ns / 1e3:.0f}", str(len(f.over)), str(f.by_host),
            " ".join(map(str, f.over[:SHOWN])),
        )  # fmt: skip
    console.print(table)


if __name__ == "__main__":
    sys.exit(main())
