"""What the plugin does for PLC tests: open the controller, judge the test, say what happened."""

from __future__ import annotations

import re
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from pathlib import Path
from random import SystemRandom
from typing import TYPE_CHECKING, Any

import pytest
from _pytest.runner import runtestprotocol

from plcsim.core.duration import parse_duration_ns
from plcsim.core.errors import PlcError
from plcsim.host.realtime import sharpen_timers
from plcsim.testing.budget import (
    MOST_RUNS,
    CycleMeasurement,
    breaches,
    budget_of,
    describe_breaches,
)
from plcsim.testing.calibration import REFERENCE_NS, Calibration
from plcsim.testing.costs import overhead_ns
from plcsim.testing.errors import ExpectationFailed, PlcTestError
from plcsim.testing.html_report import ReportWriter
from plcsim.testing.instructions import exceeded
from plcsim.testing.plc import Plc
from plcsim.testing.realtime import RealtimeVerdict, figures, judge
from plcsim.testing.result import EXPLANATION, properties_of, result_of
from plcsim.testing.target import find_project, program_target, project_target
from st_types.errors import TypeSystemError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.project.assembly import Application
    from plcsim.testing.trace import Trace

__tracebackhide__ = True

PLC: pytest.StashKey[Plc] = pytest.StashKey()
CALIBRATION: pytest.StashKey[Calibration] = pytest.StashKey()
MEASUREMENT: pytest.StashKey[CycleMeasurement] = pytest.StashKey()

AROUND = 20
"""Runs of the calibration loop before a test, so that a short one has some too."""


# --- options ---


def configure(config: pytest.Config) -> None:
    """Draw the seed where it is to be random; prepare the report."""
    if config.getoption("--plc-seed") == "random":
        config.option.plc_seed = str(SystemRandom().randrange(1 << 31))
    seed_of(config)
    if config.getoption("--plc-lines"):
        _count_lines(config)
    folder = config.getoption("--plc-report")
    if folder and not hasattr(config, "workerinput"):
        config.pluginmanager.register(ReportWriter(Path(folder), seed_of(config)), "plcsim-report")


def _count_lines(config: pytest.Config) -> None:
    """Compile programs with counters for the lines, until the run ends."""
    if not config.getoption("--plc-report"):
        raise pytest.UsageError("--plc-lines: goes with --plc-report DIR, which tells them")
    measuring = import_module("plcsim.program.structured_text.coverage").MEASURING
    was_on = measuring.is_on
    measuring.is_on = True
    config.add_cleanup(lambda: setattr(measuring, "is_on", was_on))


def seed_of(config: pytest.Config) -> int:
    """Return the seed of the run."""
    text = config.getoption("--plc-seed")
    if not text.isdecimal():
        raise pytest.UsageError(f"--plc-seed: {text!r} is neither a number nor random")
    return int(text)


def reference_ns(config: pytest.Config) -> int:
    """Return the CPU time of the calibration loop on the reference machine."""
    text = config.getini("plc_calibration")
    try:
        return parse_duration_ns(text) if text else REFERENCE_NS
    except ValueError as err:
        raise pytest.UsageError(f"plc_calibration: {err}") from None


# --- the fixture ---


@contextmanager
def plain_errors() -> Iterator[None]:
    """Let what is wrong with the project or the marker end the test with its text alone."""
    try:
        yield
    except (PlcError, TypeSystemError, ExpectationFailed) as err:
        notes = getattr(err, "__notes__", [])
        pytest.fail("\n\n".join([str(err), *notes]), pytrace=False)


def open_for(request: pytest.FixtureRequest, seed_step: int) -> Iterator[Plc]:
    """Open the controller of a test; it is closed afterwards, also where an INIT failed."""
    item, config = request.node, request.config
    with plain_errors():
        marker = _marker_of(item)
        target = _target_of(item, marker)
        realtime = item.get_closest_marker("realtime") is not None
        plc = Plc(
            target,
            seed=seed_of(config) + seed_step,
            realtime=realtime,
            host_network=marker.get("network", "virtual") == "host",
            task_class=marker.get("task_class"),
        )
        item.stash[PLC] = plc
        request.addfinalizer(partial(_close, plc, target))
        _calibrate(item, plc)
        if realtime:
            sharpen_timers()
        if marker.get("boot", True):
            plc.boot()
    yield plc


def _close(plc: Plc, target: Application) -> None:
    """Run the EXITs and forget the project, whatever came before."""
    with plain_errors():
        try:
            plc.close()
        finally:
            target.unload()


