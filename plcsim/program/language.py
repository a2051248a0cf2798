"""What a programming language is to a controller.

A language finds the units of a program's folder, checks them before the run, and makes tasks of
them: a set of variables in PLC memory, and what runs for INIT, CYCLIC and EXIT. Everything beyond
that, the scan, tags, Modbus, tests, sees a `plcsim.core.task.Task` and not what it is written in.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.core.context import Context
    from plcsim.core.memory import Memory
    from plcsim.core.task import Task
    from plcsim.machine import Machine


class ProgramSource(NamedTuple):
    """A program on disk.

    Attributes:
        name: as plc.toml names the folder.
        folder: where it lies.
        files: those of its language that hold units.
        project: folder of the project.
        package: name under which Python finds the project's folder as a package.
    """

    name: str
    folder: Path
    files: Sequence[Path]
    project: Path
    package: str


class Site:
    """One controller as the programs find it that are put on it.

    Args:
        context: of the controller; its memory takes the programs' variables.
        counts_instructions: those of compiled programs; for the virtual clock, where no other
            measure of time means anything, and nothing else ends an endless loop.

    Attributes:
        context: as above.
    """

    def __init__(self, context: Context, *, counts_instructions: bool = False) -> None:
        self.context = context
        self._counts_instructions = counts_instructions

    @property
    def memory(self) -> Memory:
        """The PLC memory."""
        return self.context.memory

    @cached_property
    def machine(self) -> Machine:
        """What compiled programs run on; made when the first of them asks for it.

        Raises:
            MachineError: the host has no room for it.
        """
        from plcsim.machine import Machine  # noqa: PLC0415  # 20 ms that not every project needs

        return Machine(self.memory, fuel=self._counts_instructions)


class ProgramCode(Protocol):
    """A program that was loaded and checked; may run as several tasks, on several controllers."""

    def task(self, name: str, site: Site) -> Task:
        """Return a new task: its variables allocated, its units ready to run.

        Args:
            name: of the task.
            site: where it runs.

        Raises:
            ConfigurationError: the variables do not fit into the memory.
        """


class Language(Protocol):
    """A programming language.

    Attributes:
        name: as people call it, such as "Structured Text".
    """

    @property
    def name(self) -> str:
        """As people call it, such as "Structured Text"."""

    def units(self, folder: Path) -> Sequence[Path]:
        """Return the files of this language that hold units of the program in a folder.

        None makes it a program of another language.
        """

    def load(self, source: ProgramSource) -> ProgramCode:
        """Load a program and check what can be checked before it runs.

        Raises:
            ConfigurationError: something is wrong; all findings are told, with file and line.
        """
