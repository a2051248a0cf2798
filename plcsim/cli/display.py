"""What `plcsim run` shows: a live table on a terminal, a summary at the end."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from rich.console import Console, Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from plcsim.duration import format_duration

if TYPE_CHECKING:
    from plcsim.project import Project
    from plcsim.status_page import StatusPage

PERIOD_S = 0.25

_STATE_STYLES = {"BOOT": "yellow", "RUN": "green", "SERVICE": "bold red", "STOPPED": "cyan"}


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in columns:
        last = column == "programs"
        table.add_column(column, justify="left" if last else "right", no_wrap=not last)
    return table


def _pair(first_ns: int, second_ns: int) -> str:
    return f"{format_duration(first_ns)} / {format_duration(second_ns)}"


class LiveTable:
    """A table that is drawn anew every quarter of a second, by a thread of the parent process.

    A thread, so that a terminal that does not take output cannot stop the watchdog. Nothing is
    shown where stderr is not a terminal.
    """

    def __init__(self, project: Project, page: StatusPage) -> None:
        self._project = project
        self._page = page
        self._console = Console(stderr=True)
        self._done = threading.Event()
        self._thread = threading.Thread(target=self._draw, daemon=True)

    def __enter__(self) -> LiveTable:
        if self._console.is_terminal:
            self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._done.set()
        if self._thread.is_alive():
            self._thread.join(2 * PERIOD_S)

    def _draw(self) -> None:
        with Live(
            console=self._console, auto_refresh=False, transient=True, redirect_stdout=False
        ) as live:
            while not self._done.wait(PERIOD_S):
                live.update(self._picture(), refresh=True)

    def _picture(self) -> Group:
        state = self._page.state.name
        elapsed = f"{self._page.elapsed_ns / 1e9:.1f} s"
        head = Text.assemble(
            (self._project.name, "bold"), "  ", (state, _STATE_STYLES[state]), f"  {elapsed}"
        )
        table = _table(
            "class", "cycle", "cycles", "missed", "viol.", "exec. / max", "late / max",
            "programs",
        )  # fmt: skip
        for c in self._project.classes:
            s = self._page.of_class(c.number)
            table.add_row(
                f"#{c.number}",
                format_duration(c.cycle_ns),
                str(s.cycles),
                str(s.missed),
                str(s.violations),
                _pair(s.execution_ns, s.longest_execution_ns),
                _pair(s.lateness_ns, s.longest_lateness_ns),
                ", ".join(p.name for p in c.programs),
            )
        return Group(head, table)


def print_summary(result: dict[str, Any]) -> None:
    """Print how a run ended: state, task classes, fault, logbook."""
    console = Console(stderr=True, highlight=False)
    state = result["state"]
    elapsed = format_duration(result["elapsed_ns"])
    rights = ", ".join(result.get("realtime_rights", ())) or "no real-time rights"
    clock = "virtual clock" if result.get("clock") == "virtual" else rights
    console.print(
        Text.assemble(
            (result["project"], "bold"),
            "  ",
            (state, _STATE_STYLES[state]),
            f"  after {elapsed}  ({clock})",
        )
    )
    if result["task_classes"]:
        console.print(_summary_table(result["task_classes"]))
        if blame := _blame(result["task_classes"]):
            console.print(blame)
    if result["fault"]:
        fault = Text(f"SERVICE: {_fault_text(result['fault'])}", style="bold red")
        console.print(fault, soft_wrap=True)  # so that no file name is cut
    entries = [e for e in result["logbook"] if e["severity"] != "information"]
    for entry in entries[-10:]:
        seconds = f"{entry['time_ns'] / 1e9:.6f}"
        text = Text(f"{seconds:>13} s  {entry['source']}: {entry['text']}")
        console.print(text, soft_wrap=True)
    if len(entries) > 10:
        console.print(f"... and {len(entries) - 10} earlier entries; --report FILE keeps them")


def _summary_table(classes: list[dict[str, Any]]) -> Table:
    table = _table(
        "class", "cycle", "cycles", "missed", "viol.", "exec. p50 / p99", "late p50 / p99",
        "programs",
    )  # fmt: skip
    for c in classes:
        violations = c["violations"]
        table.add_row(
            f"#{c['number']}",
            format_duration(c["cycle_ns"]),
            str(c["cycles"]),
            str(c["missed_grid_points"]),
            str(sum(violations.values())),
            _pair(c["execution_ns"]["p50"], c["execution_ns"]["p99"]),
            _pair(c["lateness_ns"]["p50"], c["lateness_ns"]["p99"]),
            ", ".join(p["name"] for p in c["programs"]),
        )
    return table


def _blame(classes: list[dict[str, Any]]) -> str:
    """Return how many violations there were by cause, "" where there were none."""
    causes = ("program", "host", "preempted")
    counts = {cause: sum(c["violations"][cause] for c in classes) for cause in causes}
    if not any(counts.values()):
        return ""
    return "violations by cause: " + ", ".join(f"{cause} {n}" for cause, n in counts.items())


def _fault_text(fault: dict[str, Any]) -> str:
    if fault["kind"] == "cycle_time_violation":
        return f"task class {fault['task_class']}: {fault['text']}"
    place = f" ({fault['place']})" if fault["place"] else ""
    return f"{fault['program']} {fault['unit']}".rstrip() + f": {fault['text']}{place}"
