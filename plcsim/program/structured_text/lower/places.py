"""Lowering of places: where variables, members and elements lie."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.lower.conversions import to_type
from plcsim.program.structured_text.lower.nature import is_unsigned_in_c

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.program.structured_text.check.typed import Symbol, Value
    from plcsim.program.structured_text.lower.context import FunctionContext


class PlaceLowering:
    """Lowers the places of one function.

    Args:
        function: that they stand in.
    """

    def __init__(self, function: FunctionContext) -> None:
        self.function = function
        self.module = function.module
        self.semantics = function.module.semantics

    def value(self, node: Value) -> ir.Expression:
        """Return the value of a scalar, the address of anything else."""
        raise NotImplementedError

    def place(self, node: Value) -> ir.Place:
        """Return where a variable, an element, a member or what an address leads to lies."""
        rule = _PLACE_RULES.get(type(node))
        return ir.Place(self.value(node), 0) if rule is None else rule(self, node)

    def _variable_place(self, node: typed.Variable) -> ir.Place:
        symbol = node.symbol
        if symbol.by_address:
            return ir.Place(self._address_in(symbol), 0)
        if symbol.storage == "instance":
            return self._instance_place(symbol)
        return self.function.place(symbol)

    def _address_in(self, symbol: Symbol) -> ir.Expression:
        """Return the address that a VAR_IN_OUT or a parameter holds."""
        index = self.function.in_locals.get(symbol)
        if index is not None:
            return ir.Local("i32", index)
        return ir.Load("i32", "w32", self._instance_place(symbol))

    def _instance_place(self, symbol: Symbol) -> ir.Place:
        block = self.function.block
        assert block is not None
        _, offset = block.find(symbol.name)
        is_known = symbol.has_address and not symbol.by_address
        root = 0 if is_known else self.function.member_root(symbol.name)
        return ir.Place(ir.Local("i32", 0), offset, root)

    def _member_place(self, node: typed.Member) -> ir.Place:
        base = self.place(node.base)
        return ir.Place(base.base, base.offset + node.offset, base.root)

    def _target_place(self, node: typed.Target) -> ir.Place:
        return ir.Place(self.value(node.pointer), 0)

    def _element_place(self, node: typed.Element) -> ir.Place:
        base = self.place(node.base)
        size = node.array.element.size
        constant = 0
        variable: ir.Expression | None = None
        for index, (low, high) in zip(node.indices, node.array.bounds, strict=True):
            count = high - low + 1
            constant *= count
            variable = _times(variable, count)
            if isinstance(index, typed.Constant):
                constant += int(index.value) - low
                continue
            value = self._index(index, low, count)
            if not self.semantics.checks_bounds:
                constant -= low
            variable = value if variable is None else ir.Binary("i32", "add", variable, value)
        return _moved(base, constant * size, _times(variable, size))

    def _index(self, node: Value, low: int, count: int) -> ir.Expression:
        """Return an index that is not constant: from ``low`` on, with a check from 0 on."""
        index = to_type(self.value(node), "i32", unsigned=is_unsigned_in_c(node))
        if not self.semantics.checks_bounds:
            return index
        from_zero = ir.Binary("i32", "sub", index, ir.Const("i32", low)) if low else index
        return ir.Checked(from_zero, count)

    def address(self, node: Value) -> ir.Expression:
        """Return the address of a place, a literal, or of what a function gives."""
        if isinstance(node, typed.Constant):
            return self.value(node)
        if type(node) not in _PLACE_RULES:
            return self.value(node)
        place = self.place(node)
        if not place.offset and not place.root and not isinstance(place.base, ir.Segment):
            return place.base
        return ir.AddressOf(place)


def _times(value: ir.Expression | None, factor: int) -> ir.Expression | None:
    if value is None or factor == 1:
        return value
    return ir.Binary("i32", "mul", value, ir.Const("i32", factor))


def _moved(base: ir.Place, constant: int, variable: ir.Expression | None) -> ir.Place:
    """Return a place so many bytes behind ``base``; offsets of places are not negative."""
    offset = base.offset + constant
    if variable is None:
        return ir.Place(base.base, offset, base.root)
    if offset < 0:
        variable = ir.Binary("i32", "add", variable, ir.Const("i32", offset))
        offset = 0
    if isinstance(base.base, ir.Segment) or offset:
        start: ir.Expression = ir.AddressOf(ir.Place(base.base, offset, base.root))
    else:
        start = base.base
    return ir.Place(ir.Binary("i32", "add", start, variable), 0, base.root)


_PLACE_RULES: dict[type, Callable[[PlaceLowering, Any], ir.Place]] = {
    typed.Variable: PlaceLowering._variable_place,
    typed.Member: PlaceLowering._member_place,
    typed.Element: PlaceLowering._element_place,
    typed.Target: PlaceLowering._target_place,
}
