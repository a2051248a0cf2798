"""What `plcsim run` shows: a live table on a terminal, a summary at the end."""

from __future__ import annotations

import linecache
from typing import TYPE_CHECKING, Any

from rich.console import Group
from rich.table import Table
from rich.text import Text

from plcsim.cli.console import CommandConsole
from plcsim.cli.live_logbook import is_by_host, line_of
from plcsim.core.duration import format_duration
from plcsim.core.text import escaped
from plcsim.project.extension import extensions
from plcsim.shared_image.status_page import ServiceState

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Mapping

    from plcsim.project.plc_toml import Project
    from plcsim.shared_image.status_page import StatusPage

_STATE_STYLES = {"BOOT": "yellow", "RUN": "green", "SERVICE": "bold red", "STOPPED": "cyan"}


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in columns:
        table.add_column(column, justify="right", no_wrap=True)
    return table


def _pair(first_ns: int, second_ns: int) -> str:
    return f"{format_duration(first_ns)} / {format_duration(second_ns)}"


def _programs(number: int, names: Iterable[str]) -> Text:
    """Return a line below the table: as a column, names would not fit into 80 columns."""
    return Text(escaped(f"#{number}: {', '.join(names)}"))


class LiveTable:
    """The table of a run as it is now.

    Args:
        project: what runs.
        page: its status page.
        for_ns: when the run ends, on the controller's clock; None for never.
        services: gives how the services do, by table.
        hint: what a person can do meanwhile.
    """

    def __init__(
        self,
        project: Project,
        page: StatusPage,
        for_ns: int | None = None,
        services: Callable[[], Mapping[str, ServiceState]] = dict,
        hint: str = "",
    ) -> None:
        self._project = project
        self._page = page
        self._goal = "" if for_ns is None else f" of {format_duration(for_ns)}"
        self._services = services
        self._hint = Text(hint, style="dim")

    def picture(self) -> Group:
        """Return state, time, task classes, services and the hint."""
        state = self._page.state.name
        elapsed = f"{self._page.elapsed_ns / 1e9:.1f} s{self._goal}"
        head = Text.assemble(
            (escaped(self._project.name), "bold"),
            "  ",
            (state, _STATE_STYLES[state]),
            f"  {elapsed}",
        )
        table = _table("class", "cycle", "cycles", "missed", "viol.", "exec. / max", "late / max")
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
            )
        names = (_programs(c.number, (p.name for p in c.programs)) for c in self._project.classes)
        return Group(head, table, *names, *self._lines_of_services(), self._hint)

    def _lines_of_services(self) -> Iterator[Text]:
        for name, state in self._services().items():
            where = extensions()[name].endpoint(self._project.extensions[name])
            style = "bold red" if state is ServiceState.FAILING else ""
            yield Text.assemble(f"[{name}] ", (state.name.lower(), style), f"  {escaped(where)}")


def print_summary(
    result: dict[str, Any], shown: Collection[tuple[int, str, str]] = frozenset()
) -> None:
    """Print how a run ended: state, task classes, fault, logbook.

    Args:
        result: the report.
        shown: entries of the logbook that were printed meanwhile, as (time_ns, source, text).
    """
    console = CommandConsole(stderr=True)
    state = result["state"]
    elapsed = format_duration(result["elapsed_ns"])
    rights = ", ".join(result.get("realtime_rights", ())) or "no real-time rights"
    clock = "virtual clock" if result.get("clock") == "virtual" else rights
    console.print(
        Text.assemble(
            (escaped(result["project"]), "bold"),
            "  ",
            (state, _STATE_STYLES[state]),
            f"  after {elapsed}  ({clock})",
        ),
        soft_wrap=True,
    )
    if result["task_classes"]:
        console.print(_summary_table(result["task_classes"]))
        for c in result["task_classes"]:
            console.print(_programs(c["number"], (p["name"] for p in c["programs"])))
        if blame := _blame(result["task_classes"]):
            console.print(blame)
    fault = _fault_text(result["fault"]) if result["fault"] else ""
    if fault:
        text = Text(escaped(f"SERVICE: {fault}"), style="bold red")
        console.print(text, soft_wrap=True)  # so that no file name is cut
        console.print(source_line(result["fault"]["location"]), end="", soft_wrap=True)
    for line in lines_of_heaps(result):
        console.print(Text(line), soft_wrap=True)
    entries = [
        e
        for e in result["logbook"]
        if e["severity"] != "information"
        and not fault.endswith(e["text"])
        and not is_by_host(e["source"], e["text"])
        and (e["time_ns"], e["source"], e["text"]) not in shown
    ]
    for entry in entries[-10:]:
        line = line_of(entry["time_ns"], entry["source"], entry["text"])
        console.print(Text(line), soft_wrap=True)
    if lost := result.get("output_lost_bytes"):
        console.print(f"{lost:,} bytes that were printed are lost: nobody took them in time")
    if len(entries) > 10:
        console.print(f"... and {len(entries) - 10} earlier entries; --report FILE keeps them")


def lines_of_heaps(result: dict[str, Any]) -> Iterator[str]:
    """Yield which programs and libraries in C left something on their heaps, or had no room."""
    for heap in result.get("heaps", ()):
        name = f"{escaped(heap['name'])}: heap of {heap['size_bytes']:,} bytes"
        if heap["areas"] and result["state"] == "STOPPED":
            areas = "1 area" if heap["areas"] == 1 else f"{heap['areas']:,} areas"
            yield f"{name}: {areas} with {heap['used_bytes']:,} bytes not freed at the end"
        if heap["refused"]:
            requests = "1 request" if heap["refused"] == 1 else f"{heap['refused']:,} requests"
            yield f"{name}: no room for {requests}; most in use: {heap['most_bytes']:,} bytes"


def _summary_table(classes: list[dict[str, Any]]) -> Table:
    table = _table(
        "class", "cycle", "cycles", "missed", "viol.", "exec. p50 / p99", "late p50 / p99"
    )
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
        )
    return table


def _blame(classes: list[dict[str, Any]]) -> str:
    """Return how many violations there were by cause, "" where there were none."""
    counts: dict[str, int] = {}
    for c in classes:
        for cause, count in c["violations"].items():
            counts[cause] = counts.get(cause, 0) + count
    if not any(counts.values()):
        return ""
    text = ", ".join(f"{cause} {count}" for cause, count in counts.items())
    why = "; plcsim doctor says why the host is late" if counts["host"] else ""
    return f"violations by cause: {text}{why}"


def source_line(location: str) -> str:
    """Return the line of a program at "file:line", with its number; "" where there is none."""
    file, _, number = location.rpartition(":")
    line = linecache.getline(file, int(number)) if number.isdecimal() else ""
    return f"{number:>6} | {line.rstrip()}\n" if line else ""


def _fault_text(fault: dict[str, Any]) -> str:
    if fault["kind"] == "cycle_time_violation":
        return f"task class {fault['task_class']}: {fault['text']}"
    location = f" ({fault['location']})" if fault["location"] else ""
    return f"{fault['program']} {fault['unit']}".rstrip() + f": {fault['text']}{location}"
