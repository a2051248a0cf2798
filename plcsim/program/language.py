"""What a programming language is to a controller.

A language finds the units of a program's folder, checks them before the run, and makes tasks of
them: a set of variables in PLC memory, and what runs for INIT, CYCLIC and EXIT. Everything beyond
that, the scan, tags, Modbus, tests, sees a `plcsim.core.task.Task` and not what it is written in.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from plcsim.core.task import Task
    from plcsim.program.declarations import Declarations
    from plcsim.program.site import Site
    from plcsim.program.variables import DeclaredVariables
    from st_types.resolve.dialect import Dialect
    from st_types.resolve.scope import Scope
    from st_types.syntax.tree import DeclarationFile


class ProgramSource(NamedTuple):
    """A program on disk.

    Attributes:
        name: of the program, as task classes name it.
        folder: where it lies.
        files: those of its language that hold units.
        declarations: of the project.
        scope: what the program declares and sees.
        shared: the global variables of the project.
        only: of several programs in the files the one that is meant, "" where they are one; what
            the files declare belongs to the project then.
        instance: of that one, where a CONFIGURATION connects variables to it; "" for none.
    """

    name: str
    folder: Path
    files: Sequence[Path]
    declarations: Declarations
    scope: Scope
    shared: DeclaredVariables
    only: str = ""
    instance: str = ""


class PlacedProgram(NamedTuple):
    """A program whose variables have their place on a controller.

    Attributes:
        compile: makes machine code of it, which a cache keeps, and returns whether it was not in
            the cache; a copy of this process may do that.
        task: makes its units ready to run; called after all programs were placed.
    """

    compile: Callable[[], bool]
    task: Callable[[], Task]


class ProgramCode(Protocol):
    """A program that was loaded and checked; may run as several tasks, on several controllers.

    Attributes:
        warnings: about its text, each with file, line, column and caret.
    """

    @property
    def warnings(self) -> Sequence[str]:
        """What was found in its text that is no error."""

    def place(self, name: str, site: Site) -> PlacedProgram:
        """Give a new task its variables.

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
        load_cost: what a byte of source takes, beside other languages, where loading runs nothing
            of the program and leaves what it compiles in a cache; 0 where that is not so.
    """

    @property
    def name(self) -> str:
        """As people call it, such as "Structured Text"."""

    @property
    def load_cost(self) -> int:
        """What a byte of source takes, beside other languages; 0 where nothing is compiled."""

    def units(self, files: Sequence[Path]) -> Sequence[Path]:
        """Return those files of a program that are in this language and hold units.

        None makes it a program of another language.

        Args:
            files: all that belong to the program, of any kind.
        """

    def declarations(self, files: Sequence[Path]) -> Sequence[DeclarationFile]:
        """Return what the files of a program declare for all of it, as a .var file does.

        What is wrong in their text is in their ``diagnostics``.

        Raises:
            ConfigurationError: a file cannot be read.
        """

    def dialect(self, declared: Sequence[DeclarationFile]) -> Dialect:
        """Return the rules of a program, by what `declarations` has returned."""

    def load(self, source: ProgramSource) -> ProgramCode:
        """Load a program and check what can be checked before it runs.

        Raises:
            ConfigurationError: something is wrong; all findings are told, with file and line.
        """
