"""The picture of a campaign: where it passed and where it failed, over what was varied."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from plcsim.campaign.result import RunOutcome

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.campaign.result import Result
    from plcsim.campaign.variables import Scalar

PICTURE_FILE: Final = "picture.png"
MOST_AXES: Final = 5
"""Variables in a picture; those come first whose values tell failures best from the others."""

_COLOURS = {True: "#2a78b5", False: "#d1495b"}
_LEGEND = [
    Line2D([], [], linestyle="", marker=".", color=_COLOURS[True], label="passed"),
    Line2D([], [], linestyle="", marker="x", color=_COLOURS[False], label="failed"),
]
_PER_AXIS_INCHES = 2.6


def draw(results: Sequence[Result], file: Path, title: str) -> None:
    """Write a picture (PNG): one panel for each pair of variables.

    A run that passed is a blue dot, one that did not a red cross, so that colours are not needed.
    """
    names = _telling(results)
    count = len(names)
    size = max(5.0, _PER_AXIS_INCHES * count)
    figure = Figure(figsize=(size, size * (0.8 if count < 3 else 1)), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(title)
    passed = np.array([result.outcome is RunOutcome.PASSED for result in results])
    if count == 1:
        _strip(figure.subplots(), results, names[0], passed)
    elif count == 2:
        _pair(figure.subplots(), results, (names[0], names[1]), passed, labels=(True, True))
    else:
        _matrix(figure, results, names, passed)
    figure.legend(handles=_LEGEND, loc="upper right")
    figure.savefig(file, dpi=110)


def _matrix(figure: Figure, results: Sequence[Result], names: list[str], passed: Any) -> None:
    """Draw the lower triangle of all pairs."""
    panels = figure.subplots(len(names) - 1, len(names) - 1, squeeze=False)
    for row, column in itertools.product(range(len(names) - 1), repeat=2):
        panel = panels[row][column]
        if column > row:
            panel.set_visible(False)
            continue
        labels = (row == len(names) - 2, column == 0)
        _pair(panel, results, (names[column], names[row + 1]), passed, labels)


def _pair(
    panel: Any,
    results: Sequence[Result],
    names: tuple[str, str],
    passed: Any,
    labels: tuple[bool, bool],
) -> None:
    across, up = (_positions(results, name) for name in names)
    for ok, marker in ((True, "."), (False, "x")):
        chosen = passed == ok
        if chosen.any():
            panel.scatter(across[chosen], up[chosen], marker=marker, c=_COLOURS[ok], s=18)
    _ticks(panel.xaxis, results, names[0], labelled=labels[0])
    _ticks(panel.yaxis, results, names[1], labelled=labels[1])


def _strip(panel: Any, results: Sequence[Result], name: str, passed: Any) -> None:
    """Draw one variable against the margin, or in two lines where there is none."""
    margins = [result.margin for result in results]
    known = all(margin is not None for margin in margins)
    up = np.array(margins, float) if known else passed.astype(float)
    across = _positions(results, name)
    for ok, marker in ((True, "."), (False, "x")):
        chosen = passed == ok
        panel.scatter(across[chosen], up[chosen], marker=marker, c=_COLOURS[ok], s=24)
    _ticks(panel.xaxis, results, name, labelled=True)
    panel.set_ylabel("margin" if known else "failed … passed")
    panel.axhline(0.0 if known else 0.5, color="0.6", linewidth=0.8)


def _values(results: Sequence[Result], name: str) -> list[Scalar]:
    return [result.order.values[name] for result in results]


def _is_number(values: Sequence[Scalar]) -> bool:
    return all(isinstance(v, int | float) and not isinstance(v, bool) for v in values)


def _positions(results: Sequence[Result], name: str) -> Any:
    """Return where the runs lie on an axis; texts and BOOLs get whole numbers, spread a little."""
    values = _values(results, name)
    if _is_number(values):
        return np.array(values, float)
    places = {value: place for place, value in enumerate(sorted(set(values), key=str))}
    spread = np.random.default_rng(0).uniform(-0.18, 0.18, len(values))
    return np.array([places[value] for value in values]) + spread


def _ticks(axis: Any, results: Sequence[Result], name: str, *, labelled: bool) -> None:
    values = _values(results, name)
    if not _is_number(values):
        kinds = sorted(set(values), key=str)
        axis.set_ticks(range(len(kinds)), [str(kind) for kind in kinds])
    if labelled:
        axis.set_label_text(name)


def _telling(results: Sequence[Result]) -> list[str]:
    """Return the variables, those first whose values differ most between passed and failed."""
    names = [name for name in results[0].order.values if len(set(_values(results, name))) > 1]
    names = names or list(results[0].order.values)[:1]
    if len(names) <= MOST_AXES:
        return names
    return sorted(names, key=lambda name: -_difference(results, name))[:MOST_AXES]


def _difference(results: Sequence[Result], name: str) -> float:
    """Return how far the means of passed and failed runs are apart, in standard deviations."""
    at = _positions(results, name)
    passed = np.array([result.outcome is RunOutcome.PASSED for result in results])
    if passed.all() or not passed.any() or not at.std():
        return 0.0
    return float(abs(at[passed].mean() - at[~passed].mean()) / at.std())
