"""Which file is written for each scope, and which of the others it needs.

What a scope declares is written into its own file, and only there. A file names the others whose
declarations its own need. Where files need one another in a circle, as two libraries may, one of
them goes without, and what it needs is written into it once more.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from st_types.resolve.file_resolver import GENERIC_TYPES
from st_types.syntax.tree import NamedType
from st_types.types.paths import inner_types

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from st_types.resolve.declared import DeclaredFunction, DeclaredVariable
    from st_types.resolve.scope import Scope
    from st_types.syntax.tree import TypeSpecification
    from st_types.types.elementary import DataType


@dataclass(eq=False)
class PlannedFile:
    """A file that is to be written.

    Attributes:
        name: without a suffix.
        scope: what it holds.
        is_local: the scope is a program: its variables are its own.
        sees: the scopes around it that it names in any case: of its packages and its project.
        includes: the files whose declarations it needs, those that they need first.
    """

    name: str
    scope: Scope
    is_local: bool = False
    sees: Sequence[Scope] = ()
    includes: list[PlannedFile] = field(default_factory=list)

    def closure(self) -> list[PlannedFile]:
        """Return the files it includes, and those that they include, each once."""
        found: dict[PlannedFile, None] = {}
        waiting = list(self.includes)
        while waiting:
            file = waiting.pop()
            if file not in found:
                found[file] = None
                waiting += file.includes
        return list(found)


def plan_files(files: Iterable[PlannedFile]) -> list[PlannedFile]:
    """Find out what each file includes, and return them so that those come first."""
    files = list(files)
    owners = {t: file for file in files for t in file.scope.data_types()}
    needed = {file: _needed(file, files, owners) for file in files}
    ordered: dict[PlannedFile, None] = {}
    for file in files:
        _add(file, needed, ordered)
    return list(ordered)


def _add(
    first: PlannedFile,
    needed: Mapping[PlannedFile, list[PlannedFile]],
    ordered: dict[PlannedFile, None],
) -> None:
    """Add a file behind all that it needs, however long the chain is."""
    if first in ordered:
        return
    waiting = [(first, iter(needed[first]))]
    open_files = {first}
    while waiting:
        file, others = waiting[-1]
        other = next((each for each in others if each not in open_files), None)
        if other is None:
            waiting.pop()
            open_files.discard(file)
            ordered[file] = None
            continue
        file.includes.append(other)
        if other not in ordered:
            open_files.add(other)
            waiting.append((other, iter(needed[other])))


def _needed(
    file: PlannedFile, files: Sequence[PlannedFile], owners: Mapping[DataType[object], PlannedFile]
) -> list[PlannedFile]:
    found = dict.fromkeys(each for each in files if each.scope in file.sees)
    seen: set[DataType[object]] = set()
    waiting = list(_types_in(file.scope))
    while waiting:
        data_type = waiting.pop()
        if data_type in seen:
            continue
        seen.add(data_type)
        owner = owners.get(data_type, file)
        if owner is file:
            waiting += inner_types(data_type)
        else:
            found[owner] = None
    return [each for each in files if each in found]


def _types_in(scope: Scope) -> Iterator[DataType[object]]:
    """Yield the types that stand in the declarations of a scope."""
    yield from scope.data_types()
    yield from filter(None, (variable.data_type for variable in scope.variables))
    for function in scope.functions:
        yield from filter(None, (function.result, *(v.data_type for v in function.variables)))


def left_out(scope: Scope) -> list[str]:
    """Return what is declared and cannot be written, for it has no layout: ``type Axis``."""
    names = [f"type {each.name}" for each in scope.types if each.data_type is None]
    blocks = [each for each in scope.function_blocks if each.data_type is None]
    names += [f"function block {each.name}" for each in blocks]
    names += [f"variable {v.name}" for v in scope.variables if v.data_type is None]
    return names + [f"function {f.name}" for f in scope.functions if lacks_types(f)]


def is_generic(specification: TypeSpecification | None) -> bool:
    """Whether a variable is declared as ANY, ANY_NUM, ...: it has no layout by intention."""
    return isinstance(specification, NamedType) and specification.name.upper() in GENERIC_TYPES


def parameters_of(function: DeclaredFunction) -> list[DeclaredVariable]:
    """Return what a function is called with."""
    return [v for v in function.variables if v.block.section in ("VAR_INPUT", "VAR_IN_OUT")]


def lacks_types(function: DeclaredFunction) -> bool:
    """Whether a type is not known that a caller needs."""
    types = [(v.data_type, v.node.specification) for v in parameters_of(function)]
    if function.node.result is not None:
        types.append((function.result, function.node.result))
    return any(found is None and not is_generic(declared) for found, declared in types)
