"""Variables and functions as they come out of declarations."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from st_types.syntax.tree import (
        Declaration,
        DeclarationFile,
        FunctionDeclaration,
        VariableBlock,
    )
    from st_types.types.elementary import DataType


class Variable(NamedTuple):
    """A variable of a VAR block, a parameter of a function.

    Attributes:
        name: as declared.
        data_type: None where it has no layout: a type that is not here, ANY_NUM, ...
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


class Function(NamedTuple):
    """A FUNCTION: its parameters and its result, None where that has no layout."""

    name: str
    result: DataType[object] | None
    variables: tuple[Variable, ...]
    node: FunctionDeclaration
    file: DeclarationFile
