"""What ``plcsim check`` shows of an Automation Studio project."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from rich.table import Table

from plcsim.core.duration import format_duration

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from plcsim.cli.console import CommandConsole
    from plcsim.project.automation_studio.reader import AutomationStudioProject
    from plcsim.project.automation_studio.stub_calls import StubCall
    from plcsim.project.survey import Survey, TaskRow

MOST_LINES: Final = 5
"""Lines of each kind that are shown without ``--all``."""

MOST_NAMES: Final = 4
"""Idle blocks of a library that are named without ``--all``."""


def show(
    console: CommandConsole,
    found: AutomationStudioProject,
    survey: Survey,
    *,
    everything: bool,
) -> None:
    """Print what runs, what is idle and what cannot run.

    Args:
        console: to print on.
        found: the project as it was read.
        survey: of it.
        everything: all findings, and all of each.
    """
    _Sheet(console, found, survey, everything=everything).show()


class _Sheet:
    """What is printed; paths begin at the project's folder."""

    def __init__(
        self,
        console: CommandConsole,
        found: AutomationStudioProject,
        survey: Survey,
        *,
        everything: bool,
    ) -> None:
        self._console = console
        self._found = found
        self._survey = survey
        self._everything = everything
        self._folder = f"{found.folder.resolve()}{os.sep}"
        self._named = f"{found.folder}{os.sep}"

    def show(self) -> None:
        survey, print_ = self._survey, self._console.print
        print_(_title(self._found), soft_wrap=True)
        for line in _tasks(survey):
            print_(line, soft_wrap=True)
        self._list("cannot run", self._reasons())
        if survey.stubs:
            print_("\nstubs, for nothing executes them here (idle, or simulated by a table):")
            print_(self._stubs())
        self._list("wrong in what several programs see", survey.common)
        self._list("no controller", survey.trouble)
        self._list("wrong in the project's files", map(str, survey.findings))
        self._list("wrong in the maps", survey.unmapped)
        self._list("wrong in plc.toml", survey.settings)
        if self._everything:
            self._list("warnings", survey.warnings)
        print_()
        for line in self._summary():
            print_(line, soft_wrap=True)

    def _short(self, text: str) -> str:
        return text.replace(self._folder, "").replace(self._named, "")

    def _list(self, title: str, texts: Iterable[str]) -> None:
        lines = [self._short(text) for text in texts]
        if not lines:
            return
        most = len(lines) if self._everything else MOST_LINES
        self._console.print(f"\n{title}:")
        for line in lines[:most]:
            text = line if self._everything else line.splitlines()[0]
            self._console.print(f"  {text}", soft_wrap=True)
        if len(lines) > most:
            self._console.print(f"  ... and {len(lines) - most} more; --all shows them")

    def _reasons(self) -> Iterator[str]:
        for row in self._survey.rows:
            if row.reasons and self._everything:
                yield from (f"{row.entry.name}: {reason}" for reason in row.reasons)
            elif row.reasons:
                more = f" (and {len(row.reasons) - 1} more)" if len(row.reasons) > 1 else ""
                yield f"{row.entry.name}: {row.reasons[0].splitlines()[0]}{more}"

    def _stubs(self) -> Table:
        """Return a table of the idle blocks and functions, by library."""
        table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 2))
        for column in ("library", "blocks and functions", "in", "first"):
            table.add_column(column)
        by_library: dict[str, list[StubCall]] = {}
        for call in self._survey.stubs:
            by_library.setdefault(call.library, []).append(call)
        for library, found in sorted(by_library.items(), key=lambda item: -len(item[1])):
            names = [*dict.fromkeys(call.name for call in found)]
            programs = [*dict.fromkeys(call.program.rpartition(".")[2] for call in found)]
            first = self._short(found[0].location)
            table.add_row(library, self._some(names), self._some(programs), first)
        return table

    def _some(self, names: Sequence[str]) -> str:
        most = len(names) if self._everything else MOST_NAMES
        more = f" and {len(names) - most} more" if len(names) > most else ""
        return ", ".join(names[:most]) + more

    def _summary(self) -> Iterator[str]:
        survey = self._survey
        cannot = sum(1 for row in survey.rows if row.reasons)
        runs = len(survey.rows) - cannot
        memory = ""
        if survey.controller is not None:
            used, size = survey.controller.memory.used, survey.controller.memory.size
            memory = f", {used} of {size} bytes of PLC memory used"
        tick = format_duration(survey.project.plc.tick_ns)
        yield f"{runs} of {len(survey.rows)} tasks run{memory}, tick {tick}"
        if survey.skipped:
            yield f"skipped or disabled: {', '.join(survey.skipped)}"
        if cannot:
            yield "plcsim run --keep-going runs the others; [as] skip in plc.toml takes tasks out"
        if survey.warnings and not self._everything:
            yield f"{len(survey.warnings)} warnings about the sources; --all shows them"


def _title(found: AutomationStudioProject) -> str:
    others = [name for name in found.configurations if name != found.configuration.name]
    more = f"; --config takes {', '.join(others)}" if others else ""
    cpu = found.configuration.hardware.cpu_type or "no CPU found"
    return (
        f"{found.name} in {found.folder}: configuration {found.configuration.name} ({cpu}){more}\n"
    )


def _tasks(survey: Survey) -> Iterator[str]:
    """Yield the lines of a table of the tasks: hundreds of them are common."""
    rows = [("class", "cycle", "tolerance", "task", "program", "language", "bytes", "")]
    rows += (
        (
            f"#{row.task_class.number}",
            format_duration(row.task_class.cycle_ns),
            format_duration(row.task_class.tolerance_ns),
            row.entry.name,
            row.entry.source,
            ", ".join(row.languages),
            "" if row.reasons else str(row.bytes),
            _state(row),
        )
        for row in survey.rows
    )
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    sides = (*">>>", *"<<<", ">", "<")
    for row in rows:
        cells = zip(row, sides, widths, strict=True)
        yield "  ".join(f"{cell:{side}{width}}" for cell, side, width in cells).rstrip()


def _count(stubs: Sequence[StubCall]) -> str:
    return f"{len(stubs)} stub" + "s" * (len(stubs) != 1)


def _state(row: TaskRow) -> str:
    if row.reasons:
        return "cannot run"
    return f"runs, {_count(row.stubs)}" if row.stubs else "runs"
