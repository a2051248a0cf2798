"""What files of Structured Text declare, for the scope of their program."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text.check.classes import interface_type
from plcsim.program.structured_text.check.open_arrays import takes_any_bounds, with_any_bounds
from plcsim.program.structured_text.check.programs import as_block, instance_of, is_shared
from plcsim.program.structured_text.program_uses import NO_USES
from plcsim.program.structured_text.syntax.tree import (
    Configuration,
    FunctionBlockUnit,
    FunctionUnit,
    InterfaceUnit,
    ProgramUnit,
)
from st_types.resolve.scope import Scope
from st_types.syntax.tree import (
    DeclarationFile,
    FunctionDeclaration,
    TypeBlock,
    VariableBlock,
)

if TYPE_CHECKING:
    from plcsim.program.structured_text.program_uses import ProgramUses
    from plcsim.program.structured_text.syntax.tree import StructuredTextFile
    from st_types.syntax.tree import Item


def declarations_of(file: StructuredTextFile, uses: ProgramUses = NO_USES) -> DeclarationFile:
    """Return what a file of Structured Text declares, for a `Scope`.

    Functions and function blocks without VAR blocks of their own are declared in a .fun file.

    Args:
        file: parsed.
        uses: which PROGRAMs others name.
    """
    items: list[Item] = [*file.hidden]
    for unit in file.units:
        if isinstance(unit, TypeBlock | VariableBlock):
            items.append(unit)
        elif isinstance(unit, FunctionBlockUnit) and is_open_block(unit):
            items.append(with_any_bounds(unit.declaration))
        elif isinstance(unit, FunctionUnit | FunctionBlockUnit) and _is_declared(unit):
            items.append(unit.declaration)
        elif isinstance(unit, ProgramUnit) and is_shared(unit, uses):
            items += [as_block(unit).declaration, instance_of(unit)]
        elif isinstance(unit, InterfaceUnit):
            items.append(interface_type(unit))
        elif isinstance(unit, Configuration):
            items += unit.blocks
            items += [block for resource in unit.resources for block in resource.blocks]
    return DeclarationFile(items, "", file.tokens, file.diagnostics)


def unit_scope(
    unit: ProgramUnit, file: StructuredTextFile, outer: Scope, uses: ProgramUses
) -> Scope | None:
    """Return the scope of the variables that a PROGRAM has for each task, None for none."""
    if not unit.blocks or is_shared(unit, uses):
        return None
    declared = DeclarationFile(unit.blocks, "", file.tokens, file.diagnostics)
    return Scope(unit.name, [declared], (outer,), dialect=outer.dialect, strict=outer.strict)


def is_open_block(unit: FunctionBlockUnit) -> bool:
    """Return whether a function block, one without methods and actions, takes ARRAY[*]."""
    is_plain = not (unit.bases or unit.words or unit.parts)
    return is_plain and takes_any_bounds(unit.declaration)


def _is_declared(unit: FunctionUnit | FunctionBlockUnit) -> bool:
    """Return True for a function (block) that has its parameters or its result beside its body.

    What takes arrays of any bounds is declared for each call.
    """
    declaration = unit.declaration
    if isinstance(declaration, FunctionDeclaration) and takes_any_bounds(declaration):
        return False
    if isinstance(unit, FunctionBlockUnit) and (unit.bases or unit.words or unit.parts):
        return True
    has_result = isinstance(declaration, FunctionDeclaration) and declaration.result is not None
    return has_result or bool(declaration.blocks)
