"""Tests with the library UnitTest of the community: sets of test cases in programs in C.

Which test cases there are is read from the text of the sources, where macros of UnitTest.h name
them. What became of them stands in the variable ``UnitTestReport`` of the program when it has run
(`plcsim/ansi_c/static/UnitTest.c`).
"""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.clock import VirtualClock
from plcsim.core.duration import format_duration
from plcsim.core.errors import ConfigurationError, TagError
from plcsim.core.system import State
from plcsim.network import VirtualNetwork
from plcsim.project.assembly import VIRTUAL_IP, assemble, load
from plcsim.project.automation_studio.reader import read_automation_studio
from plcsim.project.plc_toml import read_project

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from plcsim.core.controller import Controller
    from plcsim.project.automation_studio.reader import ProgramTask

REPORT: Final = "UnitTestReport"

LONGEST_NS: Final = 600 * 1_000_000_000
"""Virtual time after which a program whose tests have not ended is given up."""

STEP_NS: Final = 1_000_000_000
"""Virtual time between two looks at the report."""

SOURCES: Final = (".c", ".cpp", ".cc", ".cxx")

_NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"', re.DOTALL)
_FIXTURE = re.compile(r'\bnew_TestFixture\w*\s*\(\s*"([^"]*)"\s*,\s*(\w+)')
_FIXTURES = re.compile(r"\bUNITTEST_FIXTURES\s*\(\s*(\w+)")
_CALLER = re.compile(r'\bUNITTEST_CALLER_\w+\s*\(\s*(\w+)\s*,\s*"([^"]*)"([^;{]*)')


class ProgramUnderTest(NamedTuple):
    """A program with tests: its configuration, the task that runs it, and its source."""

    configuration: str
    task: str
    source: str


class UnitTestCase(NamedTuple):
    """A test case.

    Attributes:
        place: the program.
        set: the name of its set.
        name: its own.
        file: that it stands in.
        line: of its function, or where the set names it.
    """

    place: ProgramUnderTest
    set: str
    name: str
    file: Path
    line: int


class CaseResult(NamedTuple):
    """What became of a test case: a state of the report, and what it found."""

    state: int
    findings: Sequence[str]


PASSED: Final = 1
SKIPPED: Final = 4


class UnitTestError(Exception):
    """A test case did not pass, or a program did not get to it."""


def find_cases(folder: Path) -> list[UnitTestCase]:
    """Return the test cases of an Automation Studio project, in the order of its tasks.

    A program counts in the first configuration that runs it, once.

    Raises:
        ConfigurationError: the project cannot be read.
    """
    found: dict[str, list[UnitTestCase]] = {}
    for configuration in read_automation_studio(folder).configurations:
        for task in read_automation_studio(folder, configuration).tasks:
            if task.source not in found and task.program is not None:
                place = ProgramUnderTest(configuration, task.name, task.source)
                found[task.source] = [*_cases_in(place, task)]
    return [case for cases in found.values() for case in cases]


def _cases_in(place: ProgramUnderTest, task: ProgramTask) -> Iterator[UnitTestCase]:
    assert task.program is not None
    for file in task.program.files:
        if file.suffix.lower() in SOURCES:
            with suppress(OSError):  # which is told when the program is loaded
                yield from cases_of(place, file, file.read_text("utf-8", "replace"))


def cases_of(place: ProgramUnderTest, file: Path, text: str) -> Iterator[UnitTestCase]:
    """Yield the test cases that a source names, set by set."""
    code = _NO_CODE.sub(_blank, text)
    sets = [(match[2], f",{match[3]},") for match in _CALLER.finditer(code)]
    starts = [(match.start(), match[1]) for match in _FIXTURES.finditer(code)]
    for match in _FIXTURE.finditer(code):
        array = next((name for start, name in reversed(starts) if start < match.start()), "")
        named = [name for name, rest in sets if re.search(rf"\b{array}\b", rest)] if array else []
        declared = re.search(rf"\b{match[2]}\s*\(\s*(?:void)?\s*\)\s*\{{", code)
        line = code.count("\n", 0, (declared or match).start()) + 1
        for name in named or [file.stem]:
            yield UnitTestCase(place, name, match[1], file, line)


def _blank(match: re.Match[str]) -> str:
    """Return a text with as many lines as a comment has; strings stay."""
    return match[0] if match[0].startswith('"') else "\n" * match[0].count("\n")


def run_tests(folder: Path, place: ProgramUnderTest) -> Mapping[tuple[str, str], CaseResult]:
    """Run the tests of a program on the virtual clock; return what became of each.

    Other programs do not run.

    Raises:
        ConfigurationError: it cannot be loaded; all findings are told.
        UnitTestError: it ended in SERVICE, or not at all.
    """
    project = read_project(folder, {"as": {"config": place.configuration}})
    others = {entry.source for entry in project.programs if entry.source != place.source}
    project = replace(project.without(others, ()), extensions={}, keep_going=True)
    application = load(project)
    try:
        if application.left_out:  # what is wrong elsewhere does not matter
            raise ConfigurationError(*application.left_out[place.source])
        clock = VirtualClock()
        network = VirtualNetwork(clock.now_ns).host(VIRTUAL_IP)
        return _results(_reported(assemble(application, clock=clock, network=network), place))
    finally:
        application.unload()


def _reported(controller: Controller, place: ProgramUnderTest) -> Any:
    """Run a controller until the tests are done; return the report."""
    try:
        tag = controller.tags.find(f"{place.task}.{REPORT}")
    except TagError:
        raise ConfigurationError(f"{place.source}: nothing of it includes UnitTest.h") from None
    controller.boot()
    for until_ns in range(STEP_NS, LONGEST_NS + 1, STEP_NS):
        if controller.run(until_ns=until_ns) is not State.RUN:
            raise UnitTestError(_fault_of(controller))
        report: Any = controller.tags.read(tag)
        if report["Done"]:
            controller.shutdown()
            return report
    limit = format_duration(LONGEST_NS)
    raise UnitTestError(f"{place.source}: its tests have not ended within {limit}")


def _fault_of(controller: Controller) -> str:
    fault = controller.fault
    location = getattr(fault, "location", "")
    reason = getattr(fault, "reason", "") or str(fault)
    return f"{location}: {reason}" if location else reason


def _results(report: Mapping[str, Any]) -> Mapping[tuple[str, str], CaseResult]:
    found: dict[tuple[str, str], CaseResult] = {}
    findings = report["Findings"][: report["FindingCount"]]
    for number, case in enumerate(report["Cases"][: report["CaseCount"]]):
        texts = [_told(each) for each in findings if each["Case"] == number]
        found[case["Set"], case["Name"]] = CaseResult(case["State"], texts)
    return found


def _told(finding: Mapping[str, Any]) -> str:
    place = f"{finding['File']}:{finding['Line']}: " if finding["File"] else ""
    return f"{place}{finding['Text']}"
