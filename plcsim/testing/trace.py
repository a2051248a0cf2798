"""Traces: the values of some tags over a run, kept where they change."""

from __future__ import annotations

import csv
import io
from bisect import bisect_right
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.duration import parse_duration_ns
from plcsim.library.value_text import text_of
from plcsim.testing.diagram import draw
from plcsim.testing.errors import PlcTestError
from plcsim.testing.svg import timing_diagram
from st_types.types.values import decode

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.core.memory import Memory
    from plcsim.core.tag import Tag

__tracebackhide__ = True


class TraceRow(NamedTuple):
    """The values of all tags of a trace after one cycle.

    Attributes:
        time_ns: release of the cycle, since the start of the controller.
        task_class: number of the task class.
        cycle: number of the cycle in its class.
        raw: the bytes of each tag.
    """

    time_ns: int
    task_class: int
    cycle: int
    raw: tuple[bytes, ...]


class Trace:
    """The values of some tags, one row for every cycle after which one of them had changed.

    Args:
        tags: of elementary types.

    Attributes:
        tags: the tags.
        rows: where a value changed, the first one included.
        end_ns: time up to which the last row holds.
    """

    def __init__(self, tags: Sequence[Tag]) -> None:
        self.tags = tuple(tags)
        self.rows: list[TraceRow] = []
        self.end_ns = 0
        self._indices = {tag.path.upper(): index for index, tag in enumerate(self.tags)}

    def add(self, row: TraceRow) -> None:
        """Add the values after a cycle; rows come in the order of cycles."""
        self.end_ns = max(self.end_ns, row.time_ns)
        if not self.rows or self.rows[-1].raw != row.raw:
            self.rows.append(row._replace(time_ns=self.end_ns))

    def sample(self, memory: Memory, task_class: int, cycle: int, time_ns: int) -> None:
        """Add the present values of the tags; for the arguments see `TraceRow`."""
        raw = tuple(memory.read(tag.address, tag.data_type.size) for tag in self.tags)
        self.add(TraceRow(time_ns, task_class, cycle, raw))

    def cut(self, time_ns: int) -> None:
        """Forget what came after a time."""
        self.rows = [row for row in self.rows if row.time_ns <= time_ns]
        self.end_ns = min(self.end_ns, time_ns)

    def __len__(self) -> int:
        return len(self.rows)

    def _index(self, path: str) -> int:
        index = self._indices.get(path.upper())
        if index is None:
            known = ", ".join(tag.path for tag in self.tags)
            raise PlcTestError(f"the trace has no tag {path!r}; it has {known}")
        return index

    def __getitem__(self, path: str) -> list[tuple[int, object]]:
        """Return the changes of a tag as (time_ns, value), its first value included.

        Raises:
            PlcTestError: the tag was not recorded.
        """
        index = self._index(path)
        changes: list[tuple[int, object]] = []
        last = None
        for row in self.rows:
            if row.raw[index] != last:
                last = row.raw[index]
                changes.append((row.time_ns, decode(self.tags[index].data_type, last)))
        return changes

    def values(self, path: str) -> list[object]:
        """Return the values a tag took, one after another."""
        return [value for _, value in self[path]]

    def at(self, time: str, path: str) -> object:
        """Return the value of a tag at a time since the start of the controller.

        Raises:
            PlcTestError: the tag was not recorded, or not yet at that time.
        """
        changes = self[path]
        index = bisect_right(changes, parse_duration_ns(time), key=lambda change: change[0])
        if not index:
            raise PlcTestError(f"{path} was not recorded yet at {time}")
        return changes[index - 1][1]

    def to_csv(self) -> str:
        """Return the trace as CSV: time_ns, task_class, cycle, and a column for each tag.

        `Plc.stimulate` reads such a file back.
        """
        file = io.StringIO()
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time_ns", "task_class", "cycle", *(tag.path for tag in self.tags)])
        for row in self.rows:
            texts = (
                text_of(tag.data_type, decode(tag.data_type, raw))
                for tag, raw in zip(self.tags, row.raw, strict=True)
            )
            writer.writerow([row.time_ns, row.task_class, row.cycle, *texts])
        return file.getvalue()

    def to_svg(self, title: str = "", failure: str = "") -> str:
        """Return the trace as a timing diagram, an SVG picture; a failure is marked at its end."""
        lanes = [(tag, self[tag.path]) for tag in self.tags]
        return timing_diagram(lanes, self.end_ns, title, failure)

    def to_text(self, width: int = 100) -> str:
        """Return the trace as a timing diagram of text, one column for a share of the time."""
        if not self.rows:
            return "(no cycle was recorded)"
        start_ns = self.rows[0].time_ns
        span_ns = max(1, self.end_ns - start_ns)
        label = max(len(tag.path) for tag in self.tags) + 2
        columns = max(10, width - label)
        lanes = []
        for tag in self.tags:
            changes = self[tag.path]
            starts = [(t - start_ns) * (columns - 1) // span_ns for t, _ in changes]
            ends = [*starts[1:], columns]
            values = [
                value
                for (_, value), start, end in zip(changes, starts, ends, strict=True)
                for _ in range(end - start)
            ]
            lanes.append((tag, values))
        return draw(lanes, 1, "")

    def save(
        self, folder: Path, name: str, title: str = "", failure: str = ""
    ) -> tuple[Path, Path]:
        """Write ``name``.csv and ``name``.svg into a folder, made if it is not there.

        Returns:
            The two files.
        """
        folder.mkdir(parents=True, exist_ok=True)
        table, picture = folder / f"{name}.csv", folder / f"{name}.svg"
        table.write_text(self.to_csv(), "utf-8")
        picture.write_text(self.to_svg(title, failure), "utf-8")
        return table, picture
