"""Projects of IEC 61131-3: the programs that stand in files, the tasks that a CONFIGURATION names.

A file as IEC 61131-3 has it tells by its CONFIGURATION which programs run in which tasks: they
become task classes, the highest priority first. Without one every PROGRAM runs in class 1. A
project whose plc.toml names no task class is made of the .st files beside it in the same way. A
file of Automation Studio runs with all files in its folder; a file of a project sees what the
project declares.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from plcsim.library.library import declarations_of, sources_in
from plcsim.program.layout import DeclarationPlace, ProgramPlace, SourceLayout, unit_place
from plcsim.program.structured_text.dialect import is_standard
from plcsim.program.structured_text.names import SUFFIXES
from plcsim.program.structured_text.sources import check_syntax, read_files
from plcsim.project.assembly import load
from plcsim.project.configuration import DEFAULT_CYCLE_NS, class_entry, configured_classes
from plcsim.project.plc_toml import Project, read_project
from plcsim.project.project_file import project_file
from plcsim.project.tables import PlcSettings, ProgramEntry

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.project.assembly import Application
    from plcsim.project.tables import TaskClassEntry


def load_file(path: Path, cycle_ns: int | None = None) -> Application:
    """Load the programs of a file.

    Args:
        path: of a file with a PROGRAM.
        cycle_ns: cycle time of what no TASK has; 10 ms by default.

    Raises:
        ConfigurationError: it cannot be read, or is wrong; all findings are told.
    """
    return load(project_of_file(path, cycle_ns))


def project_of_file(path: Path, cycle_ns: int | None = None) -> Project:
    """Return the project that a file is, or its part of the project that it belongs to.

    Raises:
        ConfigurationError: the file or the project cannot be read, or is wrong.
    """
    found = _part_of_project(path)
    if found is not None:
        return found if cycle_ns is None else _with_cycle(found, cycle_ns)
    files = read_files([path])
    check_syntax(files)
    if not is_standard(files[0].parsed):
        return _of_automation_studio(path, cycle_ns or DEFAULT_CYCLE_NS)
    units = _units_with(path)
    classes = configured_classes(units, cycle_ns or DEFAULT_CYCLE_NS)
    common = DeclarationPlace(path.stem, (*units, *declarations_of(sources_in(path.parent))))
    sources = dict.fromkeys(p.source for each in classes for p in each.programs)
    places = {source: unit_place(path.parent, source) for source in sources}
    return _named(path.stem, classes, SourceLayout(path.parent, common, places))


def _units_with(path: Path) -> list[Path]:
    """Return the file, with all others of its project where it is one of TwinCAT."""
    if not path.suffix.lower().startswith(".tc"):
        return [path]
    root = next((each for each in path.parents if any(each.glob("*.plcproj"))), path.parent)
    return sorted(file for file in root.rglob("*.[tT][cC]*") if file.suffix.lower() in SUFFIXES)


def _of_automation_studio(path: Path, cycle_ns: int) -> Project:
    """Return a project of the program in the folder of a file; what else lies there is no part."""
    name = path.resolve().parent.name
    files = sources_in(path.parent)
    texts = [each for each in files if each.suffix.lower() == path.suffix.lower()]
    own = DeclarationPlace(name, (*declarations_of(files), *texts))
    layout = SourceLayout(
        path.parent, DeclarationPlace(name, ()), {name: ProgramPlace(path.parent, own)}
    )
    return _named(name, (class_entry(1, cycle_ns, [ProgramEntry(name, name)]),), layout)


def _named(name: str, classes: tuple[TaskClassEntry, ...], layout: SourceLayout) -> Project:
    return Project(layout.folder, name, PlcSettings(), classes, layout)


def _part_of_project(path: Path) -> Project | None:
    """Return the part of a project that runs a file, None where it is in none.

    Raises:
        ConfigurationError: the project is wrong.
    """
    path = path.resolve()
    folder = next((each for each in path.parents if project_file(each) is not None), None)
    if folder is None:
        return None
    project = read_project(folder)
    programs = project.layout.programs
    common = project.layout.common.files
    meant = [
        name
        for name, place in programs.items()
        if path in (place.own.files if not place.only else common)
    ]
    return project.without([each for each in programs if each not in meant], ()) if meant else None


def _with_cycle(project: Project, cycle_ns: int) -> Project:
    classes = [each._replace(cycle_ns=cycle_ns, tolerance_ns=cycle_ns) for each in project.classes]
    return replace(project, classes=tuple(classes))
