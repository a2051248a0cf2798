"""What of an Automation Studio project runs, what is idle, and what cannot run."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.errors import ConfigurationError
from plcsim.project.assembly import load, still_controller, with_controller
from plcsim.project.automation_studio import problems
from plcsim.project.automation_studio.io_channels import unmapped
from plcsim.project.automation_studio.stub_calls import stub_calls
from plcsim.project.extension import check_settings

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from plcsim.core.controller import Controller
    from plcsim.project.assembly import Application
    from plcsim.project.automation_studio.finding import Finding
    from plcsim.project.automation_studio.reader import AutomationStudioProject
    from plcsim.project.automation_studio.stub_calls import StubCall
    from plcsim.project.plc_toml import Project
    from plcsim.project.tables import ProgramEntry, TaskClassEntry


class TaskRow(NamedTuple):
    """A task.

    Attributes:
        task_class: that it runs in.
        entry: its name and the program.
        languages: that the program is written in.
        bytes: of its variables, 0 where it cannot run.
        reasons: why it cannot run, none where it can.
        stubs: the idle blocks and functions that its program names.
    """

    task_class: TaskClassEntry
    entry: ProgramEntry
    languages: tuple[str, ...]
    bytes: int
    reasons: Sequence[str]
    stubs: tuple[StubCall, ...]


class Survey(NamedTuple):
    """A project, looked through.

    Attributes:
        project: as it was read.
        rows: its tasks, in the order in which they run.
        skipped: tasks that plc.toml takes out, and those that Cpu.sw disables.
        stubs: idle blocks and functions that programs and libraries name.
        findings: what is wrong in the files of Automation Studio.
        common: what is wrong in what several programs see.
        warnings: of the sources.
        controller: of the tasks that can run, None where none can.
        trouble: why there is no controller of these tasks.
        unmapped: what is wrong in the maps of I/O channels and of variables.
        settings: what is wrong in the tables of plc.toml for extensions, and in files they name.
        notes: what of these tables will not work on this host.
    """

    project: Project
    rows: tuple[TaskRow, ...]
    skipped: tuple[str, ...]
    stubs: tuple[StubCall, ...]
    findings: tuple[Finding, ...]
    common: Sequence[str]
    warnings: Sequence[str]
    controller: Controller | None
    trouble: Sequence[str]
    unmapped: Sequence[str]
    settings: Sequence[str]
    notes: Sequence[str]

    @property
    def is_right(self) -> bool:
        """Whether everything runs."""
        errors = [each for each in self.findings if each.severity == "error"]
        cannot = [row for row in self.rows if row.reasons]
        return not (errors or cannot or self.common or self.trouble or self.settings)


def survey(project: Project, found: AutomationStudioProject) -> Survey:
    """Look through an Automation Studio project: load what can be loaded of it.

    Args:
        project: as it was read.
        found: its Automation Studio project.
    """
    application, controller = with_controller(load(replace(project, keep_going=True)))
    catalogue = application.setup.catalogue
    calls = [] if catalogue is None else stub_calls(catalogue, _sources(project))
    trouble: Sequence[str] = ()
    if controller is None:
        controller, trouble = _controller(application)
    sizes = (
        {} if controller is None else {t.name: t.variables.data_type.size for t in controller.tasks}
    )
    rows = []
    for task_class in project.classes:
        for entry in task_class.programs:
            stubs = tuple(call for call in calls if call.program == entry.source)
            reasons = application.left_out.get(entry.source, ())
            size = sizes.get(entry.name, 0)
            languages = _languages(project, entry)
            rows.append(TaskRow(task_class, entry, languages, size, reasons, stubs))
    settings, notes = _settings(project, controller)
    application.unload()
    names = {row.entry.name for row in rows}
    skipped = [task.name for task in found.tasks if task.name not in names]
    return Survey(
        project,
        tuple(rows),
        (*skipped, *found.configuration.software.disabled),
        tuple(calls),
        tuple(problems.of_project(found)),
        application.common,
        application.warnings,
        controller,
        trouble,
        () if controller is None else unmapped(controller, application.maps),
        settings,
        notes,
    )


def _settings(
    project: Project, controller: Controller | None
) -> tuple[Sequence[str], Sequence[str]]:
    """Return what is wrong in the settings of extensions, and what this host makes of them."""
    if controller is None:
        return (), ()
    try:
        return (), check_settings(project.extensions, controller)
    except ConfigurationError as err:
        return err.findings, ()


def _controller(application: Application) -> tuple[Controller | None, Sequence[str]]:
    """Return a controller of what can run; or None, and why."""
    if not application.setup.classes:
        return None, ()
    try:
        return still_controller(application), ()
    except ConfigurationError as err:
        return None, err.findings


def _languages(project: Project, entry: ProgramEntry) -> tuple[str, ...]:
    place = project.layout.programs.get(entry.source)
    return () if place is None else tuple(problems.languages(place.own.files))


def _sources(project: Project) -> Mapping[str, Sequence[Path]]:
    """Return the files of programs, and of libraries with source, by their names."""
    layout = project.layout
    programs = {name: place.own.files for name, place in layout.programs.items()}
    own = [place for place in layout.libraries if not place.is_vendor]
    return {**programs, **{f"library {place.name}": place.files for place in own}}
