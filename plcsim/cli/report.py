"""``plcsim report compare A B``: did programs get slower between two runs of the tests?

Of compiled programs on the virtual clock the instructions are known exactly, and by line
(`plcsim.cli.exact_costs`). Of others each repeat of a test gives one number: the median CPU time of
a program's cycles, in runs of the calibration loop that ran between them; the repeats of A and B
are compared by rank.
"""

from __future__ import annotations

import argparse
import json
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

from rich.table import Table
from rich.text import Text

from plcsim.cli.console import CommandConsole
from plcsim.cli.exact_costs import costs_of, differences
from plcsim.cli.exit_codes import ExitCode, epilog
from plcsim.cli.rank_test import rank_test
from plcsim.core.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from plcsim.cli.exact_costs import Cost, CostDifference

SCHEMA = "plcsim-test-report/1"
FILE_NAME = "report.json"

FALSE_ALARMS = 0.01
"""Share of comparisons of equal runs that may end in an alarm, all tests together."""

SMALLEST_CHANGE = 0.1
"""Growth that is no alarm: two runs of the same code differ by a few percent in all repeats alike,
as objects lie elsewhere in memory."""

FEWEST_REPEATS = 5
"""With fewer a rank test could hardly ever be sure."""

Key = tuple[str, str]
"""Test (all of its repeats) and program."""


class ReportComparison(NamedTuple):
    """One program in one test, in two runs.

    Attributes:
        test: the test without the number of the repeat.
        program: the program.
        repeats: of A and of B.
        change: how much the median grew, 0.2 for a fifth.
        probability: of such ranks if the growth were no more than the smallest that counts.
        worse: whether this is an alarm.
    """

    test: str
    program: str
    repeats: tuple[int, int]
    change: float
    probability: float
    worse: bool


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    text = "compare the reports of two test runs"
    parser = subparsers.add_parser(
        "report",
        help=text,
        description=f"{text.capitalize()}.",
        epilog=epilog(DONE="", FAILED="a report cannot be read", DIFFERENT=""),
    )
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    command = commands.add_parser(
        "compare",
        help="tell whether programs got slower",
        description="Compare two reports of `pytest --plc-report DIR --plc-repeat 30`: did a "
        "program get slower from A to B? The unit is the calibration loop of each run, so the "
        "machines may differ in speed.",
        examples=(
            ("pytest --plc-report before --plc-repeat 30", "on the old commit; after on the new"),
            (
                "pytest --plc-report before --plc-lines",
                "which lines cost more, exactly",
            ),
            ("plcsim report compare before after", ""),
        ),
        epilog=epilog(
            DONE="nothing got slower", FAILED="a report is wrong", DIFFERENT="something did"
        ),
    )
    command.add_argument("before", type=Path, metavar="A", help="folder or report.json")
    command.add_argument("after", type=Path, metavar="B", help="folder or report.json")
    command.add_argument(
        "--smallest",
        type=_share,
        default=SMALLEST_CHANGE,
        metavar="SHARE",
        help=f"smallest growth of the median that counts (default: {SMALLEST_CHANGE})",
    )
    command.set_defaults(func=compare)


def _share(text: str) -> float:
    """Return a number from 0 to 100."""
    try:
        share = float(text)
    except ValueError:
        share = -1
    if not 0 <= share <= 100:
        raise argparse.ArgumentTypeError(f"{text!r} is no share such as 0.1")
    return share


def compare(options: argparse.Namespace) -> int:
    """Print the comparison and return the exit code."""
    reports = [read_report(path) for path in (options.before, options.after)]
    before, after = (exact_costs(report) for report in reports)
    exact = before.keys() & after.keys()
    changed = differences(before, after, options.smallest)
    a, b = (
        {key: values for key, values in samples(report).items() if key not in exact}
        for report in reports
    )
    found = comparisons(a, b, options.smallest) if a.keys() & b.keys() or not exact else []
    console = CommandConsole()
    for one in changed:
        console.print(_sentence(one))
    if changed and not any(one.ranges for one in changed):
        console.print("where: pytest --plc-report DIR --plc-lines tells the lines, too")
    if found:
        console.print(_table(found))
    slower = sum(one.worse for one in changed) + sum(one.worse for one in found)
    count = len(exact) + len(found)
    console.print(f"{slower} of {count} got slower" if slower else "nothing got slower")
    return ExitCode.DIFFERENT if slower else ExitCode.DONE


class Report(NamedTuple):
    """A report of tests.

    Attributes:
        file: that it was read from.
        tests: of it.
    """

    file: Path
    tests: Sequence[Mapping[str, Any]]


