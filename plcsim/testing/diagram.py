"""Cycles as text: a table of values, and a timing diagram that a terminal shows."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from plcsim.library.value_text import text_of
from plcsim.testing.values import is_number, printable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.tag import Tag

LEVELS = "▁▂▃▄▅▆▇█"
LOW, HIGH = "▁", "▇"
WIDEST = 24
"""Characters of a value in a table; longer ones are cut."""

DIAGRAM_WIDTH = 96
"""Characters of a timing diagram, names included."""


def table(rows: Sequence[Sequence[str]], head: Sequence[str]) -> str:
    """Return right-aligned columns under their heads."""
    texts = [tuple(head), *(tuple(shorten(cell) for cell in row) for row in rows)]
    widths = [max(len(cell) for cell in column) for column in zip(*texts, strict=True)]
    return "\n".join(
        "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
        for row in texts
    )


def shorten(text: str, width: int = WIDEST) -> str:
    """Return at most ``width`` characters, all of them printable."""
    text = printable(text)
    return text if len(text) <= width else text[: width - 1] + "…"


def draw(lanes: Sequence[tuple[Tag, Sequence[object]]], step: int, foot: str) -> str:
    """Return a timing diagram, one lane a tag.

    Args:
        lanes: tags with one value for each cycle.
        step: columns that a cycle takes.
        foot: last line, under the lanes; "" for none.
    """
    label = max(len(tag.path) for tag, _ in lanes)
    lines = [f"{tag.path.ljust(label)}  {_lane(tag, values, step)}" for tag, values in lanes]
    if foot:
        lines.append(f"{'cycle'.ljust(label)}  {foot}")
    return "\n".join(line.rstrip() for line in lines)


def step_for(tags: Sequence[Tag], cycles: int) -> int:
    """Return how many columns a cycle can take so that the diagram keeps its width."""
    label = max(len(tag.path) for tag in tags) + 2
    return max(1, min(4, (DIAGRAM_WIDTH - label) // max(1, cycles)))


def foot_of(cycles: Sequence[int], step: int) -> str:
    """Return the line that numbers every tenth cycle."""
    line = ""
    for index, cycle in enumerate(cycles):
        column = index * step
        if cycle % 10 in (0, 5) and column >= len(line):
            line = line.ljust(column) + f"|{cycle} "
    return line


def _lane(tag: Tag, values: Sequence[object], step: int) -> str:
    if all(isinstance(value, bool) for value in values):
        return "".join((HIGH if value else LOW) * step for value in values)
    runs = [(value, len(list(run)) * step) for value, run in groupby(values)]
    texts = [(text_of(tag.data_type, value), width) for value, width in runs]
    if is_number(tag.data_type) and any(len(text) >= width for text, width in texts[:-1]):
        return _curve(values, step)
    lane = "".join(f"│{shorten(text, width - 1)}".ljust(width) for text, width in texts[:-1])
    return lane + f"│{shorten(texts[-1][0])}" if texts else ""


def _curve(values: Sequence[object], step: int) -> str:
    numbers = [value for value in values if isinstance(value, int | float)]
    low, high = min(numbers), max(numbers)
    span = (high - low) or 1
    heights = (int((number - low) / span * (len(LEVELS) - 1) + 0.5) for number in numbers)
    return "".join(LEVELS[index] * step for index in heights) + f"  {low:.6g} to {high:.6g}"
