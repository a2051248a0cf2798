"""What comes out of declarations: variables, types, functions, function blocks."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from st_types.resolve.scope import Scope
    from st_types.syntax.tree import (
        Declaration,
        DeclarationFile,
        FunctionBlockDeclaration,
        FunctionDeclaration,
        VariableBlock,
    )
    from st_types.types.derived import DataBlockType
    from st_types.types.elementary import DataType


class DeclaredVariable(NamedTuple):
    """A variable of a VAR block, a parameter of a function or a function block.

    Attributes:
        name: as declared.
        data_type: None where it has no layout: a type that is not here, ANY_NUM, ... Of a
            VAR_IN_OUT the declared type, not the reference that lies in the data block.
        initial: value after a restart; None for that of the type.
        block: the block it stands in, with its section and its qualifiers.
        node: its declaration.
        file: where it stands.
    """

    name: str
    data_type: DataType[object] | None
    initial: object
    block: VariableBlock
    node: Declaration
    file: DeclarationFile

    @property
    def is_constant(self) -> bool:
        """Whether it stands in a VAR CONSTANT."""
        return "CONSTANT" in self.block.qualifiers

    @property
    def is_retained(self) -> bool:
        """Whether it stands in a VAR RETAIN."""
        return "RETAIN" in self.block.qualifiers


class DeclaredType(NamedTuple):
    """A type of a TYPE block; ``data_type`` is None where it has no layout."""

    name: str
    data_type: DataType[object] | None
    node: Declaration
    file: DeclarationFile


class DeclaredFunction(NamedTuple):
    """A FUNCTION.

    Attributes:
        name: as declared.
        result: None where it has none, or one without a layout.
        scope: its variables, and around them what is declared where it stands.
        node: its declaration.
        file: where it stands.
    """

    name: str
    result: DataType[object] | None
    scope: Scope
    node: FunctionDeclaration
    file: DeclarationFile

    @property
    def variables(self) -> tuple[DeclaredVariable, ...]:
        """Its parameters and other variables, in order."""
        return self.scope.variables


class DeclaredFunctionBlock(NamedTuple):
    """A FUNCTION_BLOCK.

    Attributes:
        name: as declared.
        data_type: its data block, None where that has no layout.
        scope: its variables, and around them what is declared where it stands.
        node: its declaration.
        file: where it stands.
    """

    name: str
    data_type: DataBlockType[object] | None
    scope: Scope
    node: FunctionBlockDeclaration
    file: DeclarationFile

    @property
    def variables(self) -> tuple[DeclaredVariable, ...]:
        """Its parameters and other variables, VAR_TEMP and constants too, in order."""
        return self.scope.variables
