"""Lowering of shifts, rotations and bit functions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.lower.context import value_type_of
from plcsim.program.structured_text.lower.conversions import narrowed, to_type
from plcsim.program.structured_text.lower.values import after

if TYPE_CHECKING:
    from plcsim.program.structured_text.check import typed
    from plcsim.program.structured_text.check.kinds import Type

from plcsim.program.structured_text.lower.scalars import ScalarLowering


class BitLowering(ScalarLowering):
    """Lowers what works on the bits of an integer."""

    def _shift(self, node: typed.Builtin) -> ir.Expression:
        """SHL, SHR (zeros come in) and ASR (the sign comes in), within the width of the type."""
        value, count, bits = self._shifted(node)
        value_type = value.type
        assert value_type is not None
        signed = node.name == "ASR"
        operator: ir.BinaryOperator = {"SHL": "shl", "SHR": "shr_u"}.get(node.name, "shr_s")  # type: ignore[assignment]  # the three are operators
        if operator == "shr_u":
            value = _as_unsigned(value, bits)
        if isinstance(count, ir.Const) and int(count.value) < bits:
            return narrowed_to(ir.Binary(value_type, operator, value, count), node.type)
        before, kept = self.kept(count)
        inside = ir.Compare(value_type, "lt_u", kept, ir.Const(value_type, bits))
        beyond: ir.Expression = ir.Const(value_type, 0)
        if signed:
            most, value_kept = ir.Const(value_type, bits - 1), value
            index = ir.Select(value_type, inside, kept, most)
            return after(
                before, narrowed_to(ir.Binary(value_type, operator, value_kept, index), node.type)
            )
        shifted = ir.Binary(value_type, operator, value, kept)
        found = ir.Select(value_type, inside, shifted, beyond)
        return after(before, narrowed_to(found, node.type))

    def _shifted(self, node: typed.Builtin) -> tuple[ir.Expression, ir.Expression, int]:
        """Return the value, the count in the same type, and the width in bits."""
        value_type = value_type_of(node.type)
        value = self._same(node.arguments[0], node.type)
        count = self.operand(node.arguments[1], value_type)
        return value, count, 8 * node.type.size

    def _rotate(self, node: typed.Builtin) -> ir.Expression:
        value, count, bits = self._shifted(node)
        value_type = value.type
        assert value_type is not None
        left = node.name == "ROL"
        if bits >= 32:
            return ir.Binary(value_type, "rotl" if left else "rotr", value, count)
        before, kept = self.kept(_as_unsigned(value, bits))
        mask = ir.Const("i32", bits - 1)
        more, places = self.kept(ir.Binary("i32", "and", count, mask))
        rest = ir.Binary("i32", "and", ir.Binary("i32", "sub", ir.Const("i32", bits), places), mask)
        first: tuple[ir.BinaryOperator, ir.BinaryOperator] = ("shl", "shr_u")
        there, back = first if left else first[::-1]
        found = ir.Binary(
            "i32",
            "or",
            ir.Binary("i32", there, kept, places),
            ir.Binary("i32", back, kept, rest),
        )
        return after([*before, *more], narrowed(found, node.type))

    def _bcd(self, node: typed.Builtin) -> ir.Expression:
        """TO_BCD and FROM_BCD; what does not fit into the digits is lost."""
        (argument,) = node.arguments
        bits = node.type if node.name == "TO_BCD" else argument.type
        before, kept = self.kept(self.operand(argument, "i32"))
        make = bcd_of if node.name == "TO_BCD" else number_of
        return after(before, narrowed(make(kept, 2 * min(bits.size, 4)), node.type))

    def _is_bcd(self, node: typed.Builtin) -> ir.Expression:
        """IS_VALID_BCD: a digit is above nine where its bit 8 is set beside bit 4 or bit 2."""
        before, kept = self.kept(self.operand(node.arguments[0], "i64"))
        fours = ir.Binary("i64", "shl", kept, ir.Const("i64", 1))
        twos = ir.Binary("i64", "shl", kept, ir.Const("i64", 2))
        wrong = ir.Binary("i64", "and", kept, ir.Binary("i64", "or", fours, twos))
        eights = ir.Const("i64", 0x8888_8888_8888_8888)
        zero = ir.Const("i64", 0)
        return after(before, ir.Compare("i64", "eq", ir.Binary("i64", "and", wrong, eights), zero))

    def _bit_function(self, node: typed.Builtin) -> ir.Expression:
        """BIT_SET, BIT_CLR and BIT_TST."""
        data_type = node.arguments[0].type
        value_type = value_type_of(data_type)
        value = self.value(node.arguments[0])
        position = self.operand(node.arguments[1], value_type)
        one = ir.Const(value_type, 1)
        if node.name == "BIT_TST":
            shifted = ir.Binary(value_type, "shr_u", value, position)
            return to_type(ir.Binary(value_type, "and", shifted, one), "i32", unsigned=True)
        mask: ir.Expression = ir.Binary(value_type, "shl", one, position)
        if node.name == "BIT_SET":
            return narrowed_to(ir.Binary(value_type, "or", value, mask), node.type)
        mask = ir.Binary(value_type, "xor", mask, ir.Const(value_type, -1))
        return narrowed_to(ir.Binary(value_type, "and", value, mask), node.type)


def bcd_of(value: ir.Expression, digits: int) -> ir.Expression:
    """Return a number (an i32 without a sign) as digits of four bits."""
    found = _digit(value, 0)
    for place in range(1, digits):
        shifted = ir.Binary("i32", "shl", _digit(value, place), ir.Const("i32", 4 * place))
        found = ir.Binary("i32", "or", found, shifted)
    return found


def _digit(value: ir.Expression, place: int) -> ir.Expression:
    scaled = ir.Binary("i32", "div_u", value, ir.Const("i32", 10**place)) if place else value
    return ir.Binary("i32", "rem_u", scaled, ir.Const("i32", 10))


def number_of(value: ir.Expression, digits: int) -> ir.Expression:
    """Return the number that digits of four bits stand for."""
    found: ir.Expression = ir.Const("i32", 0)
    for place in range(digits):
        shifted = ir.Binary("i32", "shr_u", value, ir.Const("i32", 4 * place))
        digit = ir.Binary("i32", "and", shifted, ir.Const("i32", 15))
        part = ir.Binary("i32", "mul", digit, ir.Const("i32", 10**place))
        found = ir.Binary("i32", "add", found, part)
    return found


def narrowed_to(value: ir.Expression, data_type: Type) -> ir.Expression:
    """Return an i32 cut to its type; an i64 as it is."""
    return narrowed(value, data_type) if value.type == "i32" else value


def _as_unsigned(value: ir.Expression, bits: int) -> ir.Expression:
    if bits >= 32 or value.type != "i32":
        return value
    return ir.Binary("i32", "and", value, ir.Const("i32", (1 << bits) - 1))
