"""What has parameters ARRAY[*] is compiled for each set of bounds that it is called with.

So their bounds are known: an index is checked as in any other array, and LOWER_BOUND and
UPPER_BOUND are numbers. The price is code, as with methods (docs/decisions/0015).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeVar

from st_types.resolve.scope import Scope
from st_types.syntax.expressions import Literal
from st_types.syntax.literals import Constant
from st_types.syntax.tree import (
    ArraySpecification,
    Declaration,
    DeclarationFile,
    FunctionDeclaration,
    OpenArraySpecification,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from plcsim.program.structured_text.syntax.tree import (
        FunctionBlockUnit,
        FunctionUnit,
        MethodUnit,
        StructuredTextFile,
    )
    from st_types.resolve.declared import DeclaredFunction, DeclaredFunctionBlock
    from st_types.syntax.tree import FunctionBlockDeclaration
    from st_types.types.derived import ArrayType

T = TypeVar("T", "DeclaredFunction", "DeclaredFunctionBlock")

_PARAMETERS = frozenset(["VAR_INPUT", "VAR_IN_OUT", "VAR_OUTPUT"])
_BY_ADDRESS = frozenset(["VAR_IN_OUT"])


def takes_any_bounds(node: FunctionDeclaration | FunctionBlockDeclaration) -> bool:
    """Return whether a parameter of a function, a VAR_IN_OUT of a block, is an ARRAY[*]."""
    return any(type(each.specification) is OpenArraySpecification for each in parameters(node))


def parameters(node: FunctionDeclaration | FunctionBlockDeclaration) -> Iterator[Declaration]:
    """Yield the declarations of what may take arrays of any bounds, and of those beside it."""
    sections = _PARAMETERS if isinstance(node, FunctionDeclaration) else _BY_ADDRESS
    for block in node.blocks:
        if block.section in sections:
            yield from block.declarations


def with_any_bounds(node: FunctionBlockDeclaration) -> FunctionBlockDeclaration:
    """Return a function block as its instances know it: an array of any bounds is an address."""
    blocks = [
        replace(block, declarations=[_of_one_element(each) for each in block.declarations])
        if block.section in _BY_ADDRESS
        else block
        for block in node.blocks
    ]
    return replace(node, blocks=blocks)


def _of_one_element(node: Declaration) -> Declaration:
    specification = node.specification
    if type(specification) is not OpenArraySpecification:
        return node
    at = specification.at
    bounds = [(_number(at, 0), _number(at, 0))] * specification.dimensions
    return replace(node, specification=ArraySpecification(at, bounds, specification.element))


@dataclass(slots=True, eq=False)
class OpenFunction:
    """A function, a method or a function block that takes arrays of any bounds.

    Attributes:
        unit: its text.
        file: where it stands.
        scope: around it.
    """

    unit: FunctionUnit | MethodUnit | FunctionBlockUnit
    file: StructuredTextFile
    scope: Scope
    _made: dict[str, Any] = field(default_factory=dict)

    def made_for(self, arrays: Mapping[str, ArrayType[object]]) -> DeclaredFunction | None:
        """Return the function for arrays; its name tells their bounds. None after an error.

        Args:
            arrays: what is given, by the names of the parameters as declared.
        """
        return self._found(arrays, Scope.find_function)

    def block_for(self, arrays: Mapping[str, ArrayType[object]]) -> DeclaredFunctionBlock | None:
        """Return the function block for arrays, likewise; its data block is laid out as any."""
        return self._found(arrays, Scope.find_function_block)

    def _found(
        self, arrays: Mapping[str, ArrayType[object]], find: Callable[[Scope, str], T | None]
    ) -> T | None:
        bounds = "; ".join(
            ", ".join(f"{low}..{high}" for low, high in array.bounds) for array in arrays.values()
        )
        name = self.unit.declaration.name
        label = f"{name}[{bounds}]"
        if label not in self._made:
            found = find(self._around(arrays), name)
            self._made[label] = None if found is None else found._replace(name=label)
        made: T | None = self._made[label]
        return made

    def _around(self, arrays: Mapping[str, ArrayType[object]]) -> Scope:
        """Return a scope that declares it for some arrays."""
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
        return around


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
