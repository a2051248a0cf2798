"""PROGRAMs that exist once, and what a CONFIGURATION connects to those that do not.

A PROGRAM that others name (`plcsim.program.structured_text.program_uses`) is a function block, and
its instance a variable that all see. The task that runs it calls that instance. Any other PROGRAM
has variables for each task; what ``PROGRAM p WITH t : Type (in := a, out => b)`` gives to its
inputs and takes from its outputs surrounds its body.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text.syntax.tree import (
    Configuration,
    ExpressionStatement,
    FunctionBlockUnit,
    ProgramUnit,
)
from st_types.syntax import expressions as syntax
from st_types.syntax.tree import (
    Declaration,
    FunctionBlockDeclaration,
    NamedType,
    VariableBlock,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.program.structured_text.program_uses import ProgramUses
    from plcsim.program.structured_text.syntax.tree import ProgramConfiguration, StructuredTextFile


class MeantProgram(NamedTuple):
    """Of several PROGRAMs the one that is checked and compiled.

    Attributes:
        name: of it; "" for all.
        instance: of it in a CONFIGURATION that connects variables to it; "" for none.
    """

    name: str = ""
    instance: str = ""

    def includes(self, unit: ProgramUnit) -> bool:
        """Return whether a PROGRAM is the one that is meant."""
        return self.name.upper() in ("", unit.name.upper())

    def configured(
        self, files: Sequence[StructuredTextFile]
    ) -> tuple[StructuredTextFile, ProgramConfiguration] | None:
        """Return what a CONFIGURATION says of the instance, with its file."""
        found = (each for each in _instances_in(files) if self.instance)
        name = self.instance.upper()
        return next((each for each in found if each[1].name.upper() == name), None)


ALL_PROGRAMS: Final = MeantProgram()


def as_block(unit: ProgramUnit) -> FunctionBlockUnit:
    """Return a PROGRAM as a function block."""
    declaration = FunctionBlockDeclaration(unit.at, unit.name, unit.blocks)
    return FunctionBlockUnit(unit.at, declaration, unit.body, unit.parts)


def instance_of(unit: ProgramUnit) -> VariableBlock:
    """Return the declaration of the one instance of a PROGRAM."""
    variable = Declaration(unit.at, unit.name, NamedType(unit.at, unit.name))
    return VariableBlock(unit.at, "VAR_GLOBAL", (), [variable])


def is_shared(unit: ProgramUnit, uses: ProgramUses) -> bool:
    """Return whether a PROGRAM exists once."""
    return unit.name.upper() in uses.named


def call_of(unit: ProgramUnit, connected: ProgramConfiguration | None) -> ExpressionStatement:
    """Return the call of the one instance of a PROGRAM."""
    arguments = () if connected is None else connected.arguments
    name = syntax.Name(unit.at, unit.name)
    return ExpressionStatement(unit.at, syntax.Call(unit.at, name, arguments))


def _instances_in(
    files: Sequence[StructuredTextFile],
) -> Iterator[tuple[StructuredTextFile, ProgramConfiguration]]:
    """Yield the programs that CONFIGURATIONs name, each with its file."""
    for file in files:
        for unit in file.units:
            if isinstance(unit, Configuration):
                for each in (unit, *unit.resources):
                    yield from ((file, program) for program in each.programs)
