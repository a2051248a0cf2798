"""What recording costs the scan, what the recorder needs, and how quick a replay is.

    python benchmarks/record.py [--seconds 4] [--rounds 7] [--long 0] [--json FILE]

(a) A project with 50 tags that change in every cycle and 10 topics that are published in every
cycle, at 1 ms on the real clock, with and without a recorder beside it; the rounds begin with
another one each time. Of each run: CPU time of the scan in a cycle (the median of its cycles), grid
points missed, records lost. The cost is the difference within a round; the median of the rounds is
told, so that what else the machine does counts little. So are the grid points that runs with a
recorder missed beyond those without, and the real-time rights. (b) With ``--long
SECONDS`` one run of 10,000 messages of topics a second, and 50,000 of tags: memory of both
processes from its start to its end, CPU time of the recorder, records lost. (c) A bag of 10 topics
of 100 messages a second is played to a program on the virtual clock: how many times as fast as real
time, by the wall clock and by CPU time.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from crosnode.plc.project import create_node
from crosnode.testing import Ros
from plcsim import Program
from plcsim.recorder.bag.files import create
from plcsim.testing import Plc
from plcsim.testing.target import program_target
from st_types import UDINT, var

TAGS = 50
TOPICS = 10
PARTS = (0.1, 0.5, 1.0)
"""Of the time of (b): when the memory is looked at."""

WARMING_UP = 500
"""Cycles that do not count."""

PROGRAM = f'''"""Fifty tags that change, ten of them published."""

import json
import time
from collections import deque

from plcsim import Program
from st_types import ARRAY, LREAL, UDINT, var


class Busy(Program):
    __slots__ = ("spent", "stamp_ns")
    count = var(UDINT)
    values = var(ARRAY(LREAL, (0, {TAGS - 2})))
    out = var(ARRAY(LREAL, (0, {TOPICS - 1})))

    def init(self):
        self.spent = deque(maxlen=20_000)  # or a long run would grow by its own figures
        self.stamp_ns = 0

    def cyclic(self):
        stamp_ns = time.thread_time_ns()
        if self.count > {WARMING_UP}:
            self.spent.append(stamp_ns - self.stamp_ns)
        self.stamp_ns = stamp_ns
        self.count += 1
        now = float(self.count)
        self.values = [now + n for n in range({TAGS - 1})]
        self.out = [now + n for n in range({TOPICS})]

    def exit(self):
        spent = sorted(self.spent)
        print(json.dumps({{"cpu_us": spent[len(spent) // 2] / 1000}}))
'''


def make(folder: Path, cycle: str) -> None:
    """Write the project."""
    (folder / "busy").mkdir(parents=True)
    (folder / "busy" / "main.py").write_text(PROGRAM)
    published = "\n".join(
        f'"/busy/out_{n}" = {{ tag = "busy.out[{n}]", type = "std_msgs/Float64", '
        f'every = "{cycle}" }}'
        for n in range(TOPICS)
    )
    (folder / "plc.toml").write_text(
        f'[task_class.1]\ncycle = "{cycle}"\ntolerance = "100ms"\nprograms = ["busy"]\n'
        f'on_violation = "log"\n[record]\ntags = ["busy"]\n'
        f'[ros]\nmaster = "embedded"\nmaster_port = 11499\n[ros.publish]\n{published}\n'
    )


def plcsim(*words: object) -> list[str]:
    return [sys.executable, "-m", "plcsim", *map(str, words)]


def run(folder: Path, seconds: float, bag: Path | None) -> dict[str, Any]:
    """Run the project; return its figures."""
    plain = folder.parent / "plain"
    if not plain.exists():
        make(plain, "1ms")
        toml = plain / "plc.toml"
        toml.write_text(toml.read_text().replace('[record]\ntags = ["busy"]\n', ""))
    report = folder.parent / "report.json"
    words = ["run", folder if bag else plain, "--for", f"{seconds}s", "--quiet", "--report", report]
    if bag is not None:
        words += ["--record", bag]
    done = subprocess.run(plcsim(*words), stdout=subprocess.PIPE, text=True, check=True)
    run_report = json.loads(report.read_text())
    (task_class,) = run_report["task_classes"]
    figures: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    figures["missed"] = task_class["missed_grid_points"]
    figures["rights"] = run_report["realtime_rights"]
    figures["lost"] = 0
    if bag is not None:
        told = subprocess.run(
            plcsim("bag", "info", bag), stdout=subprocess.PIPE, text=True, check=True
        )
        found = re.search(r"steps, (\S+) lost", told.stdout)
        figures["lost"] = 0 if found and found[1] == "none" else int(found[1] if found else -1)
        figures["bytes"] = bag.stat().st_size
        bag.unlink()
    return figures


def costs(folder: Path, seconds: float, rounds: int) -> dict[str, Any]:
    """Return the figures of (a)."""
    runs: dict[str, list[dict[str, Any]]] = {"without": [], "with": []}
    for number in range(rounds):
        order = ("without", "with") if number % 2 == 0 else ("with", "without")
        for name in order:
            bag = folder.parent / "run.bag" if name == "with" else None
            runs[name].append(run(folder, seconds, bag))
    pairs = zip(runs["without"], runs["with"], strict=True)
    differences = [(w["cpu_us"] - o["cpu_us"], w["missed"] - o["missed"]) for o, w in pairs]
    cost_us, extra_missed = map(statistics.median, zip(*differences, strict=True))
    return {"runs": runs, "cost_us": cost_us, "extra_missed": extra_missed}


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


def main() -> None:
    parser = argparse.ArgumentParser(description="What recording costs, how quick a replay is.")
    parser.add_argument("--seconds", type=float, default=4, help="of each run of (a)")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--long", type=float, default=0, metavar="SECONDS", help="of (b)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep all figures")
    options = parser.parse_args()
    found: dict[str, Any] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "busy"
        make(folder, "1ms")
        found["costs"] = costs(folder, options.seconds, options.rounds)
        print("(a)        CPU time of a cycle  missed  records lost")
        for kind, runs in found["costs"]["runs"].items():
            for each in runs:
                missed, lost = each["missed"], each["lost"]
                print(f"{kind:<10} {each['cpu_us']:16.1f} us {missed:7} {lost:13}")
        costly = found["costs"]
        rights = costly["runs"]["with"][0]["rights"]
        print(f"recording costs {costly['cost_us']:.1f} us of a cycle (median)")
        print(f"{costly['extra_missed']:g} grid points missed beyond those without (median)")
        print(f"real-time rights: {', '.join(rights) or 'none'}")
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
    if options.json is not None:
        options.json.write_text(json.dumps(found, indent=2) + "\n")


if __name__ == "__main__":
    main()
