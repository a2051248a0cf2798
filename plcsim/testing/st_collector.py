"""Tests in Structured Text as items of pytest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.testing.st_program import Failure, run_test, tests_in

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from plcsim.testing.st_program import StructuredTextTest


class StructuredTextTests(pytest.File):
    """A file with tests."""

    def collect(self) -> Iterator[pytest.Item]:
        """Yield its tests."""
        try:
            tests = tests_in(self.path)
        except ConfigurationError as err:
            raise self.CollectError(str(err)) from None
        for test in tests:
            yield StructuredTextItem.from_parent(self, name=test.name, test=test)


class StructuredTextItem(pytest.Item):
    """One test."""

    def __init__(self, *, test: StructuredTextTest, **options: Any) -> None:
        super().__init__(**options)
        self._test = test

    def runtest(self) -> None:
        """Run it."""
        run_test(self.path, self._test)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return what is shown of a failure."""
        if isinstance(excinfo.value, Failure | ConfigurationError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Return where it is."""
        return self.path, self._test.line - 1, self.name
