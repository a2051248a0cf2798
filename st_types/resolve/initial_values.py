"""Initial values: from the syntax tree to plain Python values.

`st_types.types.values` encodes them.

The values are checked against their types here, so that each error is shown at its exact place.
What the controller would store differently from what is written is a warning: a STRING that is cut
to its length, a negative number in an unsigned type.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Protocol

from st_types.syntax.expressions import Literal
from st_types.syntax.tree import ArrayInitial, RepeatedInitial, StructInitial
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import CHARACTER_TYPES, ElementaryType, Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from st_types.syntax.expressions import Expression, Node
    from st_types.syntax.literals import Constant
    from st_types.syntax.tree import Initial
    from st_types.types.elementary import DataType

MAX_ELEMENTS = 4_000_000
"""Most elements of ARRAYs that the initial values of one file may give."""


class InitialContext(Protocol):
    """What a value needs to know of the file it stands in.

    Attributes:
        level: levels of nesting that are open; lists and structures are counted here.
    """

    level: int

    def evaluate(
        self, node: Expression, enumeration: EnumerationType[object] | None
    ) -> Constant | None:
        """Return the value of a constant expression, None after a finding."""

    def integer(self, node: Expression) -> int | None:
        """Return the value of a constant integer expression, None after a finding."""

    def take_elements(self, count: int) -> bool:
        """Count elements of initial values; False if the file has more than `MAX_ELEMENTS`."""

    def check_spelling(self, declared: str, name: str, at: int) -> None:
        """Warn if the name at the token ``at`` is declared in another case."""

    def error(self, node: Node, message: str, hint: str = "") -> None:
        """Record an error at ``node``."""

    def warning(self, node: Node, message: str, hint: str = "") -> None:
        """Record a warning at ``node``."""


def initial_value(context: InitialContext, node: Initial, declared: DataType[object]) -> object:
    """Return the value of ``node`` for a variable of type ``declared``.

    None means the initial value of the type: also after an error, which is recorded.
    """
    data_type = resolve_alias(declared)
    if isinstance(node, ArrayInitial | RepeatedInitial | StructInitial):
        context.level += 1
        value = _composite(context, node, data_type, declared)
        context.level -= 1
        return value
    if isinstance(data_type, ReferenceType):
        return None  # known when the program is linked: ADR(x), or 0
    return _scalar(context, node, data_type, declared)


def _composite(
    context: InitialContext,
    node: ArrayInitial | RepeatedInitial | StructInitial,
    data_type: DataType[object],
    declared: DataType[object],
) -> object:
    if isinstance(node, StructInitial):
        if isinstance(data_type, StructType):
            return _struct(context, node, data_type)
        context.error(node, f"{declared} cannot have members as its initial value")
    elif isinstance(data_type, ArrayType):
        return _array(context, node, data_type)
    else:
        context.error(node, f"{declared} cannot have a list of values as its initial value")
    return None


def _array(
    context: InitialContext, node: ArrayInitial | RepeatedInitial, data_type: ArrayType[object]
) -> list[object]:
    items = [node] if isinstance(node, RepeatedInitial) else node.items
    values: list[object] = []
    limit = min(data_type.count, MAX_ELEMENTS)
    if not _extend(context, values, items, data_type.element, limit):
        context.error(node, f"too many values for {data_type}; it takes {limit}")
    elif not context.take_elements(len(values)):
        context.error(node, f"the file gives more than {MAX_ELEMENTS} initial values")
        return []
    return values[:limit]


def _extend(
    context: InitialContext,
    values: list[object],
    items: Sequence[Initial],
    element: DataType[object],
    limit: int,
) -> bool:
    """Append the values of ``items``; False if there are more than ``limit``.

    Nested lists are the rows of an ARRAY of several dimensions, unless an element is an ARRAY.
    """
    has_rows = not isinstance(resolve_alias(element), ArrayType)
    for item in items:
        match item:
            case RepeatedInitial():
                fits = _repeat(context, values, item, element, limit)
            case ArrayInitial() if has_rows:
                fits = _extend(context, values, item.items, element, limit)
            case _:
                values.append(initial_value(context, item, element))
                fits = len(values) <= limit
        if not fits:
            return False
    return True


def _repeat(
    context: InitialContext,
    values: list[object],
    node: RepeatedInitial,
    element: DataType[object],
    limit: int,
) -> bool:
    count = context.integer(node.count)
    group: list[object] = []
    fits = _extend(context, group, node.items, element, limit)
    if count is None or not fits:
        return fits
    group = group or [None]
    if len(values) + count * len(group) > limit:
        return False
    values += group * count
    return True


def _struct(
    context: InitialContext, node: StructInitial, data_type: StructType[object]
) -> dict[str, object]:
    values: dict[str, object] = {}
    for given in node.members:
        declared = data_type.spelling(given.name)
        if declared is None:
            context.error(given, f"{data_type} has no member {given.name}")
            continue
        context.check_spelling(declared, given.name, given.at)
        member, _ = data_type.find(declared)
        if member.name in values:
            context.error(given, f"the member {member.name} is given twice")
        values[member.name] = initial_value(context, given.value, member.data_type)
    return values


def _scalar(
    context: InitialContext,
    node: Expression,
    data_type: DataType[object],
    declared: DataType[object],
) -> object:
    enumeration = data_type if isinstance(data_type, EnumerationType) else None
    constant = context.evaluate(node, enumeration)
    if constant is None:
        return None
    value = constant.value
    match data_type:
        case ArrayType() | StructType() | StringType() | WStringType() if value == 0:
            return None  # ":= (0)" and "[9(0)]", as older versions of Automation Studio write it
        case StringType() | WStringType() if isinstance(value, str):
            return _string(context, node, value, data_type)
        case ElementaryType(kind=Kind.BOOL) if value in (0, 1):
            return bool(value)
        case ElementaryType(kind=Kind.REAL) if not isinstance(value, str):
            return _real(context, node, value, data_type)
        case ElementaryType() if data_type in CHARACTER_TYPES and _is_character(value):
            return _integer(context, node, ord(str(value)), data_type)
        case ElementaryType() if _is_whole(value) and data_type.is_integer:
            return _integer(context, node, int(value), data_type)
        case EnumerationType() as enumeration if isinstance(value, int):
            return _integer(context, node, int(value), enumeration.base)
        case SubrangeType(minimum=low, maximum=high) if isinstance(value, int):
            if low <= value <= high:
                return int(value)
            context.error(node, f"{value} is outside {low}..{high} of {declared}")
            return None
    context.error(node, f"{_shown(value)} is not a value of {declared}")
    return None


def _is_character(value: object) -> bool:
    return isinstance(value, str) and len(value) == 1


def _is_whole(value: object) -> bool:
    return isinstance(value, int) or (isinstance(value, float) and value.is_integer())


def _shown(value: object) -> str:
    return str(value).upper() if isinstance(value, bool) else repr(value)[:60]


def _string(
    context: InitialContext, node: Expression, value: str, data_type: StringType | WStringType
) -> str:
    if isinstance(data_type, StringType) and not value.isascii():
        try:
            value.encode("latin-1")
        except UnicodeEncodeError:
            # The bytes of a UTF-8 file go to the controller as they are.
            value = value.encode("utf-8", "surrogatepass").decode("latin-1")
    if len(value) > data_type.length:
        given = f"{len(value)} characters are given"
        context.warning(node, f"{given}, {data_type} holds {data_type.length}; the rest is cut off")
    return value[: data_type.length]


def _real(
    context: InitialContext, node: Expression, value: float, data_type: ElementaryType[float]
) -> float | None:
    try:
        struct.pack("<" + data_type.code, value)
    except (OverflowError, struct.error):
        context.error(node, f"{value} is too large for {data_type}")
        return None
    return float(value)


def _integer(
    context: InitialContext, node: Expression, value: int, data_type: ElementaryType[int]
) -> int | None:
    if data_type.minimum <= value <= data_type.maximum:
        return value
    bits = 8 * data_type.size
    if not -(1 << bits - 1) <= value < 1 << bits:
        bounds = f"{data_type.minimum}..{data_type.maximum}"
        context.error(node, f"{value} is outside {bounds} of {data_type}")
        return None
    stored = data_type.wrap(value)
    if not _is_bit_pattern(node):
        context.warning(node, f"{value} does not fit {data_type}; the controller stores {stored}")
    return stored


def _is_bit_pattern(node: Expression) -> bool:
    """Return True for 16#FFFF and the like, which give the bits whatever the sign."""
    if not isinstance(node, Literal):
        return False
    *_, base, _digits = ("", *node.text.split("#"))
    return base.lstrip("+-").isdecimal()
