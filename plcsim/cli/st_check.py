"""Checking names and types of Structured Text, wherever its declarations lie.

In the logical view of an Automation Studio project the lists say which files are a program or a
library. Elsewhere the .st files of a folder are one program, with those of folders in it that hold
actions only; files in which each PROGRAM brings its own VAR blocks, as IEC 61131-3 has it, stand
alone, and see what the other files of their folder declare.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple, TypeGuard

from plcsim.cli.declaration_files import SUFFIXES
from plcsim.cli.declaration_files import read_files as read_declaration_files
from plcsim.cli.declaration_scopes import (
    NamedScope,
    is_in_a_project,
    is_library,
    library_scopes,
    read_declarations,
)
from plcsim.program.structured_text.check.declared import declarations_of
from plcsim.program.structured_text.check.program import QUIET, check_program
from plcsim.program.structured_text.check.programs import MeantProgram
from plcsim.program.structured_text.dialect import is_standard
from plcsim.program.structured_text.program_uses import program_uses
from plcsim.program.structured_text.syntax.tree import ActionUnit, ProgramUnit
from st_types.errors import DiagnosticSeverity
from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC
from st_types.resolve.scope import Scope

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

    from plcsim.program.structured_text.check.typed import Storage
    from plcsim.program.structured_text.codes import FindingCode
    from plcsim.program.structured_text.syntax.tree import StructuredTextFile, Unit
    from st_types.syntax.tree import DeclarationFile


UNLISTED: Final = "no list of its program names this file; only its syntax was checked"


class _Group(NamedTuple):
    """Files that are checked together.

    Attributes:
        name: of the program or the library.
        files: its files.
        outer: what they see besides what they declare themselves.
        is_library: its variables are global ones.
    """

    name: str
    files: Sequence[StructuredTextFile]
    outer: Sequence[Scope]
    is_library: bool = False


def check_files(
    paths: Sequence[Path],
    files: Sequence[StructuredTextFile],
    hidden: Collection[FindingCode] = QUIET,
) -> list[str]:
    """Check parsed files; findings go to their ``diagnostics``.

    Files with errors in their syntax are left out.

    Args:
        paths: as the user named them. A file that lies in no project sees the declarations of its
            folder, and of none below.
        files: at and below these paths.
        hidden: codes of warnings that are not wanted.

    Returns:
        errors in the declarations around them.
    """
    folders = dict.fromkeys(path if path.is_dir() else path.parent for path in paths)
    loose = [each for each in folders if each not in paths and not is_in_a_project(each)]
    failures: list[str] = []
    own, scopes = [], []
    for folder in loose:
        reading = read_declaration_files(_declaration_files(folder))
        failures += reading.failures
        own.append(_scope_of(folder, reading.files))
    around = [each for each in folders if each not in loose]
    if around:
        found = read_declarations(around, strict=True)
        failures += found.reading.failures
        own += found.scopes
        scopes += found.others
    scopes = [*own, *scopes]
    sound = {Path(f.path).resolve(): f for f in files if not f.diagnostics.error_count}
    for group in _groups(sound, scopes):
        _check(group, hidden)
    return [*failures, *_errors(own)]


def _declaration_files(folder: Path) -> list[Path]:
    return sorted(file for file in folder.iterdir() if file.suffix.lower() in SUFFIXES)


def _scope_of(folder: Path, files: Sequence[DeclarationFile]) -> NamedScope:
    kind = "library" if is_library(folder) else "folder"
    name = folder.resolve().name
    scope = Scope(name, files, library_scopes(), strict=True)
    return NamedScope(kind, (name,), scope, folder.resolve())


def _errors(scopes: Iterable[NamedScope]) -> Iterator[str]:
    records = (r for each in scopes for f in each.scope.files for r in f.diagnostics.records)
    told = (record.render() for record in records if record.severity is DiagnosticSeverity.ERROR)
    return iter(dict.fromkeys(told))


def _check(group: _Group, hidden: Collection[FindingCode]) -> None:
    dialect = IEC if any(map(is_standard, group.files)) else AUTOMATION_STUDIO
    uses = program_uses(file.tokens.source.text for file in group.files)
    declared = [declarations_of(file, uses) for file in group.files]
    scope = Scope(group.name, declared, group.outer, dialect=dialect, strict=True)
    scope.check()
    if not any(file.diagnostics.error_count for file in group.files):
        storage: Storage = "global" if group.is_library else "program"
        names = [unit.name for file in group.files for unit in file.units if _is_program(unit)]
        if dialect is IEC and len(names) > 1:
            for only in names:  # each sees the others' declarations, not their variables
                meant = MeantProgram(only)
                check_program(
                    group.name, group.files, scope, hidden=hidden, storage="global", meant=meant
                )
        else:
            check_program(group.name, group.files, scope, hidden=hidden, storage=storage)


def _is_program(unit: Unit) -> TypeGuard[ProgramUnit]:
    return isinstance(unit, ProgramUnit)


def _groups(
    files: dict[Path, StructuredTextFile], scopes: Sequence[NamedScope]
) -> Iterator[_Group]:
    rest = dict(files)
    twincat = [rest.pop(path) for path in files if path.suffix.lower().startswith(".tc")]
    if twincat:  # all units of a project of TwinCAT see each other, whatever folders they lie in
        yield _Group("project", twincat, library_scopes())
    for each in scopes:
        if each.listed is not None:
            own = [rest.pop(path) for f in each.listed if (path := f.resolve()) in rest]
            if own:
                yield _Group(each.scope.name, own, (each.scope,), each.kind == "library")
    listed = {each.folder for each in scopes if each.listed is not None}
    by_folder: dict[Path, list[StructuredTextFile]] = {}
    for path, file in rest.items():
        if not listed.isdisjoint(path.parents):
            file.diagnostics.warning(0, UNLISTED)
            continue
        by_folder.setdefault(path.parent, []).append(file)
    libraries = [each.scope for each in scopes if each.kind == "library"] or library_scopes()
    known = {each.folder: each for each in scopes if each.folder is not None}
    for folder, own in _merged(by_folder).items():
        yield from _groups_of(folder, own, known, libraries)


def _merged(
    folders: dict[Path, list[StructuredTextFile]],
) -> dict[Path, list[StructuredTextFile]]:
    """Move the files of a folder that holds actions only to the nearest folder around it."""
    found: dict[Path, list[StructuredTextFile]] = {}
    for folder in sorted(folders):
        target = next((each for each in folder.parents if each in found), None)
        if target is not None and all(map(_holds_actions, folders[folder])):
            found[target] += folders[folder]
        else:
            found[folder] = list(folders[folder])
    return found


def _holds_actions(file: StructuredTextFile) -> bool:
    return all(isinstance(unit, ActionUnit) for unit in file.units)


def _groups_of(
    folder: Path,
    files: Sequence[StructuredTextFile],
    known: dict[Path, NamedScope],
    libraries: Sequence[Scope],
) -> Iterator[_Group]:
    around = next((known[each] for each in (folder, *folder.parents) if each in known), None)
    outer = libraries if around is None else (around.scope,)
    is_library = around is not None and around.folder == folder and around.kind == "library"
    together = [file for file in files if is_library or not is_standard(file)]
    if together:
        yield _Group(folder.name, together, outer, is_library)
    alone = [file for file in files if file not in together]
    if alone:
        uses = program_uses(file.tokens.source.text for file in alone)
        declared = [declarations_of(file, uses) for file in alone]
        siblings = Scope(folder.name, declared, outer, dialect=IEC)
        for file in alone:
            yield _Group(Path(file.path).stem, [file], (siblings,))
