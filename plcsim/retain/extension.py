"""The extension of the table [retain]: takes what the last run has left, and tells the service."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING, Final

from plcsim.core.logbook import Severity
from plcsim.project.extension import Attachment, Extension
from plcsim.retain.errors import RetainError
from plcsim.retain.fitting import fit
from plcsim.retain.generations import NAMES, Generations
from plcsim.retain.settings import RetainProject, read_settings
from plcsim.shared_image.directory import describe_type

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.controller import Controller
    from plcsim.settings.table import Table

MOST_LISTED: Final = 20
"""So many values that do not fit are listed in the logbook; all are in the copies of the files."""

LEFT: Final = ".left"
"""Ending of the copy of a file whose values did not all fit."""


class RetainExtension(Extension):
    """Retained variables over the end of the process."""

    def read(self, table: Table) -> RetainProject:
        """Return the settings."""
        return read_settings(table)

    def in_process(self, settings: RetainProject, ip: str) -> RetainProject:
        """Return the settings for the virtual clock, where nothing is read or written."""
        return settings._replace(is_off=True)

    def service(self, settings: RetainProject) -> str:
        """Return the module that writes the files."""
        return "" if settings.is_off else "plcsim.retain.service"

    def stopping_s(self, settings: RetainProject) -> float:
        """Return the time for the last generation; a slow disk has it all."""
        return 10.0

    def endpoint(self, settings: RetainProject) -> str:
        """Return the folder."""
        return str(settings.folder)

    def attach(self, settings: RetainProject, controller: Controller) -> Attachment:
        """Hand over what the last run has left."""
        if settings.is_off:
            return Attachment()
        _take(settings, controller)
        tags = controller.retained.tags
        given = {
            "folder": str(settings.folder),
            "period_ns": settings.period_ns,
            "variables": [[t.path, describe_type(t.data_type), t.address] for t in tags],
        }
        return Attachment(given, tags)

    def check(self, settings: RetainProject, controller: Controller) -> Sequence[str]:
        """Return what of the files does not fit."""
        if not controller.retained.tags:
            return ["retain: no variable of the project is RETAIN"]
        try:
            latest, wrong = Generations(settings.folder).latest()
        except RetainError as err:
            return [str(err)]
        left = [] if latest is None else fit(latest, controller.retained.tags).left
        return [*wrong, *_listed(left)]


def _take(settings: RetainProject, controller: Controller) -> None:
    """Let the controller boot with what fits; the rest is told and kept aside."""
    generations = Generations(settings.folder)
    try:
        latest, wrong = generations.latest()
    except RetainError as err:
        controller.log(Severity.ERROR, "retain", str(err))
        return
    for line in wrong:
        controller.log(Severity.WARNING, "retain", f"{line}; it is left out")
    if latest is None:
        text = "both files are unusable" if len(wrong) == len(NAMES) else "there is nothing yet"
        controller.log(Severity.INFORMATION, "retain", f"{text}: initial values are used")
    else:
        found = fit(latest, controller.retained.tags)
        controller.retained.kept = found.taken
        for line in _listed(found.left):
            controller.log(Severity.WARNING, "retain", line)
        wrong += found.left
    if wrong:
        _keep_aside(settings, controller)


def _keep_aside(settings: RetainProject, controller: Controller) -> None:
    """Copy the files before the service writes over them."""
    try:
        for name in NAMES:
            file = settings.folder / name
            if file.exists():
                shutil.copyfile(file, file.with_name(name + LEFT))
    except OSError as err:
        controller.log(Severity.ERROR, "retain", f"the files cannot be kept aside: {err}")
        return
    text = f"the files as they were are kept as {NAMES[0]}{LEFT} and {NAMES[1]}{LEFT}"
    controller.log(Severity.INFORMATION, "retain", text)


def _listed(left: Sequence[str]) -> list[str]:
    lines = [f"{line}; its value is not taken" for line in left[:MOST_LISTED]]
    if len(left) > MOST_LISTED:
        lines.append(f"{len(left) - MOST_LISTED} more values are not taken")
    return lines


EXTENSION = RetainExtension()
