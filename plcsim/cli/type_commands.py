"""What the commands of ``plcsim types`` do; `plcsim.cli.types` declares them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.cli.declaration_files import find_files, read_files
from plcsim.cli.declaration_scopes import read_declarations, report
from plcsim.cli.library_command import library
from plcsim.cli.type_writing import complain, header, python
from plcsim.core.errors import PlcError
from st_types.syntax.collector import collector_paused
from st_types.syntax.printer import print_bytes, print_file
from st_types.writers.layout_table import LayoutRow, layout_rows

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Sequence

    from plcsim.cli.declaration_scopes import FoundDeclarations
    from st_types.syntax.tree import DeclarationFile
    from st_types.types.elementary import DataType


def check(options: argparse.Namespace) -> int:
    """Print what is wrong in the files, and how many they are."""
    found = _resolved(options.paths, strict=options.strict)
    if not found.files and not found.reading.failures:
        paths = ", ".join(map(str, options.paths))
        raise PlcError(f"{paths}: no .typ, .var or .fun file was found.")
    errors = report(found, print)
    print(f"{_contents(found)}; {_count(errors, 'error')}, {_count(_warnings(found), 'warning')}")
    return 1 if errors else 0


def _contents(found: FoundDeclarations) -> str:
    scopes = [each.scope for each in found.scopes]
    counts = {
        "file": len(found.files),
        "line": sum(file.tokens.source.line_count for file in found.files),
        "type": sum(len(scope.types) for scope in scopes),
        "function block": sum(len(scope.function_blocks) for scope in scopes),
        "function": sum(len(scope.functions) for scope in scopes),
        "variable": sum(len(scope.variables) for scope in scopes),
    }
    words = [_count(number, noun) for noun, number in counts.items()]
    return f"{', '.join(words[:2])}: {', '.join(words[2:])}"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _warnings(found: FoundDeclarations) -> int:
    return len(found.reading.notes) + sum(f.diagnostics.warning_count for f in found.files)


def _resolved(paths: Sequence[Path], *, strict: bool = False) -> FoundDeclarations:
    with collector_paused():
        found = read_declarations(paths, strict=strict)
        for each in found.scopes:
            each.scope.check()
        return found


def layout(options: argparse.Namespace) -> int:
    """Print a table of offsets for each type of a name."""
    for title, data_type in find_types(options.paths, options.type):
        print(f"{title}: {_count(data_type.size, 'byte')}, alignment {data_type.alignment}")
        _print_rows([r for r in layout_rows(data_type) if options.deep or r.path.isidentifier()])
    return 0


def _print_rows(rows: Sequence[LayoutRow]) -> None:
    width = max(len(text) for text in ("member", *(row.path for row in rows)))
    if rows:
        print(f"{'offset':>8}  {'bytes':>8}  {'member':{width}}  type")
    for row in rows:
        print(f"{row.offset:>8}  {row.size:>8}  {row.path:{width}}  {row.data_type}")


def find_types(paths: Sequence[Path], name: str) -> list[tuple[str, DataType[object]]]:
    """Return the types of a name, with a title each; errors elsewhere do not matter.

    Raises:
        PlcError: there is none of that name, or it has no layout; errors in the files are printed.
    """
    found = _resolved(paths)
    owners = [each for each in found.scopes if each.scope.owner_of(name) is each.scope]
    types = [(each, each.scope.find_type(name)) for each in owners]
    sound = [(each, data_type) for each, data_type in types if data_type is not None]
    if len(sound) > 1:
        return [(f"{name} in {each.kind} {'/'.join(each.path)}", t) for each, t in sound]
    if sound:
        return [(name, sound[0][1])]
    around = [] if owners else [*found.scopes, *found.others]
    types_around = (each.scope.find_type(name) for each in around)
    data_type = next((each for each in types_around if each is not None), None)
    if data_type is None:
        report(found, complain)
        raise PlcError(f"no type with a layout is called {name}.")
    return [(name, data_type)]


def print_files(options: argparse.Namespace) -> int:
    """Print the declarations again, or write each file anew that has no errors."""
    reading = read_files(find_files(options.paths))
    for line in reading.failures:
        complain(line)
    for file in reading.files:
        for record in file.diagnostics.records:
            complain(record.render())
        if not options.write:
            print(print_file(file), end="")
        elif not file.diagnostics.error_count:
            _rewrite(file)
    errors = sum(file.diagnostics.error_count for file in reading.files)
    return 1 if errors or reading.failures else 0


def _rewrite(file: DeclarationFile) -> None:
    path, text = Path(file.path), print_bytes(file)
    try:
        if path.read_bytes() != text:
            path.write_bytes(text)
            print(path)
    except OSError as err:
        raise PlcError(f"{path}: {err.strerror or err}.") from err


COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "check": check,
    "layout": layout,
    "header": header,
    "python": python,
    "print": print_files,
    "library": library,
}
"""What each command runs; the results are exit codes."""
