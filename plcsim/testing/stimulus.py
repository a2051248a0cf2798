"""Stimuli: values for tags at given times, from a list or a CSV file.

The first row of a file names the columns: ``time`` (durations such as ``250ms``) or ``time_ns``,
``time_us``, ``time_ms``, ``time_s`` (numbers), then one column for each tag. An empty cell changes
nothing. The columns ``task_class`` and ``cycle`` of a recorded trace are passed over.
"""

from __future__ import annotations

import csv
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.duration import parse_duration_ns
from plcsim.core.errors import TagError
from plcsim.library.value_text import value_of
from plcsim.testing.errors import StimulusError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

    from plcsim.testing.tags import Tags

__tracebackhide__ = True

PASSED_OVER = ("task_class", "cycle")
_UNITS_NS = {"time_ns": 1, "time_us": 1_000, "time_ms": 1_000_000, "time_s": 1_000_000_000}


class Stimulus(NamedTuple):
    """Values that tags take at one time, nanoseconds from the start of the stimuli."""

    time_ns: int
    values: Mapping[str, object]


def read_stimuli(file: Path, tags: Tags) -> list[Stimulus]:
    """Read stimuli from a CSV file.

    Raises:
        StimulusError: something is wrong; the message names file, line and column.
    """
    try:
        with file.open(encoding="utf-8-sig", newline="") as text:
            rows = list(csv.reader(text))
    except (OSError, UnicodeDecodeError, csv.Error) as err:
        raise StimulusError(f"{file}: cannot be read: {err}") from None
    if not rows:
        raise StimulusError(f"{file}: is empty; its first line names the columns")
    head = [name.strip() for name in rows[0]]
    _check_head(file, head, tags)
    stimuli: list[Stimulus] = []
    for line, row in enumerate(rows[1:], 2):
        if row:
            stimuli.append(_stimulus(f"{file}:{line}", head, row, tags))
            if len(stimuli) > 1 and stimuli[-1].time_ns < stimuli[-2].time_ns:
                raise StimulusError(f"{file}:{line}: {head[0]}: is before the line above")
    return stimuli


def _check_head(file: Path, head: Sequence[str], tags: Tags) -> None:
    if head[0] not in ("time", *_UNITS_NS):
        raise StimulusError(
            f"{file}:1: the first column is {head[0]!r}; it must be time (such as 250ms) or one of "
            f"{', '.join(_UNITS_NS)}"
        )
    for name in head[1:]:
        if name in PASSED_OVER:
            continue
        try:
            tags.find(name)
        except TagError as err:
            raise StimulusError(f"{file}:1: {err}") from None


def _stimulus(location: str, head: Sequence[str], row: Sequence[str], tags: Tags) -> Stimulus:
    if len(row) != len(head):
        raise StimulusError(f"{location}: {len(row)} cells under {len(head)} column names")
    try:
        time_ns = _time_ns(head[0], row[0].strip())
    except ValueError as err:
        raise StimulusError(f"{location}: {head[0]}: {err}") from None
    values: dict[str, object] = {}
    for name, cell in zip(head[1:], row[1:], strict=True):
        if name in PASSED_OVER or not cell.strip():
            continue
        try:
            values[name] = value_of(tags.find(name).data_type, cell.strip())
            tags.encode(name, values[name])
        except (ValueError, TagError) as err:
            raise StimulusError(f"{location}: {name}: {err}") from None
    return Stimulus(time_ns, values)


def _time_ns(column: str, text: str) -> int:
    if column == "time":
        return parse_duration_ns(text)
    try:
        time_ns = Fraction(text) * _UNITS_NS[column]
    except (ValueError, ZeroDivisionError):
        raise ValueError(f"{text!r} is not a number") from None
    if time_ns.denominator != 1 or time_ns < 0:
        raise ValueError(f"{text!r} is not a whole number of nanoseconds from 0 on")
    return time_ns.numerator


def listed_stimuli(
    given: Iterable[tuple[str | int, Mapping[str, object]]], tags: Tags
) -> list[Stimulus]:
    """Return stimuli given as (time, values); a time is a duration or an int of nanoseconds.

    Raises:
        StimulusError: something is wrong; the message counts the stimuli from 1.
    """
    stimuli: list[Stimulus] = []
    for number, (time, values) in enumerate(given, 1):
        try:
            time_ns = parse_duration_ns(time) if isinstance(time, str) else time
            for path, value in values.items():
                tags.encode(path, value)
        except (ValueError, TagError) as err:
            raise StimulusError(f"stimulus {number}: {err}") from None
        stimuli.append(Stimulus(time_ns, values))
    return stimuli