def _marker_of(item: pytest.Item) -> dict[str, Any]:
    """Return the keyword arguments of the marker plc, those of the class and the module included.

    Raises:
        PlcTestError: an argument is unknown or wrong.
    """
    merged: dict[str, Any] = {}
    for marker in reversed(list(item.iter_markers("plc"))):
        merged |= marker.kwargs
        if marker.args:
            raise PlcTestError(f"@pytest.mark.plc: name the argument: project={marker.args[0]!r}")
    known = ("project", "program", "task_class", "cycle", "seeds", "network", "boot", "config")
    for name in merged:
        if name not in known:
            raise PlcTestError(f"@pytest.mark.plc: unknown argument {name}; known: {known}")
    if "project" in merged and "program" in merged:
        raise PlcTestError("@pytest.mark.plc: give either a project or a program")
    if merged.get("network", "virtual") not in ("virtual", "host"):
        raise PlcTestError(f"@pytest.mark.plc: network is virtual or host, not {merged['network']}")
    return merged


def _target_of(item: pytest.Item, marker: dict[str, Any]) -> Application:
    if "program" in marker:
        given = marker["program"]
        programs = given if isinstance(given, list | tuple) else [given]
        return program_target(programs, marker.get("cycle", "10ms"), marker.get("task_class", 1))
    start, option = item.path.parent, item.config.getoption
    folder = start / marker["project"] if "project" in marker else find_project(start)
    return project_target(
        folder,
        marker.get("config") or option("--plc-config"),
        keep_going=option("--plc-keep-going"),
    )


def _calibrate(item: pytest.Item, plc: Plc) -> None:
    """Measure the speed of the machine where somebody will ask for it."""
    wanted = item.config.getoption("--plc-report") or item.get_closest_marker("cycle_budget")
    if not wanted:
        return
    calibration = item.stash[CALIBRATION] = Calibration()
    calibration.measure(AROUND)
    if not plc.realtime:
        plc.after_cycle.append(lambda: calibration.after_cycle(plc.costs))


# --- budgets ---


def run_with_budget(item: pytest.Item, nextitem: pytest.Item | None) -> bool:
    """Run a test until its budget holds, at most `MOST_RUNS` times, and report it once."""
    item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
    measured = item.stash[MEASUREMENT] = CycleMeasurement()
    verdict = ""
    properties = list(item.user_properties)
    for _ in range(MOST_RUNS):
        item.user_properties[:] = properties
        if measured.runs:
            item._initrequest()  # type: ignore[attr-defined]  # of Function items only
        reports = runtestprotocol(item, nextitem=nextitem, log=False)
        if not all(report.passed for report in reports):
            break
        exact = _judge_instructions(item)
        verdict = exact or _judge_budget(item, measured)
        if exact or not verdict:
            break
    for report in reports:
        if report.when == "call" and report.passed and verdict:
            report.outcome, report.longrepr = "failed", verdict
        item.ihook.pytest_runtest_logreport(report=report)
    item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
    return True


def _judge_instructions(item: pytest.Item) -> str:
    """Return why a budget in instructions does not hold, "" where all do: they need one run."""
    plc = item.stash.get(PLC, None)
    if plc is None:
        return ""
    try:
        budgets = [budget_of(marker.kwargs) for marker in item.iter_markers("cycle_budget")]
        counted = plc.costs.instructions
        found = [
            text
            for budget in budgets
            if budget.instructions
            for text in exceeded(counted, budget.instructions, budget.program, "cycle_budget")
        ]
    except PlcTestError as err:
        return str(err)
    return "\n".join(found)


def _judge_budget(item: pytest.Item, measured: CycleMeasurement) -> str:
    """Return why the budget does not hold, "" where it does."""
    plc, calibration = item.stash.get(PLC, None), item.stash.get(CALIBRATION, None)
    if plc is None or calibration is None:
        return "cycle_budget: the test does not use the fixture plc"
    if plc.realtime:
        return "cycle_budget: a realtime test cannot be repeated exactly; use the virtual clock"
    reference = reference_ns(item.config)
    own_ns = overhead_ns()
    try:
        costs = {p: [max(0, c - own_ns) for c in ns] for p, ns in plc.costs.measured_ns.items()}
        measured.add(costs, calibration.samples_ns)
        found = [
            breach
            for marker in item.iter_markers("cycle_budget")
            for breach in breaches(budget_of(marker.kwargs), measured, reference)
        ]
    except PlcTestError as err:
        return str(err)
    return describe_breaches(found, measured, reference) if found else ""


# --- results ---


