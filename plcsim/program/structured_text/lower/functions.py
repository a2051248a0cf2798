"""Lowering of built-in functions, edges and calls of functions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.check.calls import parameters_of
from plcsim.program.structured_text.check.kinds import (
    VOID,
    TypeKind,
    is_unsigned,
    kind_of,
    number_type,
)
from plcsim.program.structured_text.lower import conversions
from plcsim.program.structured_text.lower.bits import BitLowering
from plcsim.program.structured_text.lower.context import value_type_of
from plcsim.program.structured_text.lower.conversions import to_type
from plcsim.program.structured_text.lower.memory import constant_of, is_scalar, width_of
from plcsim.program.structured_text.lower.nature import is_unsigned_in_c
from plcsim.program.structured_text.lower.values import after
from st_types.types.elementary import REAL
from st_types.types.values import encode

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.program.structured_text.check import typed
    from plcsim.program.structured_text.check.calls import Parameter
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Value

_SECONDS_OF_DAY = 86_400
_MATHEMATICS: Final[Mapping[str, str]] = {
    **{name: f"rt.{name.lower()}" for name in ("SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN")},
    "EXP": "rt.exp",
    "LN": "rt.log",
    "LOG": "rt.log10",
}
_TEXTS = (TypeKind.STRING, TypeKind.WSTRING)


class FunctionLowering(BitLowering):
    """Lowers built-in functions and calls."""

    # Built-in functions

    def builtin(self, node: typed.Builtin) -> ir.Expression:
        """Return the result of a built-in function."""
        return _BUILTINS[node.name](self, node)

    def _absolute(self, node: typed.Builtin) -> ir.Expression:
        (argument,) = node.arguments
        self._repeated += 1
        value = self.value(argument)
        self._repeated -= 1
        unsigned = is_unsigned_in_c(argument)
        found = self._twice(argument, lambda x: _magnitude(x, unsigned=unsigned), value)
        return self._narrowed(found, node.type)

    def _mathematics(self, node: typed.Builtin) -> ir.Expression:
        argument = self.operand(node.arguments[0], "f64")
        found = ir.Call("f64", _MATHEMATICS[node.name], (argument,))
        return to_type(found, "f32" if node.type is REAL else "f64", unsigned=False)

    def _arctangent(self, node: typed.Builtin) -> ir.Expression:
        """ATAN2 of ordinate and abscissa."""
        arguments = [self.operand(each, "f64") for each in node.arguments]
        found = ir.Call("f64", "rt.atan2", arguments)
        return to_type(found, "f32" if node.type is REAL else "f64", unsigned=False)

    def _is_valid(self, node: typed.Builtin) -> ir.Expression:
        """IS_VALID of a REAL or LREAL: neither infinite nor NaN."""
        before, kept = self.kept(self.operand(node.arguments[0], "f64"))
        zero = ir.Binary("f64", "sub", kept, kept)
        return after(before, ir.Compare("f64", "eq", zero, conversions.zero("f64")))

    def _square_root(self, node: typed.Builtin) -> ir.Expression:
        value_type: ir.ValueType = "f32" if node.type is REAL else "f64"
        return ir.Unary(value_type, "sqrt", self.operand(node.arguments[0], value_type))

    def _extreme(self, node: typed.Builtin) -> ir.Expression:
        """MIN and MAX of any number of values, or of strings."""
        name = node.name
        first, *others = [self._same(each, node.type) for each in node.arguments]
        found = first
        for other in others:
            found = self._chosen(name, found, other, node.type)
        return found

    def _chosen(
        self, name: str, a: ir.Expression, b: ir.Expression, data_type: Type
    ) -> ir.Expression:
        before, left = self.kept(a)
        more, right = self.kept(b)
        condition = self._ordered("lt" if name == "MIN" else "gt", left, right, data_type)
        assert left.type is not None
        return after([*before, *more], ir.Select(left.type, condition, left, right))

    @staticmethod
    def _ordered(
        operator: str, a: ir.Expression, b: ir.Expression, data_type: Type
    ) -> ir.Expression:
        kind = kind_of(data_type)
        if kind in _TEXTS:
            helper = "rt.string_compare" if kind is TypeKind.STRING else "rt.wstring_compare"
            a, b = ir.Call("i32", helper, (a, b)), ir.Const("i32", 0)
            name: Any = f"{operator}_s"
        elif a.type in ("f32", "f64"):
            name = operator
        else:
            name = f"{operator}_{'u' if is_unsigned(number_type(data_type)) else 's'}"
        assert a.type is not None
        return ir.Compare(a.type, name, a, b)

    def _limit(self, node: typed.Builtin) -> ir.Expression:
        """``MIN(MAX(IN, MN), MX)``."""
        low, value, high = (self._same(each, node.type) for each in node.arguments)
        return self._chosen("MIN", self._chosen("MAX", value, low, node.type), high, node.type)

    def _select(self, node: typed.Builtin) -> ir.Expression:
        condition, zero, one = node.arguments
        value_type = value_type_of(node.type)
        return ir.IfExpression(
            value_type,
            self.value(condition),
            self._same(one, node.type),
            self._same(zero, node.type),
        )

    def _multiplex(self, node: typed.Builtin) -> ir.Expression:
        """``MUX(K, IN0, IN1, ...)``; beyond the last it is the last."""
        selector, *inputs = node.arguments
        before, index = self.kept(self.operand(selector, "i32"))
        values = [self._same(each, node.type) for each in inputs]
        found = values.pop()
        value_type = value_type_of(node.type)
        for number in reversed(range(len(values))):
            condition = ir.Compare("i32", "eq", index, ir.Const("i32", number))
            found = ir.IfExpression(value_type, condition, values[number], found)
        return after(before, found)

    # Edges

    def edge(self, node: typed.Edge) -> ir.Expression:
        """Return the edge of a BOOL, and remember it: where a call is in it, it is called twice."""
        self._repeated += 1
        value = self.value(node.operand)
        self._repeated -= 1
        place = self.place(node.memory)
        memory = ir.Load("i32", "u8", place)
        one = ir.Const("i32", 1)

        def use(x: ir.Expression) -> ir.Expression:
            result = self.function.local("i32")
            statements: list[ir.Statement] = [
                ir.SetLocal(self.line, result, _edge(node.name, x, memory)),
                ir.Store(self.line, "u8", place, ir.Binary("i32", "and", x, one)),
            ]
            return ir.StatementExpression("i32", statements, ir.Local("i32", result))

        return self._twice(node.operand, use, value)

    # Calls

    def call(self, node: typed.Call) -> ir.Expression:
        """Return the result of a declared function."""
        parameters = parameters_of(node.function)
        arguments = [
            self._given(argument, parameter)
            for argument, parameter in zip(node.arguments, parameters, strict=True)
        ]
        return self._called(node.function.name, arguments, node.type)

    def method(self, node: typed.MethodCall) -> ir.Expression:
        """Return the result of a method: the instance goes first, then where the result goes."""
        parameters = parameters_of(node.function)
        arguments = [
            self._given(argument, parameter)
            for argument, parameter in zip(node.arguments, parameters, strict=True)
        ]
        name, this = f"method {node.label}", self.address(node.instance)
        if node.type is VOID:
            return ir.Call(None, name, [this, *arguments])
        if is_scalar(node.type):
            return ir.Call(value_type_of(node.type), name, [this, *arguments])
        place = ir.AddressOf(self.function.temporary(node.type))
        call = ir.Call(None, name, [this, place, *arguments])
        return ir.StatementExpression("i32", [ir.Evaluate(self.line, call)], place)

    def implementation(self, node: typed.Implementation) -> ir.Expression:
        """Return the address of what a variable of an interface is to hold."""
        place = self.function.temporary(node.type)
        address = ir.Const("i32", 0) if node.place is None else self.address(node.place)
        number = ir.Place(place.base, place.offset + 4)
        before: list[ir.Statement] = [
            ir.Store(self.line, "w32", place, address),
            ir.Store(self.line, "w32", number, ir.Const("i32", node.number)),
        ]
        return after(before, ir.AddressOf(place))

    def dispatch(self, node: typed.Dispatch) -> ir.Expression:
        """Return the result of the method of the function block that an interface holds.

        Where it holds none the address is 0, and the first of them ends the program.
        """
        number = self.value(node.number)
        (_, first), *others = node.calls
        found = self.method(first)
        assert found.type is not None
        for which, call in others:
            condition = ir.Compare("i32", "eq", number, ir.Const("i32", which))
            found = ir.IfExpression(found.type, condition, self.method(call), found)
        return found

    def _given(self, node: Value | None, parameter: Parameter) -> ir.Expression:
        if node is None:
            return self._default(parameter)
        data_type = parameter.type
        if parameter.by_address or (data_type is not None and not is_scalar(data_type)):
            return self.address(node)
        if data_type is None:
            return self.value(node)
        return self.argument(node, data_type)

    def _default(self, parameter: Parameter) -> ir.Expression:
        """Return what a parameter holds that the caller does not give."""
        data_type: Any = parameter.type
        if data_type is None:
            return ir.Const("i32", 0)
        image = encode(data_type, parameter.initial)
        if not parameter.by_address and is_scalar(data_type):
            return constant_of(image, width_of(data_type))
        hidden = self.module.hidden
        offset = hidden.place(data_type.size, data_type.alignment, image)
        return ir.AddressOf(ir.Place(hidden.segment, offset))


def _magnitude(value: ir.Expression, *, unsigned: bool) -> ir.Expression:
    """Return ``x < 0 ? -x : x``."""
    value_type = value.type
    assert value_type is not None
    zero = conversions.zero(value_type)
    if value_type in ("f32", "f64"):
        condition = ir.Compare(value_type, "lt", value, zero)
        return ir.IfExpression(value_type, condition, ir.Unary(value_type, "neg", value), value)
    if unsigned:
        return value
    condition = ir.Compare(value_type, "lt_s", value, zero)
    return ir.IfExpression(value_type, condition, ir.Binary(value_type, "sub", zero, value), value)


def _edge(name: str, x: ir.Expression, memory: ir.Expression) -> ir.Expression:
    one = ir.Const("i32", 1)
    if name == "EDGEPOS":
        off = ir.Binary("i32", "xor", memory, ir.Const("i32", -1))
        return ir.Binary("i32", "and", ir.Binary("i32", "and", x, off), one)
    if name == "EDGENEG":
        not_x = ir.Binary("i32", "xor", x, ir.Const("i32", -1))
        return ir.Binary("i32", "and", ir.Binary("i32", "and", not_x, memory), one)
    return conversions.truth(ir.Binary("i32", "xor", x, ir.Binary("i32", "and", memory, one)))


_BUILTINS: dict[str, Callable[[FunctionLowering, typed.Builtin], ir.Expression]] = {
    "ABS": FunctionLowering._absolute,
    **dict.fromkeys(_MATHEMATICS, FunctionLowering._mathematics),
    "ATAN2": FunctionLowering._arctangent,
    "SQRT": FunctionLowering._square_root,
    "IS_VALID": FunctionLowering._is_valid,
    "IS_VALID_BCD": FunctionLowering._is_bcd,
    **dict.fromkeys(["MIN", "MAX"], FunctionLowering._extreme),
    "LIMIT": FunctionLowering._limit,
    "SEL": FunctionLowering._select,
    "MUX": FunctionLowering._multiplex,
    **dict.fromkeys(["SHL", "SHR", "ASR"], FunctionLowering._shift),
    **dict.fromkeys(["ROL", "ROR"], FunctionLowering._rotate),
    **dict.fromkeys(["TO_BCD", "FROM_BCD"], FunctionLowering._bcd),
    **dict.fromkeys(["BIT_SET", "BIT_CLR", "BIT_TST"], FunctionLowering._bit_function),
}
