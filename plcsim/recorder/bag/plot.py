"""Draws tags of a recording over time as a picture: SVG, alone or in a page of HTML."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Final

from plcsim.core.duration import format_duration

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.recorder.bag.series import Series

WIDTH: Final = 1000
LEFT: Final = 190
CHARACTER: Final = 7
"""Pixels of a character, at most on the average."""
NAMES: Final = LEFT - 60
"""Pixels that names have beside the numbers; longer ones make the picture wider."""
RIGHT: Final = 20
LANE: Final = 96
DIGITAL_LANE: Final = 44
GAP: Final = 14
FOOT: Final = 34
HEAD: Final = 34
TICKS: Final = 8
COLOURS: Final = ("#1b6ca8", "#b5541c", "#2f7d4f", "#7a4b9a", "#9a7b13", "#b03052")

_STYLE: Final = (
    "text{font:12px sans-serif;fill:#333}.d{fill:#777}.g{stroke:#ddd;stroke-width:1}"
    ".l{fill:none;stroke-width:1.5;stroke-linejoin:round}.f{fill:#fafafa;stroke:#ccc}"
)


def draw(series: Sequence[Series], title: str) -> str:
    """Return the picture as SVG, a lane for each tag, one time axis below.

    Args:
        series: at least one.
        title: above the lanes.
    """
    end_ns = max(1, *(each.points[-1][0] for each in series))
    more = more_width(series)
    parts: list[str] = []
    top = HEAD
    for number, each in enumerate(series):
        height = DIGITAL_LANE if isinstance(each.points[0][1], bool) else LANE
        colour = COLOURS[number % len(COLOURS)]
        parts += _lane(each, top, height, end_ns, colour, 8 - more)
        top += height + GAP
    height = top + FOOT
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{-more} 0 {WIDTH + more} {height}" '
        f'width="{WIDTH + more}" height="{height}"><style>{_STYLE}</style>'
        f'<rect x="{-more}" width="{WIDTH + more}" height="{height}" fill="#fff"/>'
        f'<text x="{LEFT}" y="20">{escape(title)}</text>'
    )
    return head + "".join([*_grid(end_ns, top), *parts]) + "</svg>\n"


def more_width(series: Sequence[Series]) -> int:
    """Return how many pixels the names need beyond those that they have."""
    return max(0, CHARACTER * max(len(each.tag.path) for each in series) - NAMES)


def page(picture: str, title: str) -> str:
    """Return a page of HTML with the picture."""
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{escape(title)}</title>'
        f'<body style="margin:0;background:#fff"><div style="overflow-x:auto">{picture}</div>'
        "</body></html>\n"
    )


def _x(time_ns: int, end_ns: int) -> float:
    return LEFT + (WIDTH - LEFT - RIGHT) * time_ns / end_ns


def _grid(end_ns: int, bottom: int) -> Iterator[str]:
    for time_ns in ticks_ns(end_ns):
        x = _x(time_ns, end_ns)
        text = format_duration(time_ns) if time_ns else "0"
        yield f'<line class="g" x1="{x:.1f}" x2="{x:.1f}" y1="30" y2="{bottom}"/>'
        yield (f'<text class="d" x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{text}</text>')


def ticks_ns(end_ns: int) -> range:
    """Return times from 0 in round steps, about `TICKS` of them."""
    step_ns = 1
    for factor in _round_factors():
        step_ns = factor
        if end_ns / step_ns <= TICKS:
            break
    return range(0, end_ns + 1, step_ns)


def _round_factors() -> Iterator[int]:
    for power in range(10):
        yield from (10**power, 2 * 10**power, 5 * 10**power)
    seconds = (10, 30, 60, 120, 300, 600, 1800, 3600, 7200, 21_600, 86_400, 604_800)
    yield from (each * 10**9 for each in seconds)


def _lane(
    each: Series, top: int, height: int, end_ns: int, colour: str, name_x: int
) -> Iterator[str]:
    values = [value for _, value in each.points]
    low, high = float(min(values)), float(max(values))
    is_digital = isinstance(values[0], bool)
    if is_digital:
        low, high = 0.0, 1.0
    yield (
        f'<rect class="f" x="{LEFT}" y="{top}" width="{WIDTH - LEFT - RIGHT}" height="{height}"/>'
    )
    yield f'<text x="{name_x}" y="{top + height / 2 + 4}">{escape(each.tag.path)}</text>'
    if not is_digital:
        bounds = [(high, top + 12), (low, top + height - 4)]
        for value, y in bounds if high > low else [(low, top + height // 2 + 4)]:
            yield f'<text class="d" x="{LEFT - 6}" y="{y}" text-anchor="end">{value:g}</text>'
    spread = (high - low) or 1.0
    inner, bottom = height - 12, top + height - 6

    def y_of(value: float) -> float:
        return bottom - inner * (value - low) / spread if high > low else top + height / 2

    points = [(_x(time_ns, end_ns), y_of(float(value))) for time_ns, value in each.points]
    yield f'<path class="l" stroke="{colour}" d="{_steps(points)}"/>'


def _steps(points: Sequence[tuple[float, float]]) -> str:
    """Return a stepped line; within one pixel only the first, the extremes and the last count."""
    x, y = points[0]
    words = [f"M{x:.1f} {y:.1f}"]
    column, pending = int(x), [y]
    for x, y in points[1:]:
        if int(x) != column:
            words += _column(pending)
            column, pending = int(x), []
            words.append(f"H{x:.1f}")
        pending.append(y)
    words += _column(pending)
    words.append(f"H{points[-1][0]:.1f}")
    return "".join(words)


def _column(pending: Sequence[float]) -> list[str]:
    if len(pending) <= 3:
        return [f"V{y:.1f}" for y in pending]
    return [f"V{y:.1f}" for y in (pending[0], min(pending), max(pending), pending[-1])]
