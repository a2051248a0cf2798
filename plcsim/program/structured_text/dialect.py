"""Which dialect a file of Structured Text is written in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text.syntax.tree import (
    Configuration,
    FunctionBlockUnit,
    FunctionUnit,
    ProgramUnit,
)
from st_types.syntax.tree import VariableBlock

if TYPE_CHECKING:
    from plcsim.program.structured_text.syntax.tree import StructuredTextFile, Unit


def is_standard(file: StructuredTextFile) -> bool:
    """Return True for a file as IEC 61131-3 has them, False for one of Automation Studio.

    Automation Studio keeps declarations in files of their own, so a VAR block in a file of
    Structured Text tells.
    """
    return any(map(_declares, file.units))


def _declares(unit: Unit) -> bool:
    if isinstance(unit, ProgramUnit):
        return bool(unit.blocks)
    if isinstance(unit, FunctionUnit | FunctionBlockUnit):
        return bool(unit.declaration.blocks)
    return isinstance(unit, Configuration | VariableBlock)