def complete(item: pytest.Item, call: pytest.CallInfo[None], report: pytest.TestReport) -> None:
    """Add to a report what the controller did: tables, files, figures, the verdict on the host."""
    plc = item.stash.get(PLC, None)
    if plc is None or report.when == "teardown" or (report.when == "setup" and report.passed):
        return
    current = plc.latest
    traces = [*current.traces]
    if report.failed:
        try:
            traces = _traces_of_failure(call, current)
            _explain(item, call, report, current, traces)
        except Exception as err:  # a failing test must be reported, whatever its tags are like
            report.sections.append((EXPLANATION, f"the failure could not be explained: {err!r}"))
    if plc.realtime and report.when == "call":
        _apply_verdict(item, report, plc)
    shown = traces if item.config.getoption("--plc-report") else []
    result = result_of(item, report, current, item.stash.get(CALIBRATION, None), shown)
    item.user_properties.extend(properties_of(result))
    report.plc = result  # type: ignore[attr-defined]  # travels with the report
    _shorten_summary(call, report)


def _shorten_summary(call: pytest.CallInfo[None], report: pytest.TestReport) -> None:
    """Let pytest's summary say in one line what was expected, not its class and its table."""
    crash = getattr(report.longrepr, "reprcrash", None)
    error = call.excinfo.value if call.excinfo else None
    if crash is not None and isinstance(error, ExpectationFailed | PlcError):
        crash.message = str(error)


def _tags_of(call: pytest.CallInfo[None], plc: Plc) -> tuple[str, ...]:
    """Return the tags that a failure is about, or those that were read last."""
    error = call.excinfo.value if call.excinfo else None
    return error.tags if isinstance(error, ExpectationFailed) else tuple(plc.recent())


def _traces_of_failure(call: pytest.CallInfo[None], plc: Plc) -> list[Trace]:
    """Return what the test recorded, and the last cycles of the tags that the failure is about."""
    leaves = [leaf for path in _tags_of(call, plc) for leaf in plc.tags.leaves(path)]
    recorded = {tag.path.upper() for trace in plc.traces for tag in trace.tags}
    traces = [*plc.traces]
    if any(leaf.path.upper() not in recorded for leaf in leaves):
        traces.append(plc.history.trace(leaves))
    return [trace for trace in traces if trace.tags and trace.rows]


def _explain(
    item: pytest.Item,
    call: pytest.CallInfo[None],
    report: pytest.TestReport,
    plc: Plc,
    traces: list[Trace],
) -> None:
    """Add the last cycles where the exception does not bring them, the files, the seed."""
    lines = []
    if plc.interleaving is not None:
        lines.append(f"interleaving: {plc.interleaving}")
    own = call.excinfo is not None and isinstance(call.excinfo.value, ExpectationFailed)
    cycles = plc.explain(_tags_of(call, plc))
    if cycles and not own:
        lines.append(cycles)
    lines += _saved(item, traces, str(call.excinfo.value) if own and call.excinfo else "")
    if plc.used_chance:
        lines.append(f"chance was in it: repeat with --plc-seed={plc.seed}")
    if lines:
        report.sections.append((EXPLANATION, "\n".join(lines)))


def _saved(item: pytest.Item, traces: list[Trace], failure: str) -> list[str]:
    """Save the traces of a failed test; return a line for each."""
    folder = _trace_folder(item.config)
    if folder is None:
        return []
    name = re.sub(r"[^\w.+-]+", "_", item.nodeid.rpartition("/")[2])
    lines = []
    for index, trace in enumerate(traces):
        suffix = f"-{index + 1}" if len(traces) > 1 else ""
        try:
            files = trace.save(folder, name + suffix, item.name, failure)
        except OSError as err:
            return [f"the trace could not be saved: {err}"]
        lines.append(f"trace: {_short(files[0])} and {files[1].name}")
    return lines


def _short(path: Path) -> Path:
    """Return a path relative to the working directory where it lies below it."""
    here = Path.cwd()
    return path.relative_to(here) if path.is_relative_to(here) else path


def _trace_folder(config: pytest.Config) -> Path | None:
    """Return where traces go: beside the report, else into pytest's cache."""
    report = config.getoption("--plc-report")
    if report:
        return Path(report) / "traces"
    cache = getattr(config, "cache", None)
    if cache is None:
        return None
    folder: Path = cache.mkdir("plcsim")
    return folder


def _apply_verdict(item: pytest.Item, report: pytest.TestReport, plc: Plc) -> None:
    verdict = judge(plc.controller, failed=report.failed)
    report.plc_verdict = verdict.value  # type: ignore[attr-defined]  # for result_of
    if verdict is RealtimeVerdict.HOST:
        text = f"host could not hold the tick: {figures(plc.controller)}"
        if item.config.getoption("--require-realtime"):
            report.outcome, report.longrepr = "failed", text
        else:
            path, line, _ = item.location
            report.outcome = "skipped"
            report.longrepr = (path, (line or 0) + 1, f"Skipped: {text}")
    elif verdict is RealtimeVerdict.FAILED and report.passed:
        report.outcome = "failed"
        report.longrepr = f"failed by the program: {figures(plc.controller)}"
