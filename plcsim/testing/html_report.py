"""The report of a run: one self-contained HTML page, and the same figures as JSON."""

from __future__ import annotations

import json
import platform
from html import escape
from typing import TYPE_CHECKING, Any

from plcsim.core.duration import format_duration
from plcsim.testing.calibration import REFERENCE_NS
from plcsim.testing.result import SCHEMA, other_result_of
from plcsim.testing.svg import histogram

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    import pytest

STYLE = """
:root { --ink: #1f2933; --soft: #6b7785; --line: #e3e7ec; --page: #f6f8fa;
  --good: #0b6e4f; --bad: #c81e1e; --skip: #8a6100 }
* { box-sizing: border-box }
body { margin: 0; background: var(--page); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif }
main { max-width: 1060px; margin: 0 auto; padding: 28px 20px 60px }
h1 { font-size: 24px; margin: 0 0 4px }
h3 { font-size: 13px; margin: 18px 0 6px; color: var(--soft); text-transform: uppercase;
  letter-spacing: .05em }
.soft { color: var(--soft) }
.tiles { display: flex; gap: 12px; flex-wrap: wrap; margin: 18px 0 24px }
.tile { background: white; border: 1px solid var(--line); border-radius: 8px; padding: 10px 18px }
.tile b { display: block; font-size: 22px; line-height: 1.2 }
.passed { color: var(--good) } .failed { color: var(--bad) } .skipped { color: var(--skip) }
details { background: white; border: 1px solid var(--line); border-radius: 8px; margin: 8px 0 }
details.failed { border-left: 4px solid var(--bad); color: inherit }
details.skipped { border-left: 4px solid var(--skip); color: inherit }
details.passed { border-left: 4px solid var(--good); color: inherit }
summary { padding: 10px 14px; cursor: pointer; display: flex; gap: 12px; align-items: baseline }
summary .name { flex: 1; overflow-wrap: anywhere; font-family: ui-monospace, Menlo, Consolas,
  "DejaVu Sans Mono", monospace; font-size: 13px }
.body { padding: 0 16px 16px }
.wide { overflow-x: auto }
.why { margin: 12px 0; overflow-wrap: anywhere }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums }
th { text-align: right; color: var(--soft); font-weight: 500 }
td, th { padding: 3px 14px 3px 0; text-align: right; white-space: nowrap }
td:first-child, th:first-child { text-align: left }
tr + tr td { border-top: 1px solid var(--line) }
pre { white-space: pre-wrap; background: var(--page); border-radius: 6px; padding: 12px;
  overflow-x: auto;
  font: 12px/1.45 ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace }
.charts { display: flex; gap: 20px; flex-wrap: wrap }
figure { margin: 0; overflow-x: auto } figcaption { font-size: 12px; color: var(--soft) }
svg { max-width: 100%; height: auto; display: block }
@media (max-width: 700px) {
  main { padding: 16px 8px 40px }
  .tile { flex: 1 1 40%; padding: 8px 12px }
  summary { flex-wrap: wrap; gap: 2px 12px; padding: 8px 12px }
  summary .name { flex: 1 1 100%; min-width: 0; order: 1 }
  .body { padding: 0 12px 12px }
  pre { padding: 8px; white-space: pre; font-size: 11px }
  .trace svg { max-width: none }
}
"""


