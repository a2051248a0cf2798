"""Collecting what is wrong in a source text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.errors import Diagnostic, DiagnosticSeverity, SourceError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from st_types.syntax.source import Source

MAX_DIAGNOSTICS = 20
"""Most diagnostics kept of one file; the others are only counted."""

EXCERPT_WIDTH = 100
"""Most characters of a source line that are shown."""


def render_all(diagnostics: Iterable[Diagnostic], omitted: int = 0) -> str:
    """Return all findings as text; ``omitted`` is how many more there were."""
    lines = [diagnostic.render() for diagnostic in diagnostics]
    if omitted:
        lines.append(f"... and {omitted} more that are not shown")
    return "\n".join(lines)


def excerpt_of(line: str, column: int) -> tuple[str, int]:
    """Return at most `EXCERPT_WIDTH` characters of ``line`` around ``column`` and its place there.

    Tabs become one blank and unprintable characters a question mark, so that the caret stands right
    and a terminal is not upset.
    """
    start = max(0, column - 1 - EXCERPT_WIDTH // 2) if len(line) > EXCERPT_WIDTH else 0
    cut = line[start : start + EXCERPT_WIDTH]
    shown = "".join(c if c.isprintable() else " " if c == "\t" else "?" for c in cut)
    head, tail = "..." if start else "", "..." if start + EXCERPT_WIDTH < len(line) else ""
    return f"{head}{shown}{tail}", column - 1 - start + len(head)


class DiagnosticLog:
    """Collects the findings of one file.

    Attributes:
        source: the file.
        records: the first `MAX_DIAGNOSTICS` errors and as many warnings, in the order found.
        omitted: how many findings were made beyond that.
        error_count: all errors.
        warning_count: all warnings.
        code: of findings that are given none.
    """

    __slots__ = ("code", "error_count", "omitted", "records", "source", "warning_count")

    def __init__(self, source: Source, code: str = "") -> None:
        self.source = source
        self.code = code
        self.records: list[Diagnostic] = []
        self.omitted = 0
        self.error_count = 0
        self.warning_count = 0

    def error(self, offset: int, message: str, hint: str = "", code: str = "") -> None:
        """Record an error at the character ``offset``."""
        self.error_count += 1
        if self.error_count > MAX_DIAGNOSTICS:
            self.omitted += 1
        else:
            self._add(DiagnosticSeverity.ERROR, offset, message, hint, code)

    def warning(self, offset: int, message: str, hint: str = "", code: str = "") -> None:
        """Record a warning at the character ``offset``."""
        self.warning_count += 1
        if self.warning_count > MAX_DIAGNOSTICS:
            self.omitted += 1
        else:
            self._add(DiagnosticSeverity.WARNING, offset, message, hint, code)

    def _add(
        self, severity: DiagnosticSeverity, offset: int, message: str, hint: str, code: str
    ) -> None:
        path, line, column = self.source.location(offset)
        excerpt, caret = excerpt_of(self.source.line_text(line), column)
        self.records.append(
            Diagnostic(
                severity, path, line, column, message, hint, excerpt, caret, code or self.code
            )
        )

    def raise_errors(self) -> None:
        """Raise all findings if one of them is an error.

        Raises:
            SourceError: there is an error.
        """
        if self.error_count:
            raise SourceError(render_all(self.records, self.omitted), self.records)
