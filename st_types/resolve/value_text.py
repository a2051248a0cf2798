"""A value of a type from text as Structured Text writes it: T#1s500ms, AUTO, (x := 1, y := 2).

It is the reverse of `st_types.writers.value_text`. What a person types at a prompt is taken too: a
STRING without quotes, a TIME without its prefix.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NoReturn

from st_types.errors import ValueRangeError
from st_types.resolve.constants import EvaluationError, evaluate
from st_types.resolve.initial_values import MAX_ELEMENTS, initial_value
from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.initials import InitialParser
from st_types.syntax.lexer import Tokens
from st_types.syntax.literals import Constant
from st_types.syntax.reader import UnexpectedTokenError
from st_types.syntax.source import Source
from st_types.syntax.tree import StructInitial
from st_types.types.derived import (
    EnumerationType,
    StringType,
    StructType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import TIME
from st_types.types.values import encode

if TYPE_CHECKING:
    from st_types.syntax.expressions import Expression, Node
    from st_types.syntax.tree import Initial
    from st_types.types.elementary import DataType


def value_from(data_type: DataType[object], text: str) -> object:
    """Return the plain value (see `st_types.types.values.decode`) that a text stands for.

    Args:
        data_type: of the value.
        text: the value; of a STRUCT with all its members.

    Raises:
        ValueRangeError: it is no value of the type; the message says why.
    """
    data_type = resolve_alias(data_type)
    text = text.strip()
    if isinstance(data_type, StringType | WStringType) and text[:1] not in ("'", '"'):
        encode(data_type, text)
        return _checked_length(data_type, text)
    if data_type is TIME and text[:1].isdigit() and not text.isdigit():
        text = f"T#{text}"
    tokens = Tokens(Source("", text))
    parser = InitialParser(tokens, DiagnosticLog(tokens.source))
    try:
        node = parser.initial()
    except UnexpectedTokenError as err:
        raise ValueRangeError(f"{text!r} is not a {data_type}: {err.message}") from None
    if parser.text:
        raise ValueRangeError(f"{text!r} is not a {data_type}: {parser.text} is too much")
    _require_members(node, data_type)
    value = initial_value(_Value(text), node, data_type)
    if value is None:
        raise ValueRangeError(f"{text!r} is not a {data_type}")
    encode(data_type, value)
    return value


def _checked_length(data_type: StringType | WStringType, text: str) -> str:
    if len(text) > data_type.length:
        raise ValueRangeError(f"{len(text)} characters are too many for a {data_type}")
    return text


def _require_members(node: Initial, data_type: DataType[object]) -> None:
    """Raise ValueRangeError where a STRUCT lacks a member: which value should it keep?"""
    data_type = resolve_alias(data_type)
    if not isinstance(node, StructInitial) or not isinstance(data_type, StructType):
        return
    given = {member.name.upper(): member.value for member in node.members}
    for member in data_type.members:
        if member.name.upper() not in given:
            raise ValueRangeError(f"the member {member.name} of {data_type} is missing")
        _require_members(given[member.name.upper()], member.data_type)


class _Value:
    """An `InitialContext` of one value; whatever is wrong is an error."""

    def __init__(self, text: str) -> None:
        self.level = 0
        self._text = text
        self._elements_left = MAX_ELEMENTS
        self._expected: EnumerationType[object] | None = None

    def constant(self, name: str, _at: int) -> Constant | None:
        """Return a value of the enumeration that is expected; no other name means anything."""
        expected = self._expected
        if expected is None:
            return None
        name = name.removeprefix(f"{expected.name}.").removeprefix(f"{expected.name}#")
        spelling = expected.spelling(name)
        return Constant(expected.name, expected.values[spelling]) if spelling else None

    def evaluate(
        self, node: Expression, enumeration: EnumerationType[object] | None
    ) -> Constant | None:
        """Return the value of a constant expression."""
        outer, self._expected = self._expected, enumeration
        try:
            return evaluate(node, self)
        except EvaluationError as err:
            known = "" if enumeration is None else f"; there are {', '.join(enumeration.values)}"
            raise ValueRangeError(f"{err.message}{known}") from None
        finally:
            self._expected = outer

    def integer(self, node: Expression) -> int | None:
        """Return the value of a constant integer expression."""
        constant = self.evaluate(node, None)
        if constant is None or not isinstance(constant.value, int):
            self.error(node, "a whole number was expected")
        return int(constant.value)

    def take_elements(self, count: int) -> bool:
        """Count elements."""
        self._elements_left -= count
        return self._elements_left >= 0

    def check_spelling(self, declared: str, name: str, at: int) -> None:
        """Take a name in any case."""

    def error(self, _node: Node, message: str, _hint: str = "") -> NoReturn:
        """Raise what is wrong."""
        raise ValueRangeError(message)

    warning = error
