"""Lowering of places and values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    ANY_REAL,
    BOOL,
    TypeKind,
    is_unsigned,
    kind_of,
    number_type,
)
from plcsim.program.structured_text.lower import conversions
from plcsim.program.structured_text.lower.conversions import common_type, to_type
from plcsim.program.structured_text.lower.memory import width_of
from plcsim.program.structured_text.lower.nature import is_pure, is_unsigned_in_c
from plcsim.program.structured_text.lower.places import PlaceLowering
from st_types.errors import ValueRangeError
from st_types.types.elementary import LREAL, REAL
from st_types.types.values import encode_string, encode_wstring

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Value

_ARITHMETIC: Final[Mapping[str, ir.BinaryOperator]] = {
    "+": "add",
    "-": "sub",
    "*": "mul",
    "/": "div",
    "AND": "and",
    "OR": "or",
    "XOR": "xor",
}
_COMPARISONS: Final[Mapping[str, ir.CompareOperator]] = {
    "=": "eq",
    "<>": "ne",
    "<": "lt",
    ">": "gt",
    "<=": "le",
    ">=": "ge",
}
_COMPARISONS_BY_SIGN: Final[Mapping[tuple[str, bool], ir.CompareOperator]] = {
    ("=", False): "eq",
    ("=", True): "eq",
    ("<>", False): "ne",
    ("<>", True): "ne",
    ("<", False): "lt_s",
    ("<", True): "lt_u",
    (">", False): "gt_s",
    (">", True): "gt_u",
    ("<=", False): "le_s",
    ("<=", True): "le_u",
    (">=", False): "ge_s",
    (">=", True): "ge_u",
}


class ValueLowering(PlaceLowering):
    """Lowers the values of one function.

    Attributes:
        line: of the statement that is being lowered.
    """

    line = 0

    def value(self, node: Value) -> ir.Expression:
        """Return the value of a scalar, the address of anything else."""
        return _RULES[type(node)](self, node)

    # Values

    def _load(self, node: Value) -> ir.Expression:
        data_type = node.type
        width = width_of(data_type)
        if type(node) is typed.Variable and not node.symbol.by_address:
            index = self.function.in_locals.get(node.symbol)
            if index is not None:
                return ir.Local(ir.VALUE_TYPE[width], index)
        if kind_of(data_type) in _AGGREGATES:
            return self.address(node)
        return ir.Load(ir.VALUE_TYPE[width], width, self.place(node))

    def _constant(self, node: typed.Constant) -> ir.Expression:
        value = node.value
        if isinstance(value, str):
            return ir.AddressOf(self._literal(node, value))
        data_type = node.type
        if data_type is REAL:
            return ir.Const("f32", float(value))
        if data_type in (LREAL, ANY_REAL) or isinstance(value, float):
            return ir.Const("f64", float(value))
        is_long = width_of(data_type) == "w64" or not -(1 << 31) <= value < 1 << 32
        return ir.Const("i64" if is_long else "i32", int(value))

    def _literal(self, node: typed.Constant, text: str) -> ir.Place:
        hidden = self.module.hidden
        is_wide = kind_of(node.type) is TypeKind.WSTRING
        data = literal_data(text, is_wide=is_wide)
        return ir.Place(hidden.segment, hidden.literal(data, 2 if is_wide else 1))

    def _bit(self, node: typed.Bit) -> ir.Expression:
        base = self.value(node.base)
        assert base.type is not None
        shifted: ir.Expression = base
        if node.number:
            shifted = ir.Binary(base.type, "shr_u", base, ir.Const(base.type, node.number))
        low = ir.Binary(base.type, "and", shifted, ir.Const(base.type, 1))
        return to_type(low, "i32", unsigned=True)

    def _address(self, node: typed.Address) -> ir.Expression:
        return self.address(node.place)

    def _unary(self, node: typed.Unary) -> ir.Expression:
        value = self.value(node.operand)
        value_type = value.type
        assert value_type is not None
        if node.operator == "NOT":
            mask = 1 if node.type is BOOL else -1
            found: ir.Expression = ir.Binary(value_type, "xor", value, ir.Const(value_type, mask))
        elif value_type in ("f32", "f64"):
            return ir.Unary(value_type, "neg", value)
        else:
            found = ir.Binary(value_type, "sub", ir.Const(value_type, 0), value)
        return self._narrowed(found, node.type)

    def _narrowed(self, value: ir.Expression, data_type: Type) -> ir.Expression:
        """Cut a result to its type, where the dialect has it so."""
        if not self.semantics.narrow_results or value.type != "i32" or data_type is ANY_INT:
            return value
        return conversions.narrowed(value, data_type)

    # Operations

    def operand(self, node: Value, value_type: ir.ValueType) -> ir.Expression:
        """Return a value in the type that C calculates in."""
        return to_type(self.value(node), value_type, unsigned=is_unsigned_in_c(node))

    def pair(self, left: Value, right: Value, data_type: Type) -> tuple[ir.Expression, ...]:
        """Return two values in the type that C brings both to."""
        a, b = self.value(left), self.value(right)
        assert a.type is not None
        assert b.type is not None
        wanted = common_type(a.type, b.type)
        if self.semantics.narrow_results and data_type is REAL:
            wanted = "f32"
        if a.type != wanted:
            a = to_type(a, wanted, unsigned=is_unsigned_in_c(left))
        if b.type != wanted:
            b = to_type(b, wanted, unsigned=is_unsigned_in_c(right))
        return a, b

    def _binary(self, node: typed.Binary) -> ir.Expression:
        """Lower a chain of operators from its left end, for it may be hundreds long."""
        chain = [node]
        while type(chain[-1].left) is typed.Binary:
            chain.append(chain[-1].left)
        found = self._operation(chain.pop())
        while chain:
            each = chain.pop()
            found = self._operation(each, found)
        return found

    def _operation(self, node: typed.Binary, left: ir.Expression | None = None) -> ir.Expression:
        operator = node.operator
        if operator in _SPECIAL:
            return _SPECIAL[operator](self, node, left)
        a, b = self._pair_with(node, left)
        value_type = a.type
        assert value_type is not None
        name = _ARITHMETIC[operator]
        if operator == "/" and value_type in ("i32", "i64"):
            name = "div_u" if is_unsigned(number_type(node.type)) else "div_s"
        return self._narrowed(ir.Binary(value_type, name, a, b), node.type)

    def _pair_with(
        self, node: typed.Binary, left: ir.Expression | None
    ) -> tuple[ir.Expression, ...]:
        """Return both operands in one type, the left one lowered already if it is given."""
        if left is None:
            return self.pair(node.left, node.right, node.type)
        b = self.value(node.right)
        assert left.type is not None
        assert b.type is not None
        wanted = common_type(left.type, b.type)
        if self.semantics.narrow_results and node.type is REAL:
            wanted = "f32"
        if left.type != wanted:
            left = to_type(left, wanted, unsigned=is_unsigned_in_c(node.left))
        if b.type != wanted:
            b = to_type(b, wanted, unsigned=is_unsigned_in_c(node.right))
        return left, b

    def _modulo(self, node: typed.Binary, left: ir.Expression | None) -> ir.Expression:
        """``x MOD 0`` is 0."""
        a, b = self._pair_with(node, left)
        value_type = a.type
        assert value_type is not None
        name: ir.BinaryOperator = "rem_u" if is_unsigned(number_type(node.type)) else "rem_s"
        if isinstance(b, ir.Const):
            found: ir.Expression = ir.Binary(value_type, name, a, b)
            return self._narrowed(found if b.value else conversions.zero(value_type), node.type)
        before, divisor = self.kept(b)
        rest = ir.Binary(value_type, name, a, divisor)
        found = ir.IfExpression(value_type, divisor, rest, conversions.zero(value_type))
        if value_type == "i64":
            condition = ir.Compare("i64", "ne", divisor, ir.Const("i64", 0))
            found = ir.IfExpression("i64", condition, rest, ir.Const("i64", 0))
        return self._narrowed(after(before, found), node.type)

    def _power(self, node: typed.Binary, left: ir.Expression | None) -> ir.Expression:
        base = left if left is not None else self.value(node.left)
        a = to_type(base, "f64", unsigned=is_unsigned_in_c(node.left))
        b = self.operand(node.right, "f64")
        found = ir.Call("f64", "rt.pow", (a, b))
        return to_type(found, "f32" if node.type is REAL else "f64", unsigned=False)

    def _logic(self, node: typed.Binary, left: ir.Expression | None) -> ir.Expression:
        """AND and OR: in standard files of BOOLs, the right side is left out where it can be."""
        operator = node.operator
        is_short = operator in ("AND_THEN", "OR_ELSE") or (
            self.semantics.short_circuit and node.type is BOOL and not is_pure(node.right)
        )
        a, b = self._pair_with(node, left)
        value_type = a.type
        assert value_type is not None
        is_and = operator in ("AND", "AND_THEN")
        if not is_short:
            return ir.Binary(value_type, "and" if is_and else "or", a, b)
        if is_and:
            return ir.IfExpression("i32", a, b, ir.Const("i32", 0))
        return ir.IfExpression("i32", a, ir.Const("i32", 1), b)

    def _compare(self, node: typed.Compare) -> ir.Expression:
        kind = kind_of(node.operands)
        if kind in (TypeKind.STRING, TypeKind.WSTRING):
            helper = "rt.string_compare" if kind is TypeKind.STRING else "rt.wstring_compare"
            order = ir.Call("i32", helper, (self.address(node.left), self.address(node.right)))
            operator = _COMPARISONS_BY_SIGN[node.operator, False]
            return ir.Compare("i32", operator, order, ir.Const("i32", 0))
        a, b = self.pair(node.left, node.right, node.operands)
        value_type = a.type
        assert value_type is not None
        if value_type in ("f32", "f64"):
            return ir.Compare(value_type, _COMPARISONS[node.operator], a, b)
        unsigned = is_unsigned(number_type(node.operands)) or kind is TypeKind.REFERENCE
        return ir.Compare(value_type, _COMPARISONS_BY_SIGN[node.operator, unsigned], a, b)

    # Temporaries

    def kept(self, value: ir.Expression) -> tuple[list[ir.Statement], ir.Expression]:
        """Return statements that keep a value, and the value, to be used more than once."""
        if isinstance(value, ir.Const | ir.Local):
            return [], value
        assert value.type is not None
        index = self.function.local(value.type)
        return [ir.SetLocal(self.line, index, value)], ir.Local(value.type, index)


def after(statements: Sequence[ir.Statement], value: ir.Expression) -> ir.Expression:
    """Return ``value`` after ``statements``."""
    if not statements:
        return value
    assert value.type is not None
    return ir.StatementExpression(value.type, statements, value)


def literal_data(text: str, *, is_wide: bool) -> bytes:
    """Return the bytes of a string that stands in the source, with its terminator.

    Characters beyond Latin-1 go into a STRING as the bytes of UTF-8, as in declarations.
    """
    if is_wide:
        return encode_wstring(text, len(text)) + b"\0\0"
    try:
        return encode_string(text, len(text)) + b"\0"
    except ValueRangeError:
        return encode_string(text.encode("utf-8", "surrogatepass"), 4 * len(text)) + b"\0"


_AGGREGATES = frozenset([TypeKind.STRING, TypeKind.WSTRING, TypeKind.STRUCT, TypeKind.ARRAY])
_SPECIAL: dict[
    str, Callable[[ValueLowering, typed.Binary, ir.Expression | None], ir.Expression]
] = {
    "MOD": ValueLowering._modulo,
    "**": ValueLowering._power,
    **dict.fromkeys(["AND", "OR", "AND_THEN", "OR_ELSE"], ValueLowering._logic),
}
_RULES: dict[type, Callable[[Any, Any], ir.Expression]] = {
    typed.Constant: ValueLowering._constant,
    typed.Variable: ValueLowering._load,
    typed.Member: ValueLowering._load,
    typed.Element: ValueLowering._load,
    typed.Target: ValueLowering._load,
    typed.Bit: ValueLowering._bit,
    typed.Address: ValueLowering._address,
    typed.Unary: ValueLowering._unary,
    typed.Binary: ValueLowering._binary,
    typed.Compare: ValueLowering._compare,
    typed.Convert: lambda lowering, node: lowering.convert(node),
    typed.Builtin: lambda lowering, node: lowering.builtin(node),
    typed.Edge: lambda lowering, node: lowering.edge(node),
    typed.Call: lambda lowering, node: lowering.call(node),
    typed.MethodCall: lambda lowering, node: lowering.method(node),
    typed.Implementation: lambda lowering, node: lowering.implementation(node),
    typed.Dispatch: lambda lowering, node: lowering.dispatch(node),
    typed.This: lambda _lowering, _node: ir.Local("i32", 0),
}
