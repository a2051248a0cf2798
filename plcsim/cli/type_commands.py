"""What the commands of ``plcsim types`` do; `plcsim.cli.types` declares them."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from plcsim.cli.declaration_files import (
    Reading,
    find_files,
    folder_scopes,
    library_scopes,
    read_files,
)
from plcsim.core.errors import PlcError
from st_types.errors import Severity
from st_types.resolve.scope import Scope
from st_types.syntax.collector import collector_paused
from st_types.syntax.printer import print_file
from st_types.writers.c_header import c_header
from st_types.writers.layout_table import layout_rows
from st_types.writers.python_source import python_source

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from st_types.types.elementary import DataType


def check(options: argparse.Namespace) -> int:
    """Print what is wrong in the files, and how many they are."""
    reading, scopes = _resolved(options.paths, strict=options.strict)
    if not reading.files and not reading.failures:
        places = ", ".join(map(str, options.paths))
        raise PlcError(f"{places}: no .typ, .var or .fun file was found.")
    errors = _report(reading, print)
    warnings = sum(file.diagnostics.warning_count for file in reading.files)
    types = sum(sum(1 for _ in scope.data_types()) for scope in scopes)
    blocks = sum(b.data_type is not None for scope in scopes for b in scope.function_blocks)
    functions = sum(len(scope.functions) for scope in scopes)
    variables = sum(len(scope.variables) for scope in scopes)
    print(
        f"{_count(len(reading.files), 'file')}, {_count(reading.lines, 'line')}: "
        f"{_count(types - blocks, 'type')}, {_count(blocks, 'function block')}, "
        f"{_count(functions, 'function')}, {_count(variables, 'variable')}; "
        f"{_count(errors, 'error')}, {_count(warnings, 'warning')}"
    )
    return 1 if errors else 0


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _resolved(paths: Sequence[Path], *, strict: bool = False) -> tuple[Reading, list[Scope]]:
    with collector_paused():
        reading = read_files(find_files(paths))
        scopes = folder_scopes(reading.files, strict=strict)
        for scope in scopes:
            scope.check()
        return reading, scopes


def _report(reading: Reading, show: Callable[[str], object], *, warnings: bool = True) -> int:
    """Show all findings and return the number of errors."""
    for failure in reading.failures:
        show(failure)
    for file in reading.files:
        for record in sorted(file.diagnostics.records, key=lambda r: (r.line, r.column)):
            if warnings or record.severity is Severity.ERROR:
                show(record.render())
        if file.diagnostics.omitted:
            show(f"{file.path}: {file.diagnostics.omitted} more findings are not shown")
    return len(reading.failures) + sum(file.diagnostics.error_count for file in reading.files)


def _sound(paths: Sequence[Path]) -> Scope:
    """Return the declarations of files without errors.

    Raises:
        PlcError: there are errors; they are printed.
    """
    reading = read_files(find_files(paths))
    scope = Scope("", reading.files, library_scopes())
    scope.check()
    errors = _report(reading, lambda line: print(line, file=sys.stderr), warnings=False)
    if errors:
        raise PlcError(f"{_count(errors, 'error')} in the declarations.")
    return scope


def layout(options: argparse.Namespace) -> int:
    """Print a table of offsets."""
    data_type = find_type(options.paths, options.type)
    print(f"{options.type}: {_count(data_type.size, 'byte')}, alignment {data_type.alignment}")
    rows = [row for row in layout_rows(data_type) if options.deep or row.path.isidentifier()]
    width = max(len(text) for text in ("member", *(row.path for row in rows)))
    if rows:
        print(f"{'offset':>8}  {'bytes':>8}  {'member':{width}}  type")
    for row in rows:
        print(f"{row.offset:>8}  {row.size:>8}  {row.path:{width}}  {row.data_type}")
    return 0


def find_type(paths: Sequence[Path], name: str) -> DataType[object]:
    """Return a type; errors elsewhere do not matter.

    Raises:
        PlcError: there is none of that name, or it has no layout; errors in the files are printed.
    """
    reading, scopes = _resolved(paths)
    found = (scope.find_type(name) for scope in [*scopes, *library_scopes()])
    data_type = next((each for each in found if each is not None), None)
    if data_type is None:
        _report(reading, lambda line: print(line, file=sys.stderr))
        raise PlcError(f"no type with a layout is called {name}.")
    return data_type


def header(options: argparse.Namespace) -> int:
    """Print a C header."""
    name = options.name or options.paths[0].resolve().stem
    print(c_header(_sound(options.paths), name), end="")
    return 0


def python(options: argparse.Namespace) -> int:
    """Print a Python module."""
    paths = " ".join(map(str, options.paths))
    title = f"Types of {paths}, written by plcsim types python"
    print(python_source(_sound(options.paths), title), end="")
    return 0


def print_files(options: argparse.Namespace) -> int:
    """Print the declarations again."""
    reading = read_files(find_files(options.paths))
    errors = _report(reading, lambda line: print(line, file=sys.stderr))
    for file in reading.files:
        print(print_file(file), end="")
    return 1 if errors else 0


COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "check": check,
    "layout": layout,
    "header": header,
    "python": python,
    "print": print_files,
}
"""What each command runs; the results are exit codes."""
