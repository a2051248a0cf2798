"""Lowering of conversions, and of scalars as variables and parameters hold them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.check.builtins import conversion_of
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    ANY_REAL,
    BOOL,
    DINT,
    VOID,
    TypeKind,
    kind_of,
    number_type,
)
from plcsim.program.structured_text.lower import conversions
from plcsim.program.structured_text.lower.context import value_type_of
from plcsim.program.structured_text.lower.conversions import narrowed, to_type
from plcsim.program.structured_text.lower.memory import is_scalar, width_of
from plcsim.program.structured_text.lower.nature import is_pure, is_unsigned_in_c
from plcsim.program.structured_text.lower.values import ValueLowering, after
from st_types.types.derived import StringType, WStringType
from st_types.types.elementary import (
    DATE,
    DATE_AND_TIME,
    LDATE,
    LDATE_AND_TIME,
    LONG_TIMES,
    LTIME_OF_DAY,
    REAL,
    TIME,
    TIME_OF_DAY,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Value

MAX_REPEATED: Final = 8
"""Nested functions that work out an argument with a call in it twice, as C's macros do; deeper ones
work it out once, or the code would double with each."""

_SECONDS_OF_DAY = 86_400
_TEXTS = (TypeKind.STRING, TypeKind.WSTRING)


class ScalarLowering(ValueLowering):
    """Lowers conversions."""

    _repeated = 0

    # Conversions

    def convert(self, node: typed.Convert) -> ir.Expression:
        """Return the result of X_TO_Y or TRUNC."""
        source, target = node.operand, node.type
        if kind_of(target) in _TEXTS or kind_of(source.type) in _TEXTS:
            return self._text_conversion(node)
        if node.name == "TRUNC":
            return conversions.truncated(self.operand(source, "f64"), target)
        value = self.value(source)
        if value.type in ("f32", "f64"):
            return self._from_real(source, value, target)
        return self._from_integer(source, value, target)

    def _from_real(self, source: Value, value: ir.Expression, target: Type) -> ir.Expression:
        wanted = ir.VALUE_TYPE[width_of(target)]
        if wanted in ("f32", "f64"):
            return to_type(value, wanted, unsigned=False)
        if target is BOOL:
            return conversions.truth(value)
        if self.semantics.rounds_to_even:
            nearest = ir.Unary("f64", "nearest", to_type(value, "f64", unsigned=False))
            return conversions.truncated(nearest, target)
        return self._twice(
            source,
            lambda x: conversions.truncated(
                conversions.rounded(to_type(x, "f64", unsigned=False)), target
            ),
            value,
        )

    def _from_integer(self, source: Value, value: ir.Expression, target: Type) -> ir.Expression:
        if source.type is BOOL and target is not BOOL:
            value = ir.Binary("i32", "and", value, ir.Const("i32", 1))
        if target is BOOL:
            return value if source.type is BOOL else conversions.truth(value)
        converted = to_type(
            value, ir.VALUE_TYPE[width_of(target)], unsigned=is_unsigned_in_c(source)
        )
        between_dates = (source.type, target)
        scale = _scale(source.type, target)
        if scale is not None:
            return self._scaled(source, value, target, scale)
        if between_dates in _DATE_PARTS:
            return _DATE_PARTS[between_dates](self, converted)
        if converted.type != "i32" or self._is_clean(source, target):
            return converted
        return narrowed(converted, target)

    def _scaled(
        self, source: Value, value: ir.Expression, target: Type, scale: tuple[int, int]
    ) -> ir.Expression:
        """Return a time in the unit of another type."""
        wide = to_type(value, "i64", unsigned=is_unsigned_in_c(source))
        factor, divisor = scale
        operator: ir.BinaryOperator = "mul" if factor > 1 else "div_s"
        found = ir.Binary("i64", operator, wide, ir.Const("i64", factor * divisor))
        return to_type(found, value_type_of(target), unsigned=True)

    def _time_of_day(self, value: ir.Expression) -> ir.Expression:
        second = ir.Binary("i32", "rem_u", value, ir.Const("i32", _SECONDS_OF_DAY))
        return ir.Binary("i32", "mul", second, ir.Const("i32", 1000))

    def _day(self, value: ir.Expression) -> ir.Expression:
        before, kept = self.kept(value)
        second = ir.Binary("i32", "rem_u", kept, ir.Const("i32", _SECONDS_OF_DAY))
        return after(before, ir.Binary("i32", "sub", kept, second))

    def _long_time_of_day(self, value: ir.Expression) -> ir.Expression:
        return ir.Binary("i64", "rem_s", value, ir.Const("i64", _SECONDS_OF_DAY * 1_000_000_000))

    def _long_day(self, value: ir.Expression) -> ir.Expression:
        before, kept = self.kept(value)
        return after(before, ir.Binary("i64", "sub", kept, self._long_time_of_day(kept)))

    @staticmethod
    def _is_clean(source: Value, target: Type) -> bool:
        """Return True where a value is one of ``target`` already, as its load left it."""
        if isinstance(source, typed.Compare | typed.Bit | typed.Edge):
            return True
        is_place = isinstance(source, typed.PLACES)
        if not is_place or not is_scalar(source.type):
            return False
        number, wanted = number_type(source.type), number_type(target)
        return wanted.minimum <= number.minimum and number.maximum <= wanted.maximum

    def argument(self, node: Value, target: Type) -> ir.Expression:
        """Return a scalar as a parameter or a local of type ``target`` holds it."""
        value = self.stored(node, target)
        if value.type != "i32" or (node.type is target and isinstance(node, typed.PLACES)):
            return value
        return value if self._is_clean(node, target) else narrowed(value, target)

    def stored(self, node: Value, target: Type) -> ir.Expression:
        """Return a scalar in the type in which a variable of type ``target`` is stored.

        A store keeps the low bits; REAL to integer is cut, as C does it.
        """
        value = self.value(node)
        wanted = ir.VALUE_TYPE[width_of(target)]
        if value.type == wanted:
            return value
        if value.type in ("f32", "f64") and wanted in ("i32", "i64"):
            return conversions.truncated(to_type(value, "f64", unsigned=False), target)
        return to_type(value, wanted, unsigned=is_unsigned_in_c(node))

    def _text_conversion(self, node: typed.Convert) -> ir.Expression:
        """Call REAL_TO_STRING, STRING_TO_INT, ...: libraries have them."""
        source = node.operand
        found = conversion_of(node.name)
        assert found is not None
        declared = found[0] or _TYPES_OF_NUMBERS.get(source.type, source.type)
        is_text = kind_of(source.type) in _TEXTS
        value = self.address(source) if is_text else self.argument(source, declared)
        if isinstance(node.type, StringType | WStringType):
            name = node.name if found[0] is not None else f"{_type_name(source.type)}_TO_STRING"
            return self._called(name, (value,), node.type)
        name = node.name if found[0] is not None else f"{_type_name(source.type)}_{node.name}"
        return self._called(name, (value,), node.type)

    def _called(self, name: str, arguments: Sequence[ir.Expression], result: Type) -> ir.Expression:
        """Return the result of a function that others have or the module has."""
        types = [argument.type for argument in arguments]
        parameters = [each for each in types if each is not None]
        if result is VOID:
            function = self.module.function(name, ir.Signature(parameters, None))
            return ir.Call(None, function, arguments)
        if is_scalar(result):
            value_type = value_type_of(result)
            function = self.module.function(name, ir.Signature(parameters, value_type))
            return ir.Call(value_type, function, arguments)
        function = self.module.function(name, ir.Signature(("i32", *parameters), None))
        place = self.function.temporary(result)
        call = ir.Call(None, function, (ir.AddressOf(place), *arguments))
        return ir.StatementExpression("i32", [ir.Evaluate(self.line, call)], ir.AddressOf(place))

    def _twice(
        self,
        node: Value,
        use: Callable[[ir.Expression], ir.Expression],
        value: ir.Expression,
    ) -> ir.Expression:
        """Return what ``use`` makes of a value that it names more than once.

        Where a call is in it, C's macros call it as often; else it is worked out once.
        """
        if not is_pure(node) and self._repeated < MAX_REPEATED:
            return use(value)
        before, kept = self.kept(value)
        return after(before, use(kept))

    def _same(self, node: Value, data_type: Type) -> ir.Expression:
        """Return an argument in the type that all share; of strings the address."""
        if not is_scalar(data_type):
            return self.address(node)
        value = self.value(node)
        wanted = value_type_of(data_type)
        if data_type is ANY_INT and value.type is not None:
            wanted = value.type
        return to_type(value, wanted, unsigned=is_unsigned_in_c(node))


def _type_name(data_type: Type) -> str:
    data_type = _TYPES_OF_NUMBERS.get(data_type, data_type)
    return number_type(data_type).name if is_scalar(data_type) else data_type.name.partition("[")[0]


_TYPES_OF_NUMBERS: Final[dict[Type, Type]] = {ANY_INT: DINT, ANY_REAL: REAL}
"""What a number in the text is where a name needs a type."""

_NANOSECONDS: Final[dict[Type, int]] = {
    **dict.fromkeys((TIME, TIME_OF_DAY), 1_000_000),
    **dict.fromkeys((DATE, DATE_AND_TIME), 1_000_000_000),
    **dict.fromkeys(LONG_TIMES.values(), 1),
}
"""Nanoseconds of the units that times count in."""


def _scale(source: Type, target: Type) -> tuple[int, int] | None:
    """Return by what a time is multiplied and divided, None where both count alike."""
    a, b = _NANOSECONDS.get(source), _NANOSECONDS.get(target)
    if a is None or b is None or a == b or 1 not in (a, b):
        return None
    return (a, 1) if b == 1 else (1, b)


_DATE_PARTS: dict[tuple[Type, Type], Callable[[ScalarLowering, ir.Expression], ir.Expression]] = {
    (DATE_AND_TIME, TIME_OF_DAY): ScalarLowering._time_of_day,
    (DATE_AND_TIME, DATE): ScalarLowering._day,
    (LDATE_AND_TIME, LTIME_OF_DAY): ScalarLowering._long_time_of_day,
    (LDATE_AND_TIME, LDATE): ScalarLowering._long_day,
}
