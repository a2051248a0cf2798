"""What keeps an Automation Studio project, or a task of it, from running."""

from __future__ import annotations

from pathlib import PureWindowsPath
from typing import TYPE_CHECKING, Final

from plcsim.library.library import SUFFIXES_OF_C
from plcsim.program.structured_text import names

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from plcsim.project.automation_studio.finding import Finding
    from plcsim.project.automation_studio.reader import AutomationStudioProject, ProgramTask

_SHORT: Final = {
    "Function Block Diagram": "FBD",
    "Instruction List": "IL",
    "Ladder Diagram": "Ladder",
    "Sequential Function Chart": "SFC",
    "Structured Text": "ST",
}
"""Names as Automation Studio's users say them, for a narrow table."""

LANGUAGES: Final = {
    **{suffix: _SHORT.get(name, name) for suffix, name in names.LANGUAGES.items()},
    **dict.fromkeys(SUFFIXES_OF_C, "C++"),
    ".c": "C",
}
"""Languages of programs by the suffixes of their files, in small letters."""

_BUILT: Final = frozenset([*LANGUAGES, ".typ", ".var", ".fun", ".h", ".hpp"])


def of_project(project: AutomationStudioProject) -> list[Finding]:
    """Return what is wrong in the files of a project, without what is missing and not needed."""
    return [each for each in project.findings if not each.missing or _is_built(each.missing)]


def _is_built(name: str) -> bool:
    """Whether a missing object takes part in the build: a folder, or a file that is compiled."""
    suffix = PureWindowsPath(name).suffix.lower()
    return suffix in _BUILT or not suffix


def of_task(task: ProgramTask, file: Path) -> tuple[str, ...]:
    """Return what is wrong with the program of a task before it is loaded.

    Args:
        task: as Cpu.sw has it.
        file: Cpu.sw.
    """
    if task.program is None:
        return (f"{file}:{task.line}: error: the logical view has no program {task.source}",)
    return tuple(_as_error(each) for each in task.program.missing if _is_needed(each))


def _is_needed(finding: Finding) -> bool:
    return not finding.missing or _is_built(finding.missing)


def _as_error(finding: Finding) -> str:
    return f"{finding.location}: error: {finding.message}"


def broken(
    project: AutomationStudioProject, tasks: Iterable[ProgramTask]
) -> dict[str, tuple[str, ...]]:
    """Return what is wrong with programs before they are loaded, by their sources."""
    file = project.configuration.software_file
    found = {task.source: of_task(task, file) for task in tasks}
    return {source: texts for source, texts in found.items() if texts}


def languages(files: Iterable[Path]) -> Iterator[str]:
    """Yield the languages that the files of a program are written in."""
    suffixes = {file.suffix.lower() for file in files}
    yield from sorted({LANGUAGES[suffix] for suffix in suffixes & LANGUAGES.keys()})
