"""``plcsim types header`` and ``plcsim types python``: a file for each scope.

What is sound is written, whatever is wrong elsewhere. All findings are told, and so is what is left
out because its layout is not known; the exit code is 1 then.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from keyword import iskeyword
from typing import TYPE_CHECKING

from plcsim.cli.declaration_scopes import read_declarations, report
from plcsim.cli.executed_blocks import executed_blocks
from plcsim.core.errors import PlcError
from st_types.writers.c_header import GLOBAL, LOCAL, Header, c_header
from st_types.writers.plan import PlannedFile, left_out, plan_files
from st_types.writers.python_source import PythonModule, python_source

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from plcsim.cli.declaration_scopes import FoundDeclarations, NamedScope


def header(options: argparse.Namespace) -> int:
    """Write a C header for each scope."""
    found = read_declarations(options.paths)
    files = _planned(found, options)
    texts: dict[str, str] = {}
    made: dict[PlannedFile, Header] = {}
    for file in files:
        around = [made[each] for each in file.closure()]
        made[file] = Header(file.scope, around, variables=LOCAL if file.is_local else GLOBAL)
        includes = [f"{each.name}.h" for each in file.includes]
        texts[f"{file.name}.h"] = c_header(made[file], options.name or file.name, includes)
    return _finish(found, texts, options.output)


def python(options: argparse.Namespace) -> int:
    """Write a Python module for each scope."""
    found = read_declarations(options.paths)
    files = _planned(found, options)
    executed = executed_blocks([file.scope for file in files])
    texts = {"__init__.py": '"""Written by plcsim types python."""\n'} if options.output else {}
    made: dict[PlannedFile, PythonModule] = {}
    for file in files:
        included = [made[each] for each in file.includes]
        made[file] = PythonModule(file.name, file.scope, included, executed)
        title = f"{file.scope.name}: written by plcsim types python"
        texts[f"{file.name}.py"] = python_source(made[file], title)
    return _finish(found, texts, options.output)


def _planned(found: FoundDeclarations, options: argparse.Namespace) -> list[PlannedFile]:
    """Return the files to write, each behind those that it includes.

    Raises:
        PlcError: they are several and there is no folder for them.
    """
    asked = [each for each in found.scopes if _has_content(each)]
    if not asked:
        raise PlcError(f"{', '.join(map(str, options.paths))}: nothing is declared there.")
    if options.output is None:
        if len(asked) > 1:
            names = ", ".join("/".join(each.path) for each in asked)
            hint = "-o FOLDER writes a file for each; a path may name one of them"
            raise PlcError(f"{len(asked)} scopes are declared there ({names}): {hint}.")
        return plan_files([PlannedFile(_stem(asked[0].scope.name), asked[0].scope)])
    named = [*asked, *(each for each in found.others if _has_content(each))]
    stems = _stems(named)
    inner = [each.scope for each in named if each.kind != "library"]
    planned = plan_files(
        PlannedFile(
            stems[each],
            each.scope,
            is_local=each.kind in ("program", "folder"),
            sees=() if each.kind == "library" else [s for s in each.scope.chain[1:] if s in inner],
        )
        for each in named
    )
    wanted = {each.scope for each in asked}
    needed = {file for file in planned if file.scope in wanted}
    needed |= {each for file in needed for each in file.closure()}
    return [file for file in planned if file in needed]


def _has_content(named: NamedScope) -> bool:
    index = named.scope.index
    return bool(index.types or index.functions or index.variables)


def _stems(named: Sequence[NamedScope]) -> Mapping[NamedScope, str]:
    """Return a file name for each scope: its own name, with those around it where it is not alone.

    Case makes no difference, for a file system may make none.
    """
    count = Counter(_stem(each.scope.name).lower() for each in named)
    stems: dict[NamedScope, str] = {}
    taken: set[str] = set()
    for each in named:
        is_alone = count[_stem(each.scope.name).lower()] == 1
        stem = _stem(each.scope.name if is_alone else "_".join(each.path))
        while stem.lower() in taken:
            stem += "_"
        taken.add(stem.lower())
        stems[each] = stem
    return stems


def _stem(name: str) -> str:
    """Return a name that a file and a Python module can have."""
    stem = re.sub(r"\W", "_", name, flags=re.ASCII)
    return f"_{stem}" if not stem.isidentifier() or iskeyword(stem) else stem


def _finish(found: FoundDeclarations, texts: Mapping[str, str], folder: Path | None) -> int:
    """Write the files, tell the findings and what is left out, and return the exit code."""
    for name, text in texts.items():
        if folder is None:
            print(text, end="")
        else:
            write(folder / name, text)
    for each in found.scopes:
        each.scope.check()
    errors = report(found, complain)
    missing = list(_left_out(found))
    for line in missing:
        complain(line)
    return 1 if errors or missing else 0


def _left_out(found: FoundDeclarations) -> Iterator[str]:
    for each in found.scopes:
        names = left_out(each.scope)
        if names:
            title = f"{each.kind} {'/'.join(each.path)}"
            yield f"{title}: left out, for a type or a size is not known: {', '.join(names)}"


def complain(line: str) -> None:
    """Print a line that is no result."""
    print(line, file=sys.stderr)


def write(path: Path, text: str) -> None:
    """Write a file, with the folders around it, and print its name.

    Raises:
        PlcError: it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as err:
        raise PlcError(f"{path}: {err.strerror or err}.") from err
    print(path)
