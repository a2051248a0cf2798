"""Draws tags of a recording over time as PNG, in lanes as `plcsim.recorder.bag.plot` does."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.duration import format_duration
from plcsim.recorder.bag.plot import (
    COLOURS,
    DIGITAL_LANE,
    FOOT,
    GAP,
    HEAD,
    LANE,
    LEFT,
    RIGHT,
    WIDTH,
    more_width,
    ticks_ns,
)
from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.recorder.bag.series import Series

DPI: Final = 100


def draw_png(series: Sequence[Series], title: str) -> bytes:
    """Return the picture, a lane for each tag, one time axis below.

    Args:
        series: at least one.
        title: above the lanes.

    Raises:
        RecordingError: matplotlib is not installed.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: PLC0415  # an extra
        from matplotlib.figure import Figure  # noqa: PLC0415
    except ImportError:
        raise RecordingError(
            "PNG needs the package matplotlib: pip install 'plcsim[plot]'; SVG needs nothing"
        ) from None
    end_ns = max(1, *(each.points[-1][0] for each in series))
    lanes = [DIGITAL_LANE if _is_digital(each) else LANE for each in series]
    height = HEAD + sum(lanes) + GAP * len(lanes) + FOOT
    more = more_width(series)
    left, whole = LEFT + more, WIDTH + more
    figure = Figure(figsize=(whole / DPI, height / DPI), dpi=DPI, facecolor="white")
    figure.text(left / whole, 1 - 20 / height, title, fontsize=9)
    top, width = HEAD, (whole - left - RIGHT) / whole
    for number, (each, lane) in enumerate(zip(series, lanes, strict=True)):
        top += lane
        box = (left / whole, 1 - top / height, width, lane / height)
        axes = figure.add_axes(box, facecolor="#fafafa")
        _draw_lane(axes, each, COLOURS[number % len(COLOURS)], end_ns)
        axes.tick_params(labelbottom=number == len(series) - 1, length=0, labelsize=8)
        figure.text(
            8 / whole, 1 - (top - lane / 2) / height, each.tag.path, fontsize=9, va="center"
        )
        top += GAP
    written = BytesIO()
    FigureCanvasAgg(figure).print_png(written, metadata={"Software": None})
    return written.getvalue()


def _is_digital(series: Series) -> bool:
    return isinstance(series.points[0][1], bool)


def _draw_lane(axes: Any, series: Series, colour: str, end_ns: int) -> None:
    times, values = zip(*series.points, strict=True)
    axes.plot(times, [float(v) for v in values], drawstyle="steps-post", color=colour, lw=1.2)
    axes.set_xlim(0, end_ns)
    ticks = ticks_ns(end_ns)
    axes.set_xticks(ticks, [format_duration(t) if t else "0" for t in ticks])
    axes.grid(axis="x", color="#dddddd")
    if _is_digital(series):
        axes.set_ylim(-0.2, 1.2)
        axes.set_yticks([0, 1], ["FALSE", "TRUE"])
