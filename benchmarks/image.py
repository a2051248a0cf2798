"""What the shared image costs the scan, and that its streams lose nothing.

    python benchmarks/image.py [--seconds 10] [--json FILE]

(a) PUBLISH and LATCH of a controller on the virtual clock, in microseconds: of small and of large
projects, with 10,000 tags that lie apart, with commands. The quickest of many is told, because
every slower one was slowed by something else. (b) a 1 ms scan on the real clock with 8, 50 and 200
tags sampled in every cycle, read by another process: samples, those missing, and the CPU time that
LATCH and PUBLISH took in each cycle.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plcsim import Program
from plcsim.core.clock import MonotonicClock, VirtualClock
from plcsim.host import realtime
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.shared_image import (
    ImageReader,
    ImageWriter,
    SampleCommand,
    Scatter,
    StoreCommand,
    Write,
)
from plcsim.shared_image.layout import make_file
from plcsim.shared_image.samples import sample_of
from st_types import ARRAY, UDINT, var

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.clock import Clock
    from plcsim.core.controller import Controller

MS = 1_000_000
TAGS = 10_000


def quickest_us(act: Callable[[], object], times: int = 200) -> float:
    found = []
    for _ in range(times):
        start_ns = time.perf_counter_ns()
        act()
        found.append(time.perf_counter_ns() - start_ns)
    return min(found) / 1000


def make(words: int, clock: Clock, step: int = 0) -> tuple[Controller, ImageWriter, int]:
    """Return a controller with an ARRAY, of which every ``step``-th element is asked for."""

    class Field(Program):
        words_ = var(ARRAY(UDINT, (0, words - 1)))
        count = var(UDINT)

        def cyclic(self) -> None:
            self.count += 1

    setup = Setup(
        [TaskClassSetup(1, MS, [ProgramSetup("p", PythonCode(Field))], tolerance_ns=MS)],
        memory_size=64 << 20,
    )
    network: Any = None
    controller = make_controller(setup, network=network, clock=clock)
    fd = make_file()
    asked = range(0, words, step) if step else range(0)
    writer = ImageWriter(
        fd,
        controller,
        project="image",
        services={"s": None},
        streams={"s": 1 << 20},
        exports=[controller.tags.find(f"p.words_[{n}]") for n in asked],
    )
    controller.boot()
    return controller, writer, fd


def costs() -> dict[str, dict[str, float]]:
    """Return the quickest PUBLISH and LATCH of each case, in microseconds."""
    cases = {
        "400 bytes, all": (100, 0),
        "60 KiB, all": (15_000, 0),
        **{f"10,000 tags, one every {4 * s} bytes": (TAGS * s, s) for s in (17, 25, 100, 400)},
    }
    result = {}
    for name, (words, step) in cases.items():
        controller, writer, _ = make(words, VirtualClock(), step)
        (task_class,) = controller.classes
        controller.run(cycles=1)

        def publish(controller: Any = controller, writer: Any = writer) -> None:
            controller.context.release_ns += MS
            writer.publish(controller.classes[0])

        result[name] = {
            "publish_us": quickest_us(publish),
            "latch_us": quickest_us(lambda w=writer, c=task_class: w.latch(c)),
        }
    for name, count, operation in (
        ("16 writes of a word", 16, lambda at: StoreCommand(at, b"\1\0")),
        ("a write of 1,968 coils", 1, lambda at: Scatter(range(at, at + 1968), bytes(1968))),
    ):
        result[name] = _commands(count, operation)
    return result


def _commands(count: int, operation: Callable[[int], Any]) -> dict[str, float]:
    controller, writer, fd = make(1000, VirtualClock())
    controller.run(cycles=1)
    reader = ImageReader(fd, "s")
    at = controller.tags.find("p.words_").address
    (task_class,) = controller.classes
    latch, publish = [], []
    for _ in range(200):
        for _ in range(count):
            reader.send(Write((operation(at),)))
        latch.append(quickest_us(lambda: writer.latch(task_class), 1))
        publish.append(quickest_us(lambda: writer.publish(task_class), 1))
    return {"publish_us": min(publish), "latch_us": min(latch)}


def _read(fd: int, tags: int, cycles: int, told: Any) -> None:
    """Ask for samples, and read them until the scan has done so many cycles."""
    reader = ImageReader(fd, "s")
    stream = reader.samples()
    first = reader.directory.find("p.words_[0]").address
    count = reader.directory.find("p.count").address
    spans = [(count, 4), *((first + 400 * n, 4) for n in range(tags - 1))]
    reader.send(SampleCommand(1, 1, 0, spans))
    seen: list[int] = []
    deadline = time.monotonic() + cycles / 1000 + 30
    while time.monotonic() < deadline:
        for record in stream.read():
            sample = sample_of(record.data)
            if sample.cycle != int.from_bytes(sample.data[:4], "little"):
                raise RuntimeError("a sample is not of its cycle")
            seen.append(sample.cycle)
        if seen and seen[-1] >= cycles:
            break
        time.sleep(0.005)
    missing = seen[-1] - seen[0] + 1 - len(seen)
    told.put((len(seen), missing, stream.lost))


def sampled(tags: int, seconds: float) -> dict[str, float]:
    """Return what a reader of so many tags got in so many seconds at 1 ms."""
    controller, _, fd = make(100_000, MonotonicClock())
    cycles = round(1000 * seconds)
    context = multiprocessing.get_context("fork")
    told = context.SimpleQueue()
    process = context.Process(target=_read, args=(fd, tags, cycles, told))
    process.start()
    controller.run(cycles=cycles + 50)
    samples, missing, lost = told.get()
    process.join()
    (task_class,) = controller.classes
    return {
        "samples": samples,
        "missing": missing,
        "lost": lost,
        "missed_grid_points": task_class.missed,
        "controller_p50_us": task_class.controller.percentile_ns(50) / 1000,
        "controller_p99_us": task_class.controller.percentile_ns(99) / 1000,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description="What the shared image costs the scan.")
    parser.add_argument("--seconds", type=float, default=10, help="of each run of (b)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="keep all figures")
    options = parser.parse_args()
    found: dict[str, Any] = {"costs": costs(), "sampled": {}}
    print("(a) quickest, us                            PUBLISH   LATCH")
    for name, figures in found["costs"].items():
        print(f"{name:<42} {figures['publish_us']:8.1f} {figures['latch_us']:7.1f}")
    realtime.sharpen_timers()
    print("(b) tags  samples  missing  lost  missed grid points  LATCH + PUBLISH p50, p99 us")
    for tags in (8, 50, 200):
        figures = found["sampled"][tags] = sampled(tags, options.seconds)
        print(
            f"{tags:8} {figures['samples']:8.0f} {figures['missing']:8.0f} {figures['lost']:5.0f}"
            f" {figures['missed_grid_points']:19.0f}  {figures['controller_p50_us']:20.1f},"
            f" {figures['controller_p99_us']:.1f}"
        )
    if options.json is not None:
        options.json.write_text(json.dumps(found, indent=2) + "\n")


if __name__ == "__main__":
    main()
