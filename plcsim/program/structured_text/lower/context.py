"""What the lowering of all functions of a module shares, and what one function has."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.lower.memory import (
    FrameVariables,
    Hidden,
    VariablePlaces,
    is_scalar,
    width_of,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Symbol
    from plcsim.program.structured_text.lower.memory import Areas
    from plcsim.program.structured_text.lower.semantics import Semantics
    from st_types.types.derived import DataBlockType


class LoweringContext:
    """A module while it is made.

    Args:
        areas: where the variables of scopes lie.
        semantics: of the dialect.

    Attributes:
        hidden: the segment of what is declared nowhere.
        variables: places of all variables.
        imports: functions that others have, by the name that calls use.
        own: names of the module's functions, as calls use them.
    """

    def __init__(self, areas: Areas, semantics: Semantics) -> None:
        self.semantics = semantics
        self.hidden = Hidden()
        self.variables = VariablePlaces(areas, self.hidden)
        self.imports: dict[str, ir.Import] = {}
        self.own: set[str] = set()

    def block(self, name: str) -> str:
        """Return the name by which the function block ``name`` is called."""
        key = f"block {name}"
        if key not in self.own and key not in self.imports:
            self.imports[key] = ir.Import("block", name, ir.Signature(("i32",), None))
        return key

    def function(self, name: str, signature: ir.Signature) -> str:
        """Return the name by which the function ``name`` is called."""
        key = f"function {name}"
        if key not in self.own and key not in self.imports:
            self.imports[key] = ir.Import("function", name, signature)
        return key


class FunctionContext:
    """A function while it is made.

    Args:
        module: that it belongs to.
        block: data block that local 0 leads to, None for a function without one.
        parameters: types of the parameters.
        is_recursive: it may call itself, by whatever others.

    Attributes:
        locals: types of all locals, the parameters first.
        in_locals: variables that live in parameters and locals, by number.
        frame: what each call has of its own in memory, None where calls share it.
    """

    def __init__(
        self,
        module: LoweringContext,
        block: DataBlockType[object] | None,
        parameters: Sequence[ir.ValueType],
        *,
        is_recursive: bool = False,
    ) -> None:
        self.module = module
        self.block = block
        self.parameter_count = len(parameters)
        self.locals: list[ir.ValueType] = list(parameters)
        self.in_locals: dict[Symbol, int] = {}
        self._members: dict[str, int] = {}
        self._labels = 0
        self.frame = FrameVariables(self.local("i32")) if is_recursive else None
        self._in_frame: dict[Symbol, ir.Place] = {}

    def local(self, value_type: ir.ValueType) -> int:
        """Return the number of a new local."""
        self.locals.append(value_type)
        return len(self.locals) - 1

    def label(self) -> int:
        """Return a new label."""
        self._labels += 1
        return self._labels

    def add_variable(self, symbol: Symbol) -> None:
        """Give a variable that lives for one call its local, if it fits into one."""
        if is_scalar(symbol.type) and not symbol.has_address:
            self.in_locals[symbol] = self.local(ir.VALUE_TYPE[width_of(symbol.type)])
        else:
            self.add_to_frame(symbol)

    def add_to_frame(self, symbol: Symbol) -> None:
        """Give a variable that lives for one call its place in the frame, if there is one."""
        if self.frame is not None:
            self._in_frame[symbol] = self.frame.place(symbol.type)

    def place(self, symbol: Symbol) -> ir.Place:
        """Return the place of a variable that is in no local."""
        return self._in_frame.get(symbol) or self.module.variables.place(symbol)

    def temporary(self, data_type: Type) -> ir.Place:
        """Return a place that only one call in the text uses."""
        if self.frame is not None:
            return self.frame.place(data_type)
        hidden = self.module.hidden
        return ir.Place(hidden.segment, hidden.place(data_type.size, data_type.alignment))

    def member_root(self, name: str) -> int:
        """Return the root of a member of the data block that the function works on."""
        found = self._members.get(name)
        if found is None:
            found = self._members[name] = self.module.variables.new_root()
        return found


def value_type_of(data_type: Type) -> ir.ValueType:
    """Return the type on the stack of a scalar; of all else its address lies there."""
    return ir.VALUE_TYPE[width_of(data_type)] if is_scalar(data_type) else "i32"
