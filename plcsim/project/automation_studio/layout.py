"""The layout of an Automation Studio project: whose names its programs see."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.ansi_c.prebuilt import has_objects
from plcsim.program.layout import (
    DeclarationPlace,
    LibraryPlace,
    MadeVariable,
    ProgramPlace,
    SourceLayout,
    has_sources,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from plcsim.library.library import CBuild
    from plcsim.project.automation_studio.logical_view import Package, SourceFolder
    from plcsim.project.automation_studio.reader import AutomationStudioProject, ProgramTask

ALL_VENDORS: Final = "*"


def layout_of(
    project: AutomationStudioProject,
    folder: Path,
    tasks: Iterable[ProgramTask],
    stubs: frozenset[str] = frozenset([ALL_VENDORS]),
) -> SourceLayout:
    """Return the layout of a project.

    Args:
        project: as it was read.
        folder: where the file lies that names it.
        tasks: those whose programs are to run.
        stubs: see `plcsim.program.layout.SourceLayout`.
    """
    return SourceLayout(
        folder.resolve(),
        DeclarationPlace(project.name, _public_files(project.view.root)),
        _programs(tasks),
        tuple(map(_library, project.view.libraries)),
        tuple(MadeVariable(each.name, each.data_type) for each in project.mapp_variables),
        _c_build(project),
        stubs,
    )


def _public_files(root: Package) -> tuple[Path, ...]:
    """Return what every program sees: the files of all packages, wherever they lie."""
    return tuple(file.resolve() for package in root.walk() for file in package.files)


def _programs(tasks: Iterable[ProgramTask]) -> Mapping[str, ProgramPlace]:
    programs = {}
    for task in tasks:
        if task.program is not None:
            program = task.program
            own = DeclarationPlace(program.name, _resolved(program.files))
            around = tuple(_private(each) for each in task.around if each.private_files)
            programs[task.source] = ProgramPlace(program.folder.resolve(), own, around)
    return programs


def _private(package: Package) -> DeclarationPlace:
    name = package.path[-1] if package.path else package.folder.name
    return DeclarationPlace(name, _resolved(package.private_files))


def _resolved(files: Iterable[Path]) -> tuple[Path, ...]:
    return tuple(file.resolve() for file in files)


def _library(library: SourceFolder) -> LibraryPlace:
    folder, files = library.folder.resolve(), _resolved(library.files)
    package = "_".join(("library", *library.path))
    needs = tuple(each.name.upper() for each in library.dependencies)
    is_vendor = library.is_binary or (not has_sources(files) and has_objects(folder))
    return LibraryPlace(library.name, folder, files, package, is_vendor, needs)


def _c_build(project: AutomationStudioProject) -> CBuild:
    """Return how C is compiled: headers that libraries list are found by all programs."""
    build = project.configuration.build
    listed = [file for each in project.view.libraries for file in each.files]
    own = [file.parent.resolve() for file in listed if file.suffix.lower() in (".h", ".hpp")]
    return build._replace(include_folders=tuple(dict.fromkeys((*build.include_folders, *own))))
