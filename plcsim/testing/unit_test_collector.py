"""Test cases of the library UnitTest as items of pytest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.testing.unit_test import (
    PASSED,
    SKIPPED,
    UnitTestError,
    find_cases,
    run_tests,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from plcsim.testing.unit_test import CaseResult, ProgramUnderTest, UnitTestCase

__tracebackhide__ = True


class UnitTests(pytest.File):
    """An Automation Studio project: a program runs once, when its first test case is asked for."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._done: dict[ProgramUnderTest, Mapping[tuple[str, str], CaseResult] | Exception] = {}

    def collect(self) -> Iterator[pytest.Item]:
        """Yield its test cases."""
        try:
            cases = find_cases(self.path.parent)
        except ConfigurationError as err:
            raise self.CollectError(str(err)) from None
        for case in cases:
            name = f"{case.place.task}.{case.set}.{case.name}"
            yield UnitTestItem.from_parent(self, name=name, case=case)

    def result_of(self, case: UnitTestCase) -> CaseResult:
        """Return what became of a test case.

        Raises:
            ConfigurationError: its program cannot be loaded.
            UnitTestError: its program did not get to it.
        """
        if case.place not in self._done:
            try:
                self._done[case.place] = run_tests(self.path.parent, case.place)
            except (ConfigurationError, UnitTestError) as err:
                self._done[case.place] = err
        done = self._done[case.place]
        if isinstance(done, Exception):
            raise done
        if (case.set, case.name) not in done:
            raise UnitTestError(
                f"{case.file}:{case.line}: the program does not run this test case: its list of "
                "sets does not name the set"
            )
        return done[case.set, case.name]


class UnitTestItem(pytest.Item):
    """One test case."""

    parent: UnitTests

    def __init__(self, *, case: UnitTestCase, **options: Any) -> None:
        super().__init__(**options)
        self._case = case

    def runtest(self) -> None:
        """Run it, or the program that it belongs to."""
        state, findings = self.parent.result_of(self._case)
        if state == SKIPPED:
            pytest.skip("it is not active, or the set was aborted")
        if state != PASSED:
            raise UnitTestError("\n".join(findings) or "aborted")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return what is shown of a failure."""
        if isinstance(excinfo.value, UnitTestError | ConfigurationError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Return where it is."""
        return self._case.file, self._case.line - 1, self.name
