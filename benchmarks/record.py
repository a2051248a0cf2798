"""What recording costs the scan, what the recorder needs, and how quick a replay is.

    python benchmarks/record.py [--seconds 2] [--rounds 8] [--long 0]
        [--disordered 0] [--json FILE]

(a) A project with 50 tags that change in every cycle and 10 topics that are published in every
cycle, at 1 ms on the real clock, in short legs by turns: "without" a recorder, "with" one, and
"busy", without one and with a plain busy process in its place. The rounds begin with another one
each time. Told of each leg: CPU time of the scan in a cycle (the median of its cycles), and of a
fixed loop of 200 additions that the program goes through in each cycle, which tells how quick the
processor is just then. On a host that is shared that changes from one second to the next by more
than recording costs. So the cost is measured within a run: three runs have all that records taken
away and put back every 20 cycles, and the medians of neighbouring blocks are compared.
Grid points are missed in stalls, each with one cause (`_stalls.figures_of`): "own" where the scan
was on the processor for longer than its cycle time, the host's otherwise. What the host did stands
beside: the time that the scan waited for a processor though it could run (/proc/thread-self/
schedstat), and the time that the hypervisor stole from all processors (/proc/stat). Recording adds
stalls of its own where there are more with it than with the busy process, beyond chance.
(b) With ``--long
SECONDS`` one run of 10,000 messages of topics a second, and 50,000 of tags: memory of both
processes from its start to its end, CPU time of the recorder, records lost. (c) A bag of 10 topics
of 100 messages a second is played to a program on the virtual clock: how many times as fast as real
time, by the wall clock and by CPU time.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from _hogs import hogs
from _outcome import (
    Target,
    console,
    figures_table,
    number_above_0,
    print_machine,
    print_targets,
    write_json,
)
from _stalls import by_chance, figures_of, stolen_ticks

from crosnode.plc.project import create_node
from crosnode.testing import Ros
from plcsim import Program
from plcsim.recorder.bag.files import create
from plcsim.testing import Plc
from plcsim.testing.target import program_target
from st_types import UDINT, var

if TYPE_CHECKING:
    from collections.abc import Callable

KINDS = ("without", "with", "busy")
TAGS = 50
TOPICS = 10
PARTS = (0.1, 0.5, 1.0)
"""Of the time of (b): when the memory is looked at."""

LOOP = 200
"""Additions of the loop that tells how quick the processor is."""

BLOCK = 20
"""Cycles with a recorder, then as many without, in the run in which it is switched."""

WARMING_UP = 500
"""Cycles that do not count."""

PROGRAM = f'''"""Fifty tags that change, ten of them published."""

import gc
import json
import statistics
import time
from collections import deque

from plcsim import Program
from st_types import ARRAY, LREAL, UDINT, var


def waited_ns():
    with open("/proc/thread-self/schedstat") as file:
        return int(file.read().split()[1])


class Busy(Program):
    __slots__ = ("loops", "spent", "stamp_ns", "switch", "waited_ns")
    count = var(UDINT)
    values = var(ARRAY(LREAL, (0, {TAGS - 2})))
    out = var(ARRAY(LREAL, (0, {TOPICS - 1})))

    def init(self):
        self.spent = deque(maxlen=20_000)  # or a long run would grow by its own figures
        self.loops = deque(maxlen=20_000)
        self.stamp_ns = 0
        self.waited_ns = waited_ns()
        self.switch = Switch() if SWITCHED else None

    def cyclic(self):
        stamp_ns = time.thread_time_ns()
        if self.count > {WARMING_UP}:
            self.spent.append(stamp_ns - self.stamp_ns)
            if self.switch:
                self.switch.took(stamp_ns - self.stamp_ns)
                stamp_ns = time.thread_time_ns()
        self.stamp_ns = stamp_ns
        start_ns = time.perf_counter_ns()
        total = 0
        for number in range({LOOP}):
            total += number
        self.loops.append(time.perf_counter_ns() - start_ns)
        self.count += 1
        now = float(self.count)
        self.values = [now + n for n in range({TAGS - 1})]
        self.out = [now + n for n in range({TOPICS})]

    def exit(self):
        print(json.dumps({{
            "cpu_us": statistics.median(self.spent) / 1000,
            "loop_us": statistics.median(self.loops) / 1000,
            "switched_us": self.switch.cost_us() if self.switch else 0,
            "waited_ms": (waited_ns() - self.waited_ns) / 1e6,
        }}))
'''


SWITCH = '''

class Switch:
    """Takes away all that records, and puts it back: blocks of cycles by turns."""

    def __init__(self):
        names = {"ProcessImage", "Traffic", "RecordedClock", "RecordedNetwork"}
        kept = {type(o).__name__: o for o in gc.get_objects() if type(o).__name__ in names}
        image, traffic = kept["ProcessImage"], kept["Traffic"]
        self.clock, self.net = kept["RecordedClock"], kept["RecordedNetwork"]
        lists = image.watchers, image.inputs, traffic.followers
        self.lists = [(each, list(each)) for each in lists]
        self.answers = dict(vars(self.clock))
        self.look = self.net.recorded.look
        self.on, self.left, self.block, self.blocks = True, 0, [], ([], [])

    def plain_look(self):
        return [self.net._made[each] for each in self.look() if each in self.net._made]

    def turn(self):
        self.on = not self.on
        for each, whole in self.lists:
            each[:] = whole if self.on else [entry for entry in whole if not records(entry)]
        for name in ("now_ns", "cpu_ns", "waits", "unix_ns"):
            plain = getattr(self.clock.recorded, name)
            setattr(self.clock, name, self.answers[name] if self.on else plain)
        self.net.look = type(self.net).look.__get__(self.net) if self.on else self.plain_look

    def took(self, spent):
        self.left -= 1
        self.block.append(spent)
        if self.left <= 0:
            self.blocks[self.on].append(statistics.median(self.block[3:] or [0]))
            self.block, self.left = [], BLOCK
            self.turn()

    def cost_us(self):
        off, on = (each[len(each) // 10 :] for each in self.blocks)
        return statistics.median(b - a for a, b in zip(off, on)) / 1000


def records(entry):
    """Whether an entry of a list is the recorder's: a method of its tape or of a list it fills."""
    owner = entry.__self__ if hasattr(entry, "__self__") else entry
    return type(owner).__name__ == "Tape" or type(owner) is list
