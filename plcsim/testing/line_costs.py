"""What the lines of compiled programs have cost in their cycles, in instructions.

Programs that are compiled with counters (`plcsim.program.structured_text.coverage`) tell it
exactly; what counting itself takes is not among it. INIT and EXIT are left out, as they are in the
instructions of a program.
"""

from __future__ import annotations

import sys
from collections import Counter
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.task import Unit
from st_types.errors import SourceError
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.task import Task
    from plcsim.program.structured_text.coverage import CountedModule

Lines = dict[str, list[tuple[int, int, str]]]
"""(line, instructions, text) of all lines that ran, by file."""

_LINKAGE: Final = "plcsim.program.structured_text.linkage"
_LIBRARIES: Final = ""


def line_costs_of(controller: Controller) -> LineCosts:
    """Return the costs of the lines of all programs of a controller, from now on."""
    linkage = sys.modules.get(_LINKAGE)  # not imported where nothing is in Structured Text
    found: Any = None if linkage is None else controller.context.settings(linkage.Linkage)
    return LineCosts([] if found is None else found.counted, controller.tasks)


class LineCosts:
    """Costs of the lines of programs and libraries.

    Args:
        modules: those that have counters.
        tasks: all of the controller.
    """

    def __init__(self, modules: Sequence[CountedModule], tasks: Sequence[Task]) -> None:
        self._modules = modules
        self._outside = [module.counts() for module in modules]
        if modules:
            for task in tasks:
                outside = {
                    u: partial(self._leave_out, task.units[u]) for u in (Unit.INIT, Unit.EXIT)
                }
                task.units = {**task.units, **outside}

    def _leave_out(self, unit: Callable[[], None]) -> None:
        before = [module.counts() for module in self._modules]
        try:
            unit()
        finally:
            for number, module in enumerate(self._modules):
                self._outside[number] += module.counts() - before[number]

    def of_task(self, name: str) -> Lines:
        """Return the lines of the program of a task."""
        costs: Counter[tuple[str, int]] = Counter()
        for module, outside in zip(self._modules, self._outside, strict=True):
            if module.task == name:
                costs.update(module.profile.cost_of_lines(module.counts() - outside))
        return _with_texts(costs)

    def of_libraries(self) -> Lines:
        """Return the lines of all libraries, whoever has called them."""
        return self.of_task(_LIBRARIES)


def _with_texts(costs: Mapping[tuple[str, int], int]) -> Lines:
    found: Lines = {}
    texts: dict[str, list[str]] = {}
    here = Path.cwd()
    for (path, line), cost in sorted(costs.items()):
        if path not in texts:
            texts[path] = _lines_of(Path(path))
        text = texts[path][line - 1].strip() if line <= len(texts[path]) else ""
        shown = Path(path).relative_to(here) if Path(path).is_relative_to(here) else path
        found.setdefault(str(shown), []).append((line, cost, text))
    return found


def _lines_of(file: Path) -> list[str]:
    """Return the lines of a source; none for helpers of the compiler, which have no file."""
    try:
        return Source.read(file).text.splitlines()
    except (OSError, SourceError):
        return []
