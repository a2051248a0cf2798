"""Pictures as SVG text: timing diagrams and histograms, without any library."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

from plcsim.core.duration import format_duration
from plcsim.library.value_text import text_of
from plcsim.testing.values import is_number, printable

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.core.tag import Tag

    Changes = Sequence[tuple[int, object]]

WIDTH = 960
LANE = 34
GAP = 12
GUTTER = 86
"""Pixels beside the names: the bounds of curves stand there."""

LETTER = 6.7
"""Width of a letter of the 11 px font, in pixels, with some to spare."""

STYLE = """<style>
text { font: 11px ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace; fill: #1f2933 }
.title { font-weight: bold; font-size: 13px }
.soft { fill: #6b7785 }
.grid { stroke: #e3e7ec; stroke-width: 1 }
.bool { stroke: #0b6e4f; stroke-width: 1.6; fill: none }
.on { fill: #0b6e4f; opacity: .13 }
.curve { stroke: #1d4ed8; stroke-width: 1.6; fill: none }
.bus { stroke: #7c4a03; stroke-width: 1.2; fill: #fdf6ec }
.bar { fill: #1d4ed8 }
.limit { stroke: #c81e1e; stroke-width: 1.4; stroke-dasharray: 4 3 }
text.alarm { fill: #c81e1e }
</style>"""


class _Scale:
    """From nanoseconds to pixels."""

    def __init__(self, start_ns: int, end_ns: int, left: float, right: float) -> None:
        self.start_ns = start_ns
        self.end_ns = max(end_ns, start_ns + 1)
        self._left = left
        self._factor = (right - left) / (self.end_ns - self.start_ns)

    def x(self, time_ns: int) -> float:
        return round(self._left + (time_ns - self.start_ns) * self._factor, 1)


def document(width: float, height: float, body: str) -> str:
    """Return a whole SVG picture."""
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}" '
        f'viewBox="0 0 {width:g} {height:g}">\n{STYLE}\n'
        f'<rect width="100%" height="100%" fill="white"/>\n{body}\n</svg>\n'
    )


def label(x: float, y: float, text: str, kind: str = "", anchor: str = "start") -> str:
    """Return one line of text."""
    name = f' class="{kind}"' if kind else ""
    shown = escape(printable(text))
    return f'<text x="{x:g}" y="{y:g}"{name} text-anchor="{anchor}">{shown}</text>'


def timing_diagram(
    lanes: Sequence[tuple[Tag, Changes]], end_ns: int, title: str = "", failure: str = ""
) -> str:
    """Return a timing diagram.

    Args:
        lanes: each tag with its changes, (time_ns, value).
        end_ns: time up to which the last values hold.
        title: printed above.
        failure: what was expected and did not happen by the end; printed in red, marked by a line.
    """
    starts = [changes[0][0] for _, changes in lanes if changes]
    start_ns = min(starts, default=0)
    left = min(420, GUTTER + LETTER * max((len(tag.path) for tag, _ in lanes), default=0))
    top = 14 + (20 if title else 0) + (20 if failure else 0)
    bottom = top + len(lanes) * (LANE + GAP)
    scale = _Scale(start_ns, end_ns + max(1, (end_ns - start_ns) // 60), left, WIDTH - 16)
    parts = [label(12, 20, title, "title")] if title else []
    parts += _axis(scale, top, bottom)
    if failure:
        x, room = scale.x(end_ns), int((WIDTH - 24) / LETTER)
        shown = failure if len(failure) <= room else failure[: room - 1] + "…"
        parts.append(label(12, top - 12, shown, "alarm"))
        parts.append(f'<line class="limit" x1="{x}" y1="{top}" x2="{x}" y2="{bottom}"/>')
    for bucket, (tag, changes) in enumerate(lanes):
        y = top + bucket * (LANE + GAP)
        parts.append(label(12, y + LANE / 2 + 4, tag.path))
        parts += _lane(tag, changes, scale, y)
    return document(WIDTH, bottom + 26, "\n".join(parts))


def _axis(scale: _Scale, top: float, bottom: float) -> list[str]:
    parts = []
    for time_ns in ticks(scale.start_ns, scale.end_ns):
        x = scale.x(time_ns)
        parts.append(f'<line class="grid" x1="{x}" y1="{top}" x2="{x}" y2="{bottom}"/>')
        parts.append(label(x, bottom + 14, f"{time_ns / 1e6:g} ms", "soft", "middle"))
    return parts


def ticks(start_ns: int, end_ns: int, wanted: int = 8) -> list[int]:
    """Return about ``wanted`` round times between start and end."""
    step_ns = 1
    while (end_ns - start_ns) // step_ns > wanted:
        digit = int(str(step_ns)[0])
        step_ns = step_ns * {1: 2, 2: 5, 5: 10}[digit] // {1: 1, 2: 2, 5: 5}[digit]
    first = -(-start_ns // step_ns) * step_ns
    return list(range(first, end_ns + 1, step_ns))


def _lane(tag: Tag, changes: Changes, scale: _Scale, y: float) -> list[str]:
    if all(isinstance(value, bool) for _, value in changes):
        return _levels(changes, scale, y)
    if is_number(tag.data_type) and _crowded(tag, changes, scale):
        return _curve(changes, scale, y)
    return _bus(tag, changes, scale, y)


def _spans(changes: Changes, scale: _Scale) -> list[tuple[float, float, object]]:
    ends = [time_ns for time_ns, _ in changes[1:]] + [scale.end_ns] * bool(changes)
    return [
        (scale.x(time_ns), scale.x(end_ns), value)
        for (time_ns, value), end_ns in zip(changes, ends, strict=True)
    ]


def _levels(changes: Changes, scale: _Scale, y: float) -> list[str]:
    low, high = y + LANE, y + 6
    points: list[str] = []
    parts: list[str] = []
    for x, end, value in _spans(changes, scale):
        level = high if value else low
        points += [f"{x},{level}", f"{end},{level}"]
        if value:
            parts.append(
                f'<rect class="on" x="{x}" y="{high}" width="{end - x:.1f}" height="{low - high}"/>'
            )
    return [*parts, f'<polyline class="bool" points="{" ".join(points)}"/>']


def _crowded(tag: Tag, changes: Changes, scale: _Scale) -> bool:
    """Whether the values would not fit between their changes as text."""
    return any(
        len(text_of(tag.data_type, value)) * LETTER + 12 > end - x
        for x, end, value in _spans(changes, scale)[:-1]
    )


def _curve(changes: Changes, scale: _Scale, y: float) -> list[str]:
    numbers = [value for _, value in changes if isinstance(value, int | float)]
    low, high = min(numbers), max(numbers)
    span = (high - low) or 1
    points: list[str] = []
    for x, end, value in _spans(changes, scale):
        if isinstance(value, int | float):
            level = round(y + LANE - (value - low) / span * (LANE - 6), 1)
            points += [f"{x},{level}", f"{end},{level}"]
    left = scale.x(scale.start_ns)
    return [
        f'<polyline class="curve" points="{" ".join(points)}"/>',
        label(left - 6, y + 12, f"{high:.4g}", "soft", "end"),
        label(left - 6, y + LANE, f"{low:.4g}", "soft", "end"),
    ]


def _bus(tag: Tag, changes: Changes, scale: _Scale, y: float) -> list[str]:
    parts: list[str] = []
    middle, low, high = y + LANE / 2 + 3, y + LANE, y + 6
    for x, end, value in _spans(changes, scale):
        slope = min(3.0, (end - x) / 2)
        parts.append(
            f'<polygon class="bus" points="{x},{middle} {x + slope:.1f},{high} '
            f"{end - slope:.1f},{high} {end},{middle} {end - slope:.1f},{low} "
            f'{x + slope:.1f},{low}"/>'
        )
        text = text_of(tag.data_type, value)
        room = int((end - x - 10) / LETTER)
        if room > 0:
            shown = text if len(text) <= room else text[: room - 1] + "…"
            parts.append(label(x + 7, middle + 4, shown))
    return parts


def histogram(
    buckets: Sequence[tuple[int, int]],
    limit_ns: int | None = None,
    width: int = 360,
    text_of: Callable[[int], str] = format_duration,
) -> str:
    """Return a histogram of durations, or of other numbers, on a logarithmic scale.

    Args:
        buckets: (upper end in nanoseconds, count), ascending, empty ones left out.
        limit_ns: drawn as a dashed line.
        width: pixels.
        text_of: gives the text of a number on the axis.
    """
    bars = _log_bars(buckets)
    height, left, bottom = 96, 10, 74
    low = min(bars, default=0)
    count = max(bars, default=0) - low + 1
    step = (width - 2 * left) / max(count, 8)
    most = max(bars.values(), default=1)
    parts: list[str] = []
    for bucket, amount in sorted(bars.items()):
        size = max(1.5, amount / most * 58)
        x = left + (bucket - low) * step
        parts.append(
            f'<rect class="bar" x="{x:.1f}" y="{bottom - size:.1f}" '
            f'width="{max(1.0, step - 1):.1f}" height="{size:.1f}"/>'
        )
    parts += _number_axis(low, max(count, 8), (left, width - left, bottom + 14), text_of)
    if limit_ns:
        x = left + (_bucket(limit_ns) - low) * step
        if left <= x <= width - left:
            parts.append(f'<line class="limit" x1="{x:.1f}" y1="8" x2="{x:.1f}" y2="{bottom}"/>')
    parts.append(
        f'<line class="grid" x1="{left}" y1="{bottom}" x2="{width - left}" y2="{bottom}"/>'
    )
    return document(width, height, "\n".join(parts))


def _number_axis(
    low: int, bars: int, bucket: tuple[float, float, float], text_of: Callable[[int], str]
) -> list[str]:
    """Return the labels below the bars: at both ends and between."""
    left, right, y = bucket
    anchors = ("start", "middle", "middle", "middle", "end")
    parts = []
    for quarter, anchor in enumerate(anchors):
        x = left + (right - left) * quarter / 4
        text = text_of(_two_digits(2 ** ((low + bars * quarter / 4) / 4)))
        parts.append(label(round(x, 1), y, text, "soft", anchor))
    return parts


def _bucket(duration_ns: int) -> int:
    """Return the bar of a duration: four bars double it."""
    bucket = 0
    while 2 ** ((bucket + 1) / 4) <= max(1, duration_ns):
        bucket += 1
    return bucket


def _log_bars(buckets: Sequence[tuple[int, int]]) -> dict[int, int]:
    bars: dict[int, int] = {}
    for end_ns, count in buckets:
        bucket = _bucket(end_ns)
        bars[bucket] = bars.get(bucket, 0) + count
    return bars


def _two_digits(number: float) -> int:
    """Return a number rounded to two digits."""
    whole = round(number)
    return round(whole, 2 - len(str(whole)))
