"""Errors of st_types.

::

    TypeSystemError                  base of all
    ├── DeclarationError             a declaration that cannot be: name, bound, initial value
    │   └── SourceError              errors in source text, each with file, line and column
    └── ValueRangeError              a value that its type cannot hold (also a ValueError)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from st_types.syntax.diagnostics import Diagnostic


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
