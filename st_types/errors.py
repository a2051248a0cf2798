"""Errors of st_types, and what a `SourceError` carries: the findings in a text.

::

    TypeSystemError                  base of all
    ├── DeclarationError             a declaration that cannot be: name, bound, initial value
    │   └── SourceError              errors in source text, each with file, line and column
    └── ValueRangeError              a value that its type cannot hold (also a ValueError)
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


class TypeSystemError(Exception):
    """Base of all errors of this package."""


class DeclarationError(TypeSystemError):
    """A declaration of a type or a variable is wrong."""


class SourceError(DeclarationError):
    """One or more errors in source text; the message shows them all.

    Attributes:
        diagnostics: the findings, warnings included.
    """

    def __init__(self, message: str, diagnostics: Sequence[Diagnostic]) -> None:
        super().__init__(message)
        self.diagnostics = tuple(diagnostics)


class ValueRangeError(TypeSystemError, ValueError):
    """A value does not fit its declared type."""


class DiagnosticSeverity(StrEnum):
    """How bad it is: an error makes the file unusable, a warning does not."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding.

    Attributes:
        severity: error or warning.
        path: the file, as the user named it.
        line: from 1.
        column: from 1, in characters.
        message: what is wrong and what was expected.
        hint: how to put it right, may be empty.
        excerpt: the source line, cut around the column where it is long.
        caret: place of the column in ``excerpt``, from 0.
        code: names the kind of finding, such as ``ST2001``; empty where kinds have no codes.
    """

    severity: DiagnosticSeverity
    path: str
    line: int
    column: int
    message: str
    hint: str = ""
    excerpt: str = ""
    caret: int = 0
    code: str = ""

    def __str__(self) -> str:
        kind = f"{self.severity} {self.code}" if self.code else self.severity
        return f"{self.path}:{self.line}:{self.column}: {kind}: {self.message}"

    def render(self) -> str:
        """Return the finding as lines of text: message, source line, caret, hint."""
        lines = [str(self)]
        if self.excerpt:
            number = f"{self.line:>6} | "
            lines += [
                number + self.excerpt,
                " " * (len(number) - 2) + "| " + " " * self.caret + "^",
            ]
        if self.hint:
            lines.append(f"       hint: {self.hint}")
        return "\n".join(lines)