def read_report(path: Path) -> Report:
    """Return a report of ``--plc-report``.

    Raises:
        ConfigurationError: the report is missing or is none.
    """
    file = path / FILE_NAME if path.is_dir() else path
    try:
        report = json.loads(file.read_text("utf-8"))
    except (OSError, ValueError) as err:
        raise ConfigurationError(f"{file}: cannot be read: {err}") from None
    if not isinstance(report, dict) or report.get("schema") != SCHEMA:
        raise ConfigurationError(f"{file}: is no report of --plc-report ({SCHEMA})")
    if not isinstance(report.get("tests"), list):
        raise ConfigurationError(f"{file}: is damaged: it has no tests")
    return Report(file, report["tests"])


def exact_costs(report: Report) -> dict[Key, Cost]:
    """Return the instructions of all compiled programs by test and program.

    Raises:
        ConfigurationError: the report is damaged.
    """
    with _whole(report.file):
        return costs_of(report.tests)


def samples(report: Report) -> dict[Key, list[float]]:
    """Return the medians of all repeats by test and program.

    Raises:
        ConfigurationError: the report is damaged.
    """
    found: dict[Key, list[float]] = {}
    with _whole(report.file):
        for test in report.tests:
            for program in test["programs"]:
                if test["outcome"] != "skipped" and program["median_in_loops"] > 0:
                    key = test["group"], program["name"]
                    found.setdefault(key, []).append(float(program["median_in_loops"]))
    return found


@contextmanager
def _whole(file: Path) -> Iterator[None]:
    """Tell what is missing in a report by the name of its file."""
    try:
        yield
    except (KeyError, TypeError, ValueError, AttributeError) as err:
        raise ConfigurationError(f"{file}: is damaged: {err!r}") from None


def comparisons(
    before: Mapping[Key, Sequence[float]],
    after: Mapping[Key, Sequence[float]],
    smallest: float = SMALLEST_CHANGE,
) -> list[ReportComparison]:
    """Compare what both runs have.

    The samples of A, made larger by the smallest growth that counts, are tested against those of B.
    The permitted share of false alarms is divided among all comparisons (Bonferroni).

    Raises:
        ConfigurationError: the runs have no program of a test in common, or too few repeats.
    """
    keys = sorted(before.keys() & after.keys())
    if not keys:
        raise ConfigurationError("the two reports have no program of any test in common")
    fewest = min(min(len(before[key]), len(after[key])) for key in keys)
    if fewest < FEWEST_REPEATS:
        raise ConfigurationError(
            f"{fewest} repeats are too few to compare, {FEWEST_REPEATS} are needed and 30 are "
            "good: pytest --plc-repeat 30"
        )
    alarm_below = FALSE_ALARMS / len(keys)
    return [_compare(key, before[key], after[key], smallest, alarm_below) for key in keys]


def _compare(
    key: Key, before: Sequence[float], after: Sequence[float], smallest: float, alarm_below: float
) -> ReportComparison:
    change = median(after) / median(before) - 1
    allowed = [value * (1 + smallest) for value in before]
    probability = rank_test(allowed, after).probability
    repeats = len(before), len(after)
    return ReportComparison(*key, repeats, change, probability, probability < alarm_below)


def _table(found: Sequence[ReportComparison]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in ("test", "program", "repeats", "change", "p", ""):
        left = column in ("test", "program", "")
        table.add_column(column, justify="left" if left else "right", overflow="fold")
    for c in found:
        table.add_row(
            c.test,
            c.program,
            f"{c.repeats[0]} / {c.repeats[1]}",
            f"{c.change:+.1%}",
            f"{c.probability:.2g}",
            Text("slower", style="bold red") if c.worse else "",
        )
    return table


def _sentence(one: CostDifference) -> Text:
    """Return what changed of a compiled program: how much a cycle, and where."""
    means = [cost.total / cost.cycles for cost in (one.before, one.after)]
    places = [f"{r}: {_number(r.change / one.after.cycles, '+')}" for r in one.ranges]
    where = "; " + ", ".join(places) if places else ""
    text = (
        f"{_number(means[1] - means[0], '+')} instructions a cycle in {one.program}, "
        f"{_number(means[0])} -> {_number(means[1])}{where} ({one.test})"
    )
    return Text(text, style="bold red" if one.worse else "")


def _number(value: float, sign: str = "") -> str:
    """Return a number with its tenths, if it has some."""
    return f"{value:{sign},.1f}".removesuffix(".0")
