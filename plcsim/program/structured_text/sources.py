"""The files of a program or a library in Structured Text, read and parsed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from st_types.errors import Severity, SourceError
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from plcsim.program.structured_text.syntax.tree import StructuredTextFile


def read_files(files: Iterable[Path]) -> list[StructuredTextFile]:
    """Parse files; what is wrong in their text is in their ``diagnostics``.

    Raises:
        ConfigurationError: a file cannot be read.
    """
    try:
        return [parse_structured_text(Source.read(file)) for file in files]
    except (OSError, SourceError) as err:
        raise ConfigurationError(str(err)) from None


def check_syntax(files: Iterable[StructuredTextFile]) -> None:
    """Raise a ConfigurationError with all errors that parsing has found."""
    records = [record for file in files for record in file.diagnostics.records]
    errors = [record.render() for record in records if record.severity is Severity.ERROR]
    if errors:
        raise ConfigurationError(*errors)
