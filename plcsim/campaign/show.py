"""What a person is told of a campaign: outcomes, causes, the smallest failing example."""

from __future__ import annotations

import shlex
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from rich.table import Table

from plcsim.campaign.result import RunOutcome

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

    from plcsim.campaign.result import PlannedRun, Result
    from plcsim.campaign.variables import Scalar
    from plcsim.cli.console import CommandConsole

MOST_CAUSES: Final = 10
"""Causes in the table; the others are counted."""

_STATISTIC_DIGITS = 4


@dataclass(frozen=True)
class FailureCause:
    """Failures that are alike.

    Attributes:
        text: what they have in common.
        failures: in the order of their numbers.
    """

    text: str
    failures: Sequence[Result]


def causes_of(results: Iterable[Result]) -> list[FailureCause]:
    """Return what went wrong, the most frequent first."""
    found: dict[str, list[Result]] = {}
    for result in sorted(results, key=lambda result: result.order.number):
        if result.outcome is not RunOutcome.PASSED:
            found.setdefault(result.cause, []).append(result)
    causes = [FailureCause(text, failures) for text, failures in found.items()]
    return sorted(causes, key=lambda cause: -len(cause.failures))


def repeat_command(file: Path, order: PlannedRun, *, planned: bool = True) -> str:
    """Return the command that repeats a run exactly."""
    words = ["plcsim", "campaign", "repeat", str(file)]
    if planned:
        return shlex.join([*words, str(order.number)])
    for name, value in order.values.items():
        words += ["--set", f"{name}={text_of(value)}"]
    return shlex.join([*words, "--seed", str(order.seed)])


def text_of(value: Scalar) -> str:
    """Return a value as a person types it; a REAL with all its digits."""
    return str(value).upper() if isinstance(value, bool) else str(value)


def print_outcomes(console: CommandConsole, results: Sequence[Result], planned: int) -> None:
    """Print how many runs ended how."""
    counted = Counter(result.outcome for result in results)
    told = ", ".join(f"{counted[o]} {o}" for o in RunOutcome if counted[o])
    missing = planned - len(results)
    left = f"; {missing} of {planned} are not done" if missing > 0 else ""
    console.print(f"{len(results)} runs: {told}{left}")


def print_causes(console: CommandConsole, causes: Sequence[FailureCause], total: int) -> None:
    """Print what went wrong, with the values between which it did."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("runs", justify="right")
    table.add_column("share", justify="right")
    table.add_column("cause")
    table.add_column("first")
    for cause in causes[:MOST_CAUSES]:
        count = len(cause.failures)
        first = f"#{cause.failures[0].order.number}"
        table.add_row(str(count), f"{count / total:.1%}", cause.text, first)
    console.print(table)
    if len(causes) > MOST_CAUSES:
        console.print(f"and {len(causes) - MOST_CAUSES} other causes")


def print_example(
    console: CommandConsole, cause: FailureCause, simplest: Result | None, file: Path
) -> None:
    """Print the smallest failing example of a cause, and the commands that repeat it."""
    first = cause.failures[0]
    shown = simplest or first
    console.print()
    console.print(f"{shown.outcome}: {shown.message}", soft_wrap=True)
    for name, value in shown.order.values.items():
        console.print(f"    {name} = {text_of(value)}")
    if simplest is not None and simplest.order.values != first.order.values:
        console.print(f"  {repeat_command(file, shown.order, planned=False)}", soft_wrap=True)
    console.print(f"  {repeat_command(file, first.order)}", soft_wrap=True)


def print_measured(console: CommandConsole, results: Sequence[Result]) -> None:
    """Print the spread of what was measured, numbers only."""
    columns: dict[str, list[float]] = {}
    for result in results:
        for name, value in _numbers(result).items():
            columns.setdefault(name, []).append(value)
    if not columns:
        return
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in ("measured", "smallest", "median", "largest", "runs"):
        table.add_column(title, justify="left" if title == "measured" else "right")
    for name, values in columns.items():
        ordered = sorted(values)
        shown = (ordered[0], ordered[len(ordered) // 2], ordered[-1])
        table.add_row(name, *(f"{v:.{_STATISTIC_DIGITS}g}" for v in shown), str(len(ordered)))
    console.print(table)


def _numbers(result: Result) -> Mapping[str, float]:
    given: dict[str, Any] = {**result.measured}
    if result.margin is not None:
        given["margin"] = result.margin
    return {
        name: float(value)
        for name, value in given.items()
        if isinstance(value, int | float) and not isinstance(value, bool)
    }


def print_result(console: CommandConsole, result: Result) -> None:
    """Print one run with all that is known of it."""
    for name, value in result.order.values.items():
        console.print(f"    {name} = {text_of(value)}")
    console.print(f"    seed = {result.order.seed}")
    for name, measured in result.measured.items():
        console.print(f"{name}: {measured}")
    if result.margin is not None:
        console.print(f"margin: {result.margin:g}")
    told = f": {result.message}" if result.message else ""
    console.print(f"{result.outcome}{told}", soft_wrap=True)
    if result.details:
        console.print(result.details)
