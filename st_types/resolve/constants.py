"""Values of constant expressions: bounds, lengths, initial values.

Integers are exact as long as they fit 64 bits; a division cuts towards zero, as C does. AND, OR,
XOR and NOT work on the bits of integers.
"""

from __future__ import annotations

import math
import operator
from typing import TYPE_CHECKING, Protocol

from st_types.syntax.expressions import Binary, Literal, MemberAccess, Name, Unary
from st_types.syntax.literals import Constant
from st_types.syntax.tree import ArrayInitial, MemberInitial, RepeatedInitial, StructInitial

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from st_types.syntax.expressions import Expression
    from st_types.syntax.tree import Initial

Number = int | float

MAX_INTEGER = 2**64 - 1
MIN_INTEGER = -(2**63)


class EvaluationError(Exception):
    """An expression has no constant value.

    Attributes:
        at: token at which it fails.
        message: why.
        unknown_name: the name that nothing declares, empty for other errors.
    """

    def __init__(self, at: int, message: str, unknown_name: str = "") -> None:
        super().__init__(message)
        self.at = at
        self.message = message
        self.unknown_name = unknown_name


class NotConstantError(EvaluationError):
    """The expression may have a value, but not before the program is linked or runs."""


class UnknownValueError(Exception):
    """A name is known but not its value.

    Attributes:
        message: why; empty where that is reported already.
        is_final: no further file could help, as with constants that depend on one another.
    """

    def __init__(self, message: str = "", *, is_final: bool = False) -> None:
        super().__init__(message)
        self.message = message
        self.is_final = is_final


class Constants(Protocol):
    """What names stand for.

    Attributes:
        level: levels of nesting that are open; counted here, for a constant may lead to the next.
    """

    level: int

    def constant(self, name: str, at: int) -> Constant | None:
        """Return the constant or enumeration value ``name``, None if there is none.

        Args:
            name: as it is written; a value of an enumeration may be qualified: ``Colour.red``.
            at: token it stands at.

        Raises:
            UnknownValueError: there is one, but its value is not known.
        """


def evaluate(expression: Expression, scope: Constants) -> Constant:
    """Return the value of ``expression``.

    Raises:
        EvaluationError: it is not constant, a name is unknown, or the value is out of range.
    """
    chain: list[Binary] = []
    while isinstance(expression, Binary):
        chain.append(expression)
        expression = expression.left
    scope.level += 1
    value = _operand(expression, scope)
    for node in reversed(chain):
        value = _binary(node, value, evaluate(node.right, scope))
    scope.level -= 1
    return value


def names_in(initial: Initial) -> Iterator[str]:
    """Yield the unqualified names that stand in an initial value."""
    waiting: list[Initial | MemberInitial] = [initial]
    while waiting:
        match waiting.pop():
            case Name(name=name):
                yield name
            case Unary(operand=operand):
                waiting.append(operand)
            case Binary(left=left, right=right):
                waiting += (right, left)
            case ArrayInitial(items=items):
                waiting += reversed(items)
            case RepeatedInitial(count=count, items=items):
                waiting += (*reversed(items), count)
            case StructInitial(members=members):
                waiting += reversed(members)
            case MemberInitial(value=value):
                waiting.append(value)


def _operand(node: Expression, scope: Constants) -> Constant:
    match node:
        case Literal():
            return node.constant
        case Name(name=name) | MemberAccess(base=Name(), name=name):
            return _lookup(node, name, scope)
        case Unary():
            return _unary(node, evaluate(node.operand, scope))
    raise NotConstantError(node.at, "the value is not known here; a constant was expected")


def _lookup(node: Name | MemberAccess, name: str, scope: Constants) -> Constant:
    if isinstance(node, MemberAccess) and isinstance(node.base, Name):
        name = f"{node.base.name}.{name}"
    try:
        found = scope.constant(name, node.at)
    except UnknownValueError as err:
        kind = EvaluationError if err.is_final else NotConstantError
        raise kind(node.at, err.message) from None
    if found is None:
        raise EvaluationError(node.at, f"no constant is called {name}", name)
    return found


def _unary(node: Unary, operand: Constant) -> Constant:
    value = operand.value
    if node.operator == "NOT" and isinstance(value, bool):
        return Constant(operand.type_name, not value)
    if isinstance(value, bool | str) or (node.operator == "NOT" and isinstance(value, float)):
        raise EvaluationError(node.at, f"{node.operator} cannot be applied to {value!r}")
    return _checked(node.at, operand.type_name, _UNARY_OPERATIONS[node.operator](value))


def _binary(node: Binary, left: Constant, right: Constant) -> Constant:
    a, b = left.value, right.value
    if isinstance(a, str) or isinstance(b, str):
        raise EvaluationError(node.at, f"{node.operator} cannot be applied to a string")
    try:
        value = _BINARY_OPERATIONS[node.operator](a, b)
    except ZeroDivisionError:
        raise EvaluationError(node.at, "division by zero") from None
    except (TypeError, OverflowError, ValueError):
        text = f"{a} {node.operator} {b} cannot be worked out"
        raise EvaluationError(node.at, text) from None
    return _checked(node.at, _common_type(left.type_name, right.type_name), value)


def _common_type(left: str, right: str) -> str:
    if left == "ANY_INT" or (left == "ANY_REAL" and right != "ANY_INT"):
        return right
    return left


def _checked(at: int, type_name: str, value: Number) -> Constant:
    if isinstance(value, bool):
        return Constant("BOOL", value)
    in_range = math.isfinite(value) if isinstance(value, float) else _fits_64_bits(value)
    if not in_range:
        raise EvaluationError(at, "the value is out of range")
    is_real = isinstance(value, float) and type_name == "ANY_INT"
    return Constant("ANY_REAL" if is_real else type_name, value)


def _fits_64_bits(value: int) -> bool:
    return MIN_INTEGER <= value <= MAX_INTEGER


def _divide(a: Number, b: Number) -> Number:
    if isinstance(a, float) or isinstance(b, float):
        return a / b
    quotient = abs(a) // abs(b)
    return quotient if (a < 0) == (b < 0) else -quotient


def _modulo(a: Number, b: Number) -> Number:
    """Return the remainder with the sign of ``a``; 0 for a divisor of 0, as on the controller."""
    if isinstance(a, float) or isinstance(b, float):
        raise TypeError
    return a - b * _divide(a, b) if b else 0


def _power(a: Number, b: Number) -> Number:
    rough = math.pow(a, b)
    if isinstance(a, float) or isinstance(b, float) or b < 0:
        return rough
    if abs(rough) > 2 * MAX_INTEGER:
        raise OverflowError
    exact: int = a**b
    return exact


def _invert(a: Number) -> Number:
    if isinstance(a, float):
        raise TypeError
    return ~a


_UNARY_OPERATIONS: dict[str, Callable[[Number], Number]] = {
    "-": operator.neg,
    "+": operator.pos,
    "NOT": _invert,
}
_BINARY_OPERATIONS: dict[str, Callable[[Number, Number], Number]] = {
    "OR": operator.or_,
    "XOR": operator.xor,
    "AND": operator.and_,
    "=": operator.eq,
    "<>": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": _divide,
    "MOD": _modulo,
    "**": _power,
}