class ReportWriter:
    """Collects the results of PLC tests; writes index.html and report.json at the end.

    Under pytest-xdist it lives in the controlling process, to which workers send the results.
    """

    def __init__(self, folder: Path, seed: int) -> None:
        self._folder = folder
        self._seed = seed
        self._results: list[dict[str, Any]] = []
        self._others: list[dict[str, Any]] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Take the result of a test, the outcome as it was judged at last."""
        result = getattr(report, "plc", None)
        if result is not None:
            message = report.longrepr if isinstance(report.longrepr, str) else result["message"]
            self._results.append(result | {"outcome": report.outcome, "message": message})
        elif report.when == "call" or not report.passed:
            self._others.append(other_result_of(report))

    def pytest_sessionfinish(self) -> None:
        """Write the report."""
        whole = {
            "schema": SCHEMA,
            "seed": self._seed,
            "python": platform.python_version(),
            "machine": platform.machine(),
            "reference_ns": REFERENCE_NS,
            "tests": self._results,
            "others": self._others,
        }
        self._folder.mkdir(parents=True, exist_ok=True)
        (self._folder / "report.json").write_text(json.dumps(whole, indent=1) + "\n", "utf-8")
        (self._folder / "index.html").write_text(page(whole), "utf-8")

    def pytest_terminal_summary(self, terminalreporter: Any) -> None:
        """Say where the report is."""
        terminalreporter.write_line(f"plcsim: report in {self._folder / 'index.html'}")


def page(whole: dict[str, Any]) -> str:
    """Return the report as HTML."""
    tests = sorted([*whole["tests"], *whole["others"]], key=lambda t: t["outcome"] != "failed")
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>PLC tests</title><style>{STYLE}</style></head><body><main>\n"
        f"{_head(whole)}\n{''.join(_test(test) for test in tests)}\n</main></body></html>\n"
    )


def _head(whole: dict[str, Any]) -> str:
    tests = whole["tests"]
    outcomes = [t["outcome"] for t in (*tests, *whole["others"])]
    counts = {outcome: outcomes.count(outcome) for outcome in ("passed", "failed", "skipped")}
    simulated_ns = sum(t["time_ns"] for t in tests)
    loops = [t["calibration_ns"] for t in tests if t["calibration_ns"]]
    tiles = [_tile(str(n), outcome, outcome) for outcome, n in counts.items()]
    tiles.append(_tile(format_duration(simulated_ns), "of PLC time"))
    if loops:
        slow = sorted(loops)[len(loops) // 2] / whole["reference_ns"]
        tiles.append(_tile(f"{slow:.2f}", "times the reference machine's CPU time"))
    return (
        "<h1>PLC tests</h1>"
        f'<div class="soft">plcsim, Python {whole["python"]} on {whole["machine"]}, '
        f"seed {whole['seed']}</div>"
        f'<div class="tiles">{"".join(tiles)}</div>'
    )


def _tile(figure: str, text: str, kind: str = "") -> str:
    return f'<div class="tile"><b class="{kind}">{escape(figure)}</b>{escape(text)}</div>'


def _test(test: dict[str, Any]) -> str:
    outcome = test["outcome"]
    opened = " open" if outcome == "failed" else ""
    has_controller = "clock" in test
    parts = [_message(test), _of_controller(test) if has_controller else ""]
    clock = f"{format_duration(test['time_ns'])}, {test['clock']} clock" if has_controller else ""
    verdict = test.get("verdict") or outcome
    return (
        f'<details class="{outcome}"{opened}><summary>'
        f'<span class="{outcome}">{escape(verdict)}</span>'
        f'<span class="name">{escape(test["test"])}</span>'
        f'<span class="soft">{clock or "without a controller"}</span>'
        f'</summary><div class="body">{"".join(parts)}</div></details>\n'
    )


def _of_controller(test: dict[str, Any]) -> str:
    """Return what the controller of a test did."""
    parts = [_classes(test["task_classes"]), _programs(test["programs"])]
    parts += [_heaps(test["heaps"]), _violations(test["violations"]), _traces(test["traces"])]
    return "".join(parts)


def _message(test: dict[str, Any]) -> str:
    """Return why a test ended as it did: the line, what was wrong, the last cycles."""
    if not test["message"]:
        return ""
    parts = []
    if test["source"]:
        location = f'<span class="soft">{escape(test["location"])}</span>'
        parts.append(f"<pre>{location}\n<b>{escape(test['source'])}</b></pre>")
    why, _, rest = test["message"].partition("\n")
    parts.append(f'<p class="why">{escape(why)}</p>')
    text = "\n\n".join(filter(None, (rest, test.get("explanation", ""))))
    if text:
        parts.append(f"<pre>{escape(text)}</pre>")
    return "".join(parts)


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    head = "".join(f"<th>{escape(text)}</th>" for text in heads)
    body = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><tr>{head}</tr>{body}</table>"


def _classes(classes: Sequence[dict[str, Any]]) -> str:
    heads = ("task class", "cycle", "cycles", "missed", "violations", "late p99", "late max",
             "response p99", "response max")  # fmt: skip
    rows = [
        (
            f"#{c['number']}",
            format_duration(c["cycle_ns"]),
            str(c["cycles"]),
            str(c["missed_grid_points"]),
            str(sum(c["violations"].values())),
            format_duration(c["lateness_ns"]["p99"]),
            format_duration(c["lateness_ns"]["maximum"]),
            format_duration(c["response_ns"]["p99"]),
            format_duration(c["response_ns"]["maximum"]),
        )
        for c in classes
    ]
    return f'<h3>Task classes</h3><div class="wide">{_table(heads, rows)}</div>'


def _programs(programs: Sequence[dict[str, Any]]) -> str:
    if not programs:
        return ""
    charts = "".join(
        f"<figure>{histogram([tuple(b) for b in p['histogram']])}"
        f"<figcaption>{escape(p['name'])}: CPU time of {p['cycles']} cycles, "
        f"p50 {format_duration(p['cpu_ns']['p50'])}, p99 {format_duration(p['cpu_ns']['p99'])}, "
        f"max {format_duration(p['cpu_ns']['maximum'])}</figcaption></figure>"
        for p in programs
    )
    return f'<h3>Execution time</h3><div class="charts">{charts}</div>{_instructions(programs)}'


def _with_commas(number: int) -> str:
    return f"{number:,}"


def _instructions(programs: Sequence[dict[str, Any]]) -> str:
    """Return what compiled programs cost, exactly."""
    counted = [(p["name"], p["cycles"], p["instructions"]) for p in programs if p["instructions"]]
    if not counted:
        return ""
    charts = "".join(
        f"<figure>{histogram([tuple(b) for b in i['histogram']], text_of=_with_commas)}"
        f"<figcaption>{escape(name)}: instructions of {cycles} cycles, p50 {i['p50']:,}, "
        f"p99 {i['p99']:,}, max {i['maximum']:,} in cycle {i['maximum_cycle']:,}</figcaption>"
        "</figure>"
        for name, cycles, i in counted
    )
    return f'<h3>Instructions</h3><div class="charts">{charts}</div>'


def _heaps(heaps: Sequence[dict[str, Any]]) -> str:
    """Return what is on the heaps of programs and libraries at the end of a test."""
    if not heaps:
        return ""
    figures = ("size_bytes", "most_bytes", "used_bytes", "areas", "refused")
    heads = ("heap of", "bytes", "most in use", "not freed", "in areas", "requests refused")
    rows = [(heap["name"], *(f"{heap[figure]:,}" for figure in figures)) for heap in heaps]
    return f'<h3>Heaps</h3><div class="wide">{_table(heads, rows)}</div>'


def _violations(violations: Sequence[dict[str, Any]]) -> str:
    if not violations:
        return ""
    rows = [
        (f"#{v['task_class']}", str(v["cycle"]), format_duration(v["release_ns"]), v["text"])
        for v in violations
    ]
    table = _table(("class", "cycle", "time", ""), rows)
    return f'<h3>Cycle time violations</h3><div class="wide">{table}</div>'


def _traces(traces: Sequence[dict[str, Any]]) -> str:
    if not traces:
        return ""
    figures = (f'<figure class="trace">{trace["svg"]}</figure>' for trace in traces)
    return "<h3>Traces</h3>" + "".join(figures)
