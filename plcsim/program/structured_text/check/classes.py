"""Function blocks with methods: what they extend, and the methods that each of them has.

A method is compiled for each function block that has it, its own and what it inherits: in the code
for one, calls through THIS mean that one's methods, so overriding needs no table at run time. The
price is code, and that a pointer or a reference to a function block calls the methods of its
declared type.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text.check.open_arrays import OpenFunction, takes_any_bounds
from plcsim.program.structured_text.syntax.tree import MethodUnit
from st_types.resolve.scope import Scope
from st_types.syntax.tree import (
    Declaration,
    DeclarationFile,
    FunctionDeclaration,
    NamedType,
    StructSpecification,
    TypeBlock,
    VariableBlock,
)

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from plcsim.program.structured_text.syntax.tree import (
        ActionUnit,
        FunctionBlockUnit,
        InterfaceUnit,
        StructuredTextFile,
    )
    from st_types.resolve.declared import DeclaredFunction, DeclaredFunctionBlock
    from st_types.types.derived import ArrayType, DataBlockType

BODY: Final = ""
"""Key of the body of a function block, which SUPER^() calls."""

GET, SET = ".GET", ".SET"


@dataclass(slots=True, eq=False)
class ClassMethod:
    """A method as one function block has it.

    Attributes:
        label: unique among the methods of a program.
        function: its parameters and its result.
        unit: what it does.
        owner: the function block that it is compiled for.
        maker: the function block that declares it: ``owner`` or what that extends.
        open: what is made for each set of bounds, where it takes arrays of any; ``function`` has
            parameters without a type then.
    """

    label: str
    function: DeclaredFunction
    unit: MethodUnit
    owner: Class
    maker: Class
    open: OpenFunction | None = None

    def made_for(self, arrays: Mapping[str, ArrayType[object]]) -> ClassMethod | None:
        """Return the method for arrays of some bounds, None after an error."""
        function = None if self.open is None else self.open.made_for(arrays)
        if function is None:
            return None
        bounds = function.name.removeprefix(self.unit.declaration.name)
        return replace(self, label=self.label + bounds, function=function, open=None)


@dataclass(slots=True, eq=False)
class Class:
    """A function block whose text is at hand.

    Attributes:
        block: its declaration.
        data_type: its data block.
        unit: its text.
        file: where it stands.
        base: what it extends, None for nothing.
        methods: own ones, by key: the name, with `GET` or `SET` of a property.
    """

    block: DeclaredFunctionBlock
    data_type: DataBlockType[object]
    unit: FunctionBlockUnit
    file: StructuredTextFile
    base: Class | None = None
    methods: dict[str, MethodUnit] = field(default_factory=dict)
    _made: dict[tuple[Class, str], ClassMethod] = field(default_factory=dict)

    def find(self, key: str, start: Class | None = None) -> ClassMethod | None:
        """Return a method that this function block has.

        Args:
            key: of the method.
            start: where it is looked up first, for SUPER^; this function block by default.
        """
        for maker in (start or self).line():
            if key in maker.methods:
                return self._method(key, maker)
        return None

    def line(self) -> Iterator[Class]:
        """Yield this function block, what it extends, and so on."""
        found: Class | None = self
        while found is not None:
            yield found
            found = found.base

    def implements(self, name: str, interfaces: Mapping[str, ClassInterface]) -> bool:
        """Return whether this function block, or one that it extends, implements an interface.

        Args:
            name: of the interface, in capitals.
            interfaces: all of them, by name in capitals.
        """
        waiting = [base.upper() for each in self.line() for base in each.unit.bases]
        seen: set[str] = set()
        while waiting:
            base = waiting.pop()
            if base not in seen and base in interfaces:
                waiting += [each.upper() for each in interfaces[base].bases]
            seen.add(base)
        return name in seen

    def _method(self, key: str, maker: Class) -> ClassMethod | None:
        made = self._made.get((maker, key))
        if made is None:
            unit, file = maker.methods[key], maker.file
            scope = self.block.scope
            item = _setter(unit.declaration) if key.endswith(SET) else unit.declaration
            declared = DeclarationFile([item], "", file.tokens, file.diagnostics)
            around = Scope(
                unit.declaration.name,
                [declared],
                (scope,),
                dialect=scope.dialect,
                strict=scope.strict,
            )
            is_open = takes_any_bounds(unit.declaration)
            if not is_open:
                around.check()
            function = around.find_function(unit.declaration.name)
            if function is None:
                return None
            through = "" if maker is self else f"{maker.block.name}."
            label = f"{self.block.name}.{through}{key or 'body'}"
            made = self._made[maker, key] = ClassMethod(
                label,
                function,
                unit,
                self,
                maker,
                OpenFunction(unit, file, scope) if is_open else None,
            )
        return made


class ClassInterface(NamedTuple):
    """An INTERFACE; a variable of it holds the address and the number of a function block.

    Attributes:
        name: of it.
        bases: interfaces that it EXTENDS.
        keys: of the methods that it asks for itself.
    """

    name: str
    bases: Sequence[str]
    keys: Collection[str]


def interface_type(unit: InterfaceUnit) -> TypeBlock:
    """Return the type of variables of an interface."""
    members = [
        Declaration(unit.at, name, NamedType(unit.at, "UDINT")) for name in ("address", "number")
    ]
    structure = StructSpecification(unit.at, members)
    return TypeBlock(unit.at, [Declaration(unit.at, unit.name, structure)])


Classes = dict["DataBlockType[object]", Class]
"""The function blocks of a program, by their data blocks."""


def _setter(node: FunctionDeclaration) -> FunctionDeclaration:
    """Return the SET of a property as a method: what it sets is an input of its name."""
    assert node.result is not None
    given = Declaration(node.at, node.name, node.result)
    block = VariableBlock(node.at, "VAR_INPUT", (), [given])
    return FunctionDeclaration(node.at, node.name, None, [block, *node.blocks])


def key_of_method(unit: MethodUnit, name: str) -> str:
    """Return the key of a method; ``name`` is its name as the dialect compares names."""
    if "PROPERTY" not in unit.words:
        return name
    return name + next((f".{word}" for word in ("GET", "SET") if word in unit.words), "")


def action_as_method(unit: ActionUnit) -> MethodUnit:
    """Return an action of a function block as the method that calls from outside mean."""
    declaration = FunctionDeclaration(unit.at, unit.name, None, [])
    return MethodUnit(unit.at, declaration, unit.body)


def body_as_method(unit: FunctionBlockUnit) -> MethodUnit:
    """Return the body of a function block as a method without parameters."""
    declaration = FunctionDeclaration(unit.at, unit.declaration.name, None, [])
    return MethodUnit(unit.at, declaration, unit.body)
