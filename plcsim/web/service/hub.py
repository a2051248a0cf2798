"""What all pages share: the image, its values, what happened, and the commands to the scan."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import time
from collections import OrderedDict, deque
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from plcsim.access import LineFile
from plcsim.core.errors import PlcError
from plcsim.shared_image.command import Cancel, Follow, SampleCommand
from plcsim.shared_image.events import EventKind, entry_of, violation_of
from plcsim.shared_image.figures import buckets_of, cycle_of
from plcsim.shared_image.reader import ScanWatch
from plcsim.shared_image.samples import sample_of
from plcsim.web.service.commander import Commander
from plcsim.web.service.figures import ClassFigures
from plcsim.web.service.follower import PROBE, Follower
from plcsim.web.service.host import processes, versions
from plcsim.web.service.network import sockets
from plcsim.web.service.sources import Sources
from plcsim.web.service.traces import LiveTrace
from plcsim.web.service.values import SAMPLES, LiveValues
from plcsim.web.service.variables import VariableTree
from st_types.types.values import decode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.tag import Tag
    from plcsim.process.service_main import Service

POLL_S: Final = 0.05
ENTRIES: Final = 2000
"""Of the logbook, kept for pages that are opened later."""

VIOLATIONS: Final = 200
ENDED_TRACES: Final = 4
"""That can still be had as a bag."""

MOST_AT_ONCE: Final = 20_000
"""Records that are taken before the browsers have their turn again."""

AUDIT_FILE: Final = ".plcsim/web-audit.jsonl"
LARGEST_AUDIT: Final = 10 * 1024 * 1024
AUDIT_FILES: Final = 10


class Hub:
    """The one reader of the image in this process.

    Args:
        service: what the process has.
    """

    def __init__(self, service: Service) -> None:
        self.image = service.image
        self.given: dict[str, Any] = service.given
        self.page = service.page
        self.values = LiveValues(self.image)
        self.commander = Commander(self.image, service.wake_fd)
        self.follower = Follower(
            self.image.directory, self.given["pointers"], self.values, self.commander
        )
        self.variables = VariableTree(self.image.directory, self.follower)
        audit = Path(self.given["folder"]) / AUDIT_FILE
        self.audit = LineFile(audit, LARGEST_AUDIT, AUDIT_FILES, service.table)
        self.entries: deque[tuple[int, dict[str, Any]]] = deque(maxlen=ENTRIES)
        self.entries_seen = 0
        self.violations: deque[dict[str, Any]] = deque(maxlen=VIOLATIONS)
        self.lost = 0
        self.traces: dict[int, LiveTrace] = {}
        self.ended: OrderedDict[int, LiveTrace] = OrderedDict()
        self._last_key = 0
        self.figures = ClassFigures(self.given["classes"], self.given["tasks"])
        self.sources = Sources(Path(self.given["folder"]), self.image.directory)
        self._border: dict[str, Any] = {"time_ns": 0, "topics": [], "idents": {}, "tcp": []}
        self.acting: set[asyncio.Future[object]] = set()
        self._followers = 0
        self._events = self.image.events(from_oldest=True)
        self._samples = self.image.samples(from_oldest=True)
        self._watch = ScanWatch(self.image.directory.cycle_ns)
        self._supervisor = os.getppid()
        self._refreshed_s = 0.0

    async def run(self) -> None:
        """Read what comes, until cancelled."""
        self.commander.start()
        self.image.send(Cancel(0))  # what this service had asked for before it was started again
        while True:
            self.read()
            await asyncio.sleep(POLL_S)

    def read(self) -> None:
        """Take what is new in the streams."""
        for record in self._events.read():
            if record.kind == EventKind.ENTRY.value:
                self._enter(record)
            elif record.kind == EventKind.VIOLATION.value:
                self._violated(record)
        for record in self._samples.read(MOST_AT_ONCE):
            if record.kind == EventKind.SAMPLE.value:
                sample = sample_of(record.data)
                trace = self.traces.get(sample.number)
                if trace is not None:
                    trace.take(sample, record.time_ns)
                else:
                    self.values.sampled(sample.number, sample.data)
            elif record.kind == EventKind.RECORD.value:
                self._border = {"time_ns": record.time_ns, **json.loads(record.data)}
            elif record.kind == EventKind.CYCLE.value:
                self.figures.take_cycle(cycle_of(record.data))
            elif record.kind == EventKind.HISTOGRAM.value:
                self.figures.take_histogram(buckets_of(record.data))
        self.lost = self._events.lost

    def _enter(self, record: Any) -> None:
        entry = entry_of(record)
        self.entries_seen += 1
        described = {
            "time_ns": entry.time_ns,
            "severity": entry.severity.value,
            "source": entry.source,
            "text": entry.text,
        }
        self.entries.append((self.entries_seen, described))

    def _violated(self, record: Any) -> None:
        violation = violation_of(record)
        self.violations.append({**violation._asdict(), "cause": violation.cause.value})

    def refresh(self) -> None:
        """Read the values anew, where the last time is not just now."""
        now_s = time.monotonic()
        if now_s - self._refreshed_s >= POLL_S / 2:
            self._refreshed_s = now_s
            self.values.refresh()

    async def start_trace(self, tags: Sequence[Tag], task_class: int) -> LiveTrace:
        """LiveTrace variables in every cycle of a task class from now on.

        Raises:
            PlcError: they cannot be traced, or too many traces run.
        """
        free = (n for n in range(SAMPLES + 1, PROBE) if n not in self.traces)
        number = next(free, 0)
        if not number:
            raise PlcError(f"{PROBE - SAMPLES - 1} traces run already")
        trace = LiveTrace(number, tags)
        self.traces[number] = trace
        try:
            await self.commander.ask(SampleCommand(number, task_class, 0, trace.spans), "trace")
        except BaseException:
            self.traces.pop(number, None)
            raise
        self._last_key += 1
        trace.key = self._last_key
        return trace

    def trace_of(self, key: int) -> LiveTrace:
        """Return a trace that runs, or ended not long ago.

        Raises:
            PlcError: there is none.
        """
        running = {trace.key: trace for trace in self.traces.values() if trace.key}
        found = running.get(key) or self.ended.get(key)
        if found is None:
            raise PlcError("this trace is not kept any more; start it again")
        return found

    def end_trace(self, trace: LiveTrace) -> None:
        """LiveTrace no more."""
        if self.traces.pop(trace.number, None) is not None:
            self.ended[trace.key] = trace
            if len(self.ended) > ENDED_TRACES:
                self.ended.popitem(last=False)
            with contextlib.suppress(PlcError):  # the ring is full: what comes is nobody's
                self.image.send(Cancel(trace.number))

    def follow(self, more: int) -> None:
        """Note that so many more browsers look at the task classes; fewer where it is negative."""
        before, self._followers = self._followers, self._followers + more
        if bool(before) != bool(self._followers):
            looks = bool(self._followers)
            with contextlib.suppress(PlcError):
                self.image.send(Follow(looks, looks))

    def class_of(self, tags: Sequence[Tag]) -> int:
        """Return the fastest class that a program of these tags runs in, else the fastest."""
        heads = {tag.path.partition(".")[0].upper() for tag in tags}
        classes = self.given["classes"]
        own = [c for c in classes if any(task.upper() in heads for task in c["tasks"])]
        return int(min(own or classes, key=lambda c: c["cycle_ns"])["number"])

    def status(self) -> dict[str, Any]:
        """Return how the controller is."""
        alive = self._watch.is_alive(self.page.heartbeat, time.monotonic_ns())
        return {
            "state": self.page.state.name,
            "elapsed_ns": self.page.elapsed_ns,
            "is_alive": alive,
            "is_paused": self.page.is_paused,
            "snapshot": self.image.latest,
            "cycles": {c["number"]: self._figures(c["number"]) for c in self.given["classes"]},
        }

    def _figures(self, number: int) -> dict[str, Any]:
        status = self.page.of_class(number)
        return {**status._asdict(), "violations": status.violations}

    def forces(self) -> list[dict[str, Any]]:
        """Return the forced tags."""
        found = []
        for force in self.image.forces():
            tag = self.image.directory.find(force.path)
            value = value_text(tag.data_type, decode(tag.data_type, force.data))
            found.append({"path": force.path, "value": value, "by": force.source})
        return found

    def system(self) -> dict[str, Any]:
        """Return the processes of the run and what they use."""
        names = {self._supervisor: "supervisor", self.given["scan_pid"]: "scan"}
        return {"processes": processes(self._supervisor, names), "cpu": self.page.cpu}

    def network(self) -> dict[str, Any]:
        """Return the sockets of the processes of the run, topics and idents of the programs."""
        found = sockets(self.system()["processes"])
        return {"now_ns": time.monotonic_ns(), "sockets": found, **self._border}

    def task_classes(self) -> dict[str, Any]:
        """Return histograms, the last cycles and violations of the task classes."""
        span_ns = 4 * max(c["cycle_ns"] for c in self.given["classes"])
        return {
            "histograms": self.figures.histograms(),
            "cycles": self.figures.last_cycles(span_ns),
            "violations": list(self.violations),
        }

    def facts(self) -> dict[str, Any]:
        """Return what does not change while the controller runs."""
        directory = self.image.directory
        return {
            "project": directory.project,
            "folder": self.given["folder"],
            "is_virtual": self.given["is_virtual"],
            "started_s": round(time.time() - self.page.elapsed_ns / 1e9),
            "stays": self.page.stays,
            "memory_size": self.given["memory_size"],
            "variables_size": sum(area.data_type.size for area in directory.areas),
            "snapshot_size": directory.bank_size,
            "classes": self.given["classes"],
            "services": list(directory.services),
            "versions": versions(),
        }
