"""What has parameters ARRAY[*] is compiled for each set of bounds that it is called with.

So their bounds are known: an index is checked as in any other array, and LOWER_BOUND and
UPPER_BOUND are numbers. The price is code, as with methods (docs/decisions/0015).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from st_types.resolve.scope import Scope
from st_types.syntax.expressions import Literal
from st_types.syntax.literals import Constant
from st_types.syntax.tree import (
    ArraySpecification,
    Declaration,
    DeclarationFile,
    OpenArraySpecification,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from plcsim.program.structured_text.syntax.tree import (
        FunctionUnit,
        MethodUnit,
        StructuredTextFile,
    )
    from st_types.resolve.declared import DeclaredFunction
    from st_types.syntax.tree import FunctionDeclaration
    from st_types.types.derived import ArrayType

_PARAMETERS = frozenset(["VAR_INPUT", "VAR_IN_OUT", "VAR_OUTPUT"])


def takes_any_bounds(node: FunctionDeclaration) -> bool:
    """Return whether a function has a parameter that is an ARRAY[*]."""
    return any(type(each.specification) is OpenArraySpecification for each in parameters(node))


def parameters(node: FunctionDeclaration) -> Iterator[Declaration]:
    """Yield the declarations of the parameters of a function."""
    for block in node.blocks:
        if block.section in _PARAMETERS:
            yield from block.declarations


@dataclass(slots=True, eq=False)
class OpenFunction:
    """A function or a method that takes arrays of any bounds.

    Attributes:
        unit: its text.
        file: where it stands.
        scope: around it.
    """

    unit: FunctionUnit | MethodUnit
    file: StructuredTextFile
    scope: Scope
    _made: dict[str, DeclaredFunction | None] = field(default_factory=dict)

    def made_for(self, arrays: Mapping[str, ArrayType[object]]) -> DeclaredFunction | None:
        """Return the function for arrays; its name tells their bounds. None after an error.

        Args:
            arrays: what is given, by the names of the parameters as declared.
        """
        node = self.unit.declaration
        bounds = "; ".join(
            ", ".join(f"{low}..{high}" for low, high in array.bounds) for array in arrays.values()
        )
        label = f"{node.name}[{bounds}]"
        if label not in self._made:
            self._made[label] = self._declared(label, arrays)
        return self._made[label]

    def _declared(
        self, label: str, arrays: Mapping[str, ArrayType[object]]
    ) -> DeclaredFunction | None:
        node = self.unit.declaration
        blocks = [
            replace(block, declarations=[_closed(each, arrays) for each in block.declarations])
            for block in node.blocks
        ]
        tokens, diagnostics = self.file.tokens, self.file.diagnostics
        file = DeclarationFile([replace(node, blocks=blocks)], "", tokens, diagnostics)
        dialect, strict = self.scope.dialect, self.scope.strict
        around = Scope(node.name, [file], (self.scope,), dialect=dialect, strict=strict)
        around.check()
        found = around.find_function(node.name)
        return None if found is None else found._replace(name=label)


def _closed(node: Declaration, arrays: Mapping[str, ArrayType[object]]) -> Declaration:
    """Return a parameter with the bounds of what is given for it."""
    specification, array = node.specification, arrays.get(node.name)
    if type(specification) is not OpenArraySpecification or array is None:
        return node
    at = specification.at
    bounds = [(_number(at, low), _number(at, high)) for low, high in array.bounds]
    return replace(node, specification=ArraySpecification(at, bounds, specification.element))


def _number(at: int, value: int) -> Literal:
    return Literal(at, str(value), Constant("ANY_INT", value))