'''
"""Joins the program where recording is switched off and on within a run."""


def make(folder: Path, cycle: str, *, switched: bool = False) -> None:
    """Write the project."""
    (folder / "busy").mkdir(parents=True)
    program = PROGRAM.replace("SWITCHED", str(switched)) + SWITCH.replace("BLOCK", str(BLOCK))
    (folder / "busy" / "main.py").write_text(program)
    published = "\n".join(
        f'"/busy/out_{n}" = {{ tag = "busy.out[{n}]", type = "std_msgs/Float64", '
        f'every = "{cycle}" }}'
        for n in range(TOPICS)
    )
    (folder / "plc.toml").write_text(
        f'[task_class.1]\ncycle = "{cycle}"\ntolerance = "1us"\nprograms = ["busy"]\n'
        f'on_violation = "log"\n[record]\ntags = ["busy"]\n'
        f'[ros]\nmaster = "embedded"\nmaster_port = 11499\n[ros.publish]\n{published}\n'
    )


def plcsim(*words: object) -> list[str]:
    return [sys.executable, "-m", "plcsim", *map(str, words)]


def run(folder: Path, seconds: float, kind: str) -> dict[str, Any]:
    """Run the project; return its figures."""
    project, bag = folder.parent / kind, folder.parent / "run.bag"
    is_recorded = kind in ("with", "switched")
    if not project.exists():
        make(project, "1ms", switched=kind == "switched")
        toml = project / "plc.toml"
        if not is_recorded:
            toml.write_text(toml.read_text().replace('[record]\ntags = ["busy"]\n', ""))
    words: list[object] = ["--record", bag] if is_recorded else []
    report = folder.parent / "report.json"
    words = ["run", project, "--for", f"{seconds}s", "--quiet", "--report", report, *words]
    stolen = stolen_by_all()
    with hogs(1, wanted=kind == "busy"):
        done = subprocess.run(plcsim(*words), stdout=subprocess.PIPE, text=True, check=True)
    figures: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    figures["stolen_ms"] = (stolen_by_all() - stolen) * 1000 / os.sysconf("SC_CLK_TCK")
    figures |= figures_of(report) | {"lost": 0}
    if is_recorded:
        told = subprocess.run(
            plcsim("bag", "info", bag), stdout=subprocess.PIPE, text=True, check=True
        )
        found = re.search(r"steps, (\S+) lost", told.stdout)
        figures["lost"] = 0 if found and found[1] == "none" else int(found[1] if found else -1)
        figures["bytes"] = bag.stat().st_size
        bag.unlink()
    return figures


def stolen_by_all() -> int:
    """Return the ticks stolen from the processors that we may use."""
    return sum(map(stolen_ticks, os.sched_getaffinity(0)))


def costs(folder: Path, seconds: float, rounds: int) -> dict[str, Any]:
    """Return the figures of (a), and print each leg."""
    runs: dict[str, list[dict[str, Any]]] = {kind: [] for kind in KINDS}
    print("(a)      CPU time of a cycle   loop  missed (stalls; own)  waited, stolen ms  lost")
    for number in range(rounds):
        turn = number % len(KINDS)
        for kind in KINDS[turn:] + KINDS[:turn]:
            found = run(folder, seconds, kind)
            runs[kind].append(found)
            print(
                f"{kind:<8} {found['cpu_us']:16.1f} us {found['loop_us']:6.1f}  "
                f"{found['missed']:6} ({found['stalls']:6}; {found['own']:3})  "
                f"{found['waited_ms']:8.1f} {found['stolen_ms']:8.0f}  {found['lost']:4}",
                flush=True,
            )
    switched = [run(folder, 3 * seconds, "switched") for _ in range(3)]
    loop_us = statistics.median(each["loop_us"] for kind in KINDS for each in runs[kind])
    return {
        "runs": runs,
        "loop_us": loop_us,
        "cost_us": statistics.median(leg["switched_us"] for leg in switched),
        "switched": switched,
        "plain_us": more(runs, lambda leg: leg["cpu_us"]),
    }


def more(runs: dict[str, list[dict[str, Any]]], of: Callable[[dict[str, Any]], float]) -> float:
    """Return how much more something is with a recorder: the median of the rounds."""
    pairs = zip(runs["without"], runs["with"], strict=True)
    return statistics.median(of(with_) - of(without) for without, with_ in pairs)


def print_costs(found: dict[str, Any]) -> list[Target]:
    """Print the medians of (a), and return what it is to reach."""
    runs = found["runs"]
    table = figures_table("medians", "us a cycle", "loop us", "missed", "stalls", "own", "lost")
    for kind, legs in runs.items():
        keys = ("cpu_us", "loop_us", "missed", "stalls", "own", "lost")
        medians = [statistics.median(leg[key] for leg in legs) for key in keys]
        table.add_row(kind, *(f"{each:.1f}" for each in medians))
    console.print(table)
    counted = ("missed", "stalls", "own", "lost")
    sums = {
        kind: {key: sum(leg[key] for leg in legs) for key in counted} for kind, legs in runs.items()
    }
    for kind, row in sums.items():
        console.print(
            f"{kind}: {row['missed']} grid points missed in {row['stalls']} stalls by the host and "
            f"{row['own']} own, in {len(runs[kind])} legs",
            soft_wrap=True,
        )
    runs_of = [f"{leg['switched_us']:.1f} (loop {leg['loop_us']:.1f})" for leg in found["switched"]]
    loop_us = statistics.median(leg["loop_us"] for leg in found["switched"])
    console.print(
        f"recording switched off and on costs {', '.join(runs_of)} us of a cycle: the median is "
        f"{found['cost_us'] / loop_us:.2f} times the loop; between legs with and without "
        f"{found['plain_us']:.1f} us",
        soft_wrap=True,
    )
    console.print(f"real-time rights: {runs['with'][0]['rights']}", soft_wrap=True)
    with_, busy = sums["with"], sums["busy"]
    return [
        Target("cost of recording, of a cycle (median)", found["cost_us"], 25, "us"),
        *(
            Target(
                f"stalls {name} beyond those beside a busy process",
                with_[key] - busy[key],
                by_chance(with_[key], busy[key]),
                "(by chance)",
            )
            for key, name in (("own", "of its own"), ("stalls", "by the host"))
        ),
        Target("records lost", with_["lost"], 0, ""),
    ]


def resident_mib(pid: int) -> float:
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGESIZE") / (1 << 20)


def children(pid: int) -> dict[str, int]:
    """Return the scan and the recorder below a supervisor."""
    found = {}
    for each in Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
        command = Path(f"/proc/{each}/cmdline").read_text()
        for name, text in (("scan", "scan_process"), ("recorder", "plcsim.recorder")):
            if text in command:
                found[name] = int(each)
    return found


def cpu_s(pid: int) -> float:
    """Return the CPU time that a process has used."""
    words = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def look_at(supervisor: int, bag: Path) -> dict[str, float]:
    """Return MiB of both processes and of the bag, and CPU seconds of the recorder."""
    found: dict[str, float] = {"s": time.monotonic()}
    processes = children(supervisor)
    found |= {name: resident_mib(pid) for name, pid in processes.items()}
    found["cpu_s"] = cpu_s(processes["recorder"]) if "recorder" in processes else 0.0
    found["bag"] = sum(f.stat().st_size for f in bag.parent.glob("long*")) / (1 << 20)
    return found


def memory(folder: Path, seconds: float) -> dict[str, Any]:
    """Return what `look_at` saw of a long run at its start and at `PARTS`, and what it recorded."""
    bag = folder.parent / "long.bag"
    words = ["run", folder, "--for", f"{seconds + 10}s", "--quiet", "--record", bag]
    process = subprocess.Popen(plcsim(*words), stdout=subprocess.DEVNULL)
    while "recorder" not in children(process.pid) and process.poll() is None:
        time.sleep(0.1)  # a process below another one: /proc is all that tells
    time.sleep(5)  # what starts up is no part of what grows
    start_s = time.monotonic()
    looks = [look_at(process.pid, bag)]
    for part in PARTS:
        time.sleep(max(0.0, start_s + part * seconds - time.monotonic()))  # the part itself
        looks.append(look_at(process.pid, bag))
    process.wait()
    told = subprocess.run(plcsim("bag", "info", bag), stdout=subprocess.PIPE, text=True, check=True)
    counts = [int(n) for n in re.findall(r"std_msgs/\w+ +(\d+)", told.stdout)]
    topics = re.findall(r"/busy/out_\d+ +std_msgs/Float64 +(\d+)", told.stdout)
    lost = re.search(r"steps, (\S+) lost", told.stdout)
    for file in bag.parent.glob("long*"):
        file.unlink()
    first, last = looks[0], looks[-1]
    return {
        "looks": looks,
        "messages": sum(map(int, topics)),
        "all_messages": sum(counts),
        "processors": (last["cpu_s"] - first["cpu_s"]) / (last["s"] - first["s"]),
        "lost": lost[1] if lost else "?",
    }


class Hears(Program):
    """Subscribes to ten topics."""

    __slots__ = ("node", "topics")
    heard = var(UDINT)

    def init(self) -> None:
        """Make the node."""
        self.node = create_node(self.context, "hears")
        self.topics = [
            self.node.register_subscriber(f"/out_{n}", "std_msgs/Float64") for n in range(TOPICS)
        ]

    def cyclic(self) -> None:
        """Count what has come."""
        self.node.do_events_loop()
        for topic in self.topics:
            while topic.pop() is not None:
                self.heard += 1

    def exit(self) -> None:
        """Take the registrations back."""
        self.node.destroy()


def replay(folder: Path, seconds: int) -> dict[str, float]:
    """Play ten topics of 100 messages a second to a program at 10 ms; return how long it took."""
    path = folder.parent / "topics.bag"
    bag = create(path)
    topics = [bag.add(f"/out_{n}", "std_msgs/msg/Float64") for n in range(TOPICS)]
    for number in range(100 * seconds):
        for topic in topics:
            bag.write(10**9 + number * 10_000_000, [(topic, struct.pack("<d", number))])
    bag.close()
    plc = Plc(program_target([Hears]))
    ros = Ros(plc)
    plc.boot()
    start_s, start_cpu_s = time.perf_counter(), time.process_time()
    sent = ros.replay(path)
    plc.run("100ms")
    took_s, cpu_s = time.perf_counter() - start_s, time.process_time() - start_cpu_s
    heard = plc["Hears.heard"]
    plc.close()
    if heard != sent:
        raise RuntimeError(f"{sent} messages were played and {heard} heard")
    return {"messages": sent, "times": seconds / took_s, "times_of_cpu": seconds / cpu_s}


READS = """
import json, resource, sys, time
from pathlib import Path
from plcsim.recorder.bag.reading import open_bag

before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
start_s, latest_ns, count = time.monotonic(), 0, 0
with open_bag(Path(sys.argv[1])) as bag:
    for message in bag.messages():
        if message.time_ns < latest_ns:
            sys.exit("messages are read out of order")
        latest_ns = message.time_ns
        count += 1
most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print(json.dumps({"read": count, "mib": (most - before) / 1024, "s": time.monotonic() - start_s}))
"""


def disorder(folder: Path, count: int) -> dict[str, float]:
    """Write messages of 200 bytes in any order into a bag; return what reading it in order took."""
    path = folder.parent / "disordered.bag"
    bag = create(path)
    topics = [bag.add(f"/topic_{n}", "std_msgs/msg/String") for n in range(TOPICS)]
    data = struct.pack("<I196s", 196, b"x" * 196)
    times = list(range(1, count + 1))
    random.Random(1).shuffle(times)
    for time_ns in times:
        bag.write(time_ns, [(topics[time_ns % TOPICS], data)])
    bag.close()
    done = subprocess.run(
        [sys.executable, "-c", READS, path], stdout=subprocess.PIPE, text=True, check=True
    )
    path.unlink()
    found: dict[str, float] = json.loads(done.stdout)
    return found


def main() -> int:
    """Measure and print; return 1 where a target is not met."""
    parser = argparse.ArgumentParser(description="What recording costs, how quick a replay is.")
    parser.add_argument("--seconds", type=float, default=2, help="of each leg of (a)")
    parser.add_argument("--rounds", type=number_above_0, default=8)
    parser.add_argument("--long", type=float, default=0, metavar="SECONDS", help="of (b)")
    parser.add_argument("--disordered", type=int, default=0, metavar="MESSAGES", help="of (d)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep all figures")
    options = parser.parse_args()
    found: dict[str, Any] = {}
    hosts = [print_machine("before")]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "busy"
        make(folder, "1ms")  # of (b)
        found["costs"] = costs(folder, options.seconds, options.rounds)
        targets = print_costs(found["costs"])
        if options.long:
            found["memory"] = memory(folder, options.long)
            print("(b) MiB:        scan recorder      bag")
            for each in found["memory"]["looks"]:
                seconds = each["s"] - found["memory"]["looks"][0]["s"]
                sizes = [each.get(name, 0) for name in ("scan", "recorder", "bag")]
                print(f"{seconds:7.0f} s {sizes[0]:8.1f} {sizes[1]:8.1f} {sizes[2]:8.1f}")
            ran_s = options.long + 10
            per_s = [found["memory"][name] / ran_s for name in ("messages", "all_messages")]
            print(f"{per_s[0]:.0f} messages of topics a second, with tags {per_s[1]:.0f}; ", end="")
            print(f"records lost: {found['memory']['lost']}")
            print(f"the recorder used {found['memory']['processors']:.2f} of a processor")
        found["replay"] = replay(folder, 60)
        times = found["replay"]
        print(
            f"(c) {times['messages']} messages played {times['times']:.0f} times as fast as real "
            f"time ({times['times_of_cpu']:.0f} times by CPU time)"
        )
        if options.disordered:
            told = found["disordered"] = disorder(folder, options.disordered)
            print(
                f"(d) {told['read']} messages out of order read in order in {told['s']:.1f} s "
                f"with {told['mib']:.0f} MiB more memory"
            )
    targets.append(Target("replay, times real time", times["times"], 30, "times", at_least=True))
    hosts.append(print_machine("after"))
    print_targets(targets)
    write_json(options.json, hosts, targets, **found)
    return 0 if all(target.met for target in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
