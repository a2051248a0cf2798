"""``plcsim st format``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.cli.declaration_files import find_files, shown_progress
from plcsim.cli.exit_codes import ExitCode
from plcsim.core.errors import PlcError
from plcsim.program.structured_text.syntax.formatter import (
    DEFAULT_STEP,
    content_of,
    format_text,
    has_directives,
)
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from st_types.errors import DiagnosticSeverity, SourceError
from st_types.syntax.source import Source

if TYPE_CHECKING:
    import argparse
    from pathlib import Path

SUFFIXES = frozenset([".st"])


def format_files(options: argparse.Namespace) -> int:
    """Format files, or tell which are not."""
    paths = find_files(options.paths, SUFFIXES)
    if not paths:
        raise PlcError(f"{', '.join(map(str, options.paths))}: no .st file was found.")
    step = " " * options.indent if options.indent else DEFAULT_STEP
    changed = failed = 0
    for path in shown_progress(paths):
        try:
            before = path.read_bytes()
            after = _formatted(path, step)
            if after != before:
                changed += 1
                print(f"{path}: {'is not formatted' if options.check else 'formatted'}")
                if not options.check:
                    path.write_bytes(after)
        except OSError as err:
            print(f"{path}: error: {err.strerror or err}")
            failed += 1
        except SourceError as err:
            print(err)
            failed += 1
    print(f"{len(paths)} file{'s' * (len(paths) != 1)}: {changed} {_word(options)}, {failed} left")
    return ExitCode.FAILED if failed or (options.check and changed) else ExitCode.DONE


def _word(options: argparse.Namespace) -> str:
    return "to format" if options.check else "formatted"


def _formatted(path: Path, step: str) -> bytes:
    """Return a file as it should be.

    Raises:
        OSError: it cannot be read.
        SourceError: it has errors in its syntax.
    """
    source = Source.read(path)
    file = parse_structured_text(source)
    if file.diagnostics.error_count:
        records = [r for r in file.diagnostics.records if r.severity is DiagnosticSeverity.ERROR]
        raise SourceError("\n".join(record.render() for record in records), records)
    if has_directives(source):
        raise SourceError(f"{path}: error: has lines of the preprocessor: left as it is", [])
    text = format_text(file, step)
    if content_of(Source(source.path, text)) != content_of(source):
        raise SourceError(f"{path}: error: cannot be formatted without a change: left as it is", [])
    return source.encode(text)
