"""The pytest plugin, on wherever plcsim is installed.

It is imported in every run of pytest, so it imports nothing large of plcsim before a test asks for
the fixture ``plc``. What it does then is in `plcsim.testing.session`.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

import pytest

from plcsim.testing import terminal

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator
    from pathlib import Path

    from plcsim.testing.plc import Plc

__tracebackhide__ = True

MARKERS = (
    "plc(project=, program=, config=, task_class=, cycle=, seeds=, network=, boot=): what runs",
    "cycle_budget(p50=, p90=, p99=, p999=, worst=, program=): execution time a cycle may take",
    "realtime: run the test on the wall clock; skipped where the host cannot hold the tick",
)


def _session() -> Any:
    """Return the module that does the work, imported by the first PLC test."""
    return import_module("plcsim.testing.session")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options of the plugin."""
    group = parser.getgroup("plcsim", "PLC programs on the virtual clock (plcsim)")
    group.addoption(
        "--plc-seed",
        default="0",
        metavar="N",
        help="seed of noise, network and sampling; 'random' draws one and prints it (default: 0)",
    )
    group.addoption(
        "--plc-config",
        default="",
        metavar="NAME",
        help="configuration of an Automation Studio project (default: the active one)",
    )
    group.addoption(
        "--plc-keep-going",
        action="store_true",
        help="leave out programs that cannot run, as `plcsim run --keep-going` does",
    )
    group.addoption(
        "--plc-report", metavar="DIR", help="write a report of all PLC tests: index.html and JSON"
    )
    group.addoption(
        "--plc-lines",
        action="store_true",
        help="with --plc-report: count the instructions of each line of compiled programs, so that "
        "`plcsim report compare` tells where a program got slower; they run half as fast",
    )
    group.addoption(
        "--plc-repeat",
        type=int,
        default=1,
        metavar="N",
        help="run every PLC test N times, for `plcsim report compare`",
    )
    group.addoption(
        "--require-realtime",
        action="store_true",
        help="fail, not skip, where the host cannot hold the tick of a realtime test",
    )
    parser.addini(
        "plc_calibration",
        "CPU time of the calibration loop on the machine that cycle_budgets are written for, such "
        "as 20us (see docs/testing-reference.md)",
        default="",
    )


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect tests in Structured Text (``test_*.st``), and those of Automation Studio projects."""
    suffix, name = file_path.suffix.lower(), file_path.name.lower()
    if suffix == ".st" and name.startswith("test_"):
        collector = import_module("plcsim.testing.st_collector").StructuredTextTests
    elif suffix == ".apj":
        collector = import_module("plcsim.testing.unit_test_collector").UnitTests
    else:
        return None
    found: pytest.Collector = collector.from_parent(parent, path=file_path)
    return found


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_teardown() -> None:
    """Hand over what has run to coverage.py, where its plugin was asked for."""
    coverage = sys.modules.get("plcsim.testing.coverage")
    if coverage is not None:
        coverage.collect()


def pytest_configure(config: pytest.Config) -> None:
    """Make the markers known; take up the report and the seed."""
    terminal.keep(config)
    for marker in MARKERS:
        config.addinivalue_line("markers", marker)
    seed = config.getoption("--plc-seed")
    if seed != "0" or config.getoption("--plc-report") or config.getoption("--plc-lines"):
        _session().configure(config)


def pytest_report_header(config: pytest.Config) -> str | None:
    """Print a seed that is not the default one."""
    seed = config.getoption("--plc-seed")
    return None if seed == "0" else f"plcsim: --plc-seed={seed}"


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Multiply PLC tests by seeds and repeats."""
    if "plc" not in metafunc.fixturenames:
        return
    marker = metafunc.definition.get_closest_marker("plc")
    seeds = marker.kwargs.get("seeds", 1) if marker else 1
    repeats = metafunc.config.getoption("--plc-repeat")
    if seeds > 1:
        ids = [f"seed+{n}" for n in range(seeds)]
        metafunc.fixturenames.append("_plc_seed_step")
        metafunc.parametrize("_plc_seed_step", range(seeds), ids=ids, indirect=True)
    if repeats > 1:
        ids = [f"repeat{n}" for n in range(repeats)]
        metafunc.fixturenames.append("_plc_repeat")
        metafunc.parametrize("_plc_repeat", range(repeats), ids=ids, indirect=True)


@pytest.fixture
def _plc_seed_step(request: pytest.FixtureRequest) -> int:
    """Give what is added to the seed."""
    return int(getattr(request, "param", 0))


@pytest.fixture
def _plc_repeat(request: pytest.FixtureRequest) -> int:
    """Give the number of the repeat."""
    return int(getattr(request, "param", 0))


@pytest.fixture
def plc(request: pytest.FixtureRequest, _plc_seed_step: int) -> Iterator[Plc]:
    """Give a controller that runs the project under test, booted, on the virtual clock.

    The project is the one that the test's folder belongs to, or what @pytest.mark.plc names.
    """
    yield from _session().open_for(request, _plc_seed_step)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_protocol(item: pytest.Item, nextitem: pytest.Item | None) -> bool | None:
    """Run tests with a budget as often as it takes to judge it."""
    if item.get_closest_marker("cycle_budget") is None:
        return None
    done: bool = _session().run_with_budget(item, nextitem)
    return done


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Add to the result of a PLC test what the controller did."""
    report = yield
    if "plc" in getattr(item, "fixturenames", ()):
        _session().complete(item, call, report)
    return report
