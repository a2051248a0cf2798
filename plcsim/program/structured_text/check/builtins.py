"""The functions that every program knows: operators in the form of functions, conversions, edges.

Their parameters take several types, so no declaration describes them. What a table here gives is
the type of the result; `lower` says what they do.
"""

from __future__ import annotations

from itertools import pairwise, product
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text.check import operations
from plcsim.program.structured_text.check.fits import as_character
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    BOOL,
    DINT,
    NUMBERS,
    Type,
    TypeKind,
    kind_of,
    number_type,
)
from plcsim.program.structured_text.check.typed import Builtin, Convert
from st_types.types.derived import StringType, WStringType
from st_types.types.elementary import ALL_ELEMENTARY, ELEMENTARY, LREAL, REAL

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.program.structured_text.check.typed import Value

STRING_80: Final = StringType(80)
"""What a conversion to STRING gives."""

WSTRING_80: Final = WStringType(80)

_TEXT_TYPES: Final[dict[str, Type]] = {"STRING": STRING_80, "WSTRING": WSTRING_80}
_CONVERTED: Final[dict[str, Type]] = {**ALL_ELEMENTARY, **_TEXT_TYPES}


class Rule(NamedTuple):
    """A built-in function.

    Attributes:
        least: fewest arguments.
        most: most arguments.
        made: gives the value of a call, None where the types do not fit.
        parameters: names, for calls that name them.
    """

    least: int
    most: int
    made: Callable[[str, Sequence[Value]], Value | None]
    parameters: tuple[str, ...] = ()


def conversion_of(name: str) -> tuple[Type | None, Type] | None:
    """Return source (None for any) and target of X_TO_Y or TO_Y, None for other names."""
    source, separator, target = name.upper().rpartition("TO_")
    if not separator or target not in _CONVERTED:
        return None
    if source in ("", "ANY_"):
        return None, _CONVERTED[target]
    known = _CONVERTED.get(source.removesuffix("_"))
    if not source.endswith("_") or known is None:
        return None
    return known, _CONVERTED[target]


def converted(name: str, arguments: Sequence[Value]) -> Value | None:
    """Return the call of a conversion; the argument goes into its source type first, as in C."""
    found = conversion_of(name)
    assert found is not None
    (value,) = arguments
    source, target = found
    value = value if source is None else as_character(value, source)
    kind = kind_of(value.type)
    if kind > TypeKind.WSTRING:
        return None
    if source is not None:
        is_text = source in (STRING_80, WSTRING_80)
        if is_text is not (kind in (TypeKind.STRING, TypeKind.WSTRING)):
            return None
    return Convert(target, name.upper().removeprefix("ANY_"), value)


def _result_of(kinds: frozenset[TypeKind]) -> Callable[[str, Sequence[Value]], Value | None]:
    """Return a rule: one argument, and the result has its type."""

    def made(name: str, arguments: Sequence[Value]) -> Value | None:
        data_type = arguments[0].type
        return Builtin(data_type, name, arguments) if kind_of(data_type) in kinds else None

    return made


def _real(name: str, arguments: Sequence[Value]) -> Value | None:
    """Mathematics: REAL for REAL, LREAL for LREAL, and LREAL for integers."""
    if any(kind_of(value.type) not in NUMBERS for value in arguments):
        return None
    types = [value.type for value in arguments]
    data_type = REAL if types[0] is REAL and LREAL not in types else LREAL
    return Builtin(data_type, name, arguments)


def _alike(name: str, arguments: Sequence[Value], first: int = 0) -> Value | None:
    """Arguments from ``first`` on share a type, which is that of the result."""
    data_type = shared_type(arguments[first:])
    return None if data_type is None else Builtin(data_type, name, arguments)


def shared_type(values: Sequence[Value]) -> Type | None:
    """Return the type that all values go into, None if there is none."""
    found = values[0]
    for value in values[1:]:
        data_type = operations.compared_type(found, value)
        if data_type is None:
            same = found.type is value.type and kind_of(value.type) in (
                TypeKind.STRUCT,
                TypeKind.ARRAY,
            )
            data_type = value.type if same else None
        if data_type is None:
            return None
        longest = max(found.type, value.type, key=lambda t: t.size)
        is_text = kind_of(data_type) in (TypeKind.STRING, TypeKind.WSTRING)
        found = Builtin(longest if is_text else data_type, "", ())
    return found.type


def _select(name: str, arguments: Sequence[Value]) -> Value | None:
    truth = kind_of(arguments[0].type)
    return _alike(name, arguments, 1) if truth is TypeKind.BOOL else None


def _multiplex(name: str, arguments: Sequence[Value]) -> Value | None:
    return _alike(name, arguments, 1) if kind_of(arguments[0].type) is TypeKind.INTEGER else None


def _shift(name: str, arguments: Sequence[Value]) -> Value | None:
    if any(kind_of(value.type) is not TypeKind.INTEGER for value in arguments):
        return None
    data_type = arguments[0].type
    return Builtin(DINT if data_type is ANY_INT else number_type(data_type), name, arguments)


def _bit(name: str, arguments: Sequence[Value]) -> Value | None:
    found = _shift(name, arguments)
    if found is None:
        return None
    return Builtin(BOOL, name, arguments) if name == "BIT_TST" else found


def _truncated(name: str, arguments: Sequence[Value]) -> Value | None:
    """TRUNC, TRUNC_INT, REAL_TRUNC_INT, ...: a DINT where no other type is named."""
    target = ELEMENTARY.get(name.rpartition("TRUNC")[2].removeprefix("_"), DINT)
    return (
        Convert(target, "TRUNC", arguments[0])
        if kind_of(arguments[0].type) is TypeKind.REAL
        else None
    )


def _to_bcd(name: str, arguments: Sequence[Value]) -> Value | None:
    """INT_TO_BCD, UINT_TO_BCD_WORD, ...: a bit string of the size of the number."""
    source, _, target = name.partition("_TO_BCD")
    number = ELEMENTARY[source]
    data_type = ELEMENTARY.get(target.removeprefix("_"), _BITS_BY_SIZE[number.size])
    if kind_of(arguments[0].type) is not TypeKind.INTEGER:
        return None
    return Builtin(data_type, "TO_BCD", arguments)


def _from_bcd(name: str, arguments: Sequence[Value]) -> Value | None:
    """BCD_TO_INT, WORD_BCD_TO_UINT, ..."""
    target = ELEMENTARY[name.rpartition("_")[2]]
    if kind_of(arguments[0].type) is not TypeKind.INTEGER:
        return None
    return Builtin(target, "FROM_BCD", arguments)


def _is_valid(name: str, arguments: Sequence[Value]) -> Value | None:
    """IS_VALID of a REAL, IS_VALID_BCD of a bit string."""
    wanted = TypeKind.REAL if name == "IS_VALID" else TypeKind.INTEGER
    return Builtin(BOOL, name, arguments) if kind_of(arguments[0].type) is wanted else None


_OPERATORS: Final = {
    "ADD": "+",
    "SUB": "-",
    "MUL": "*",
    "DIV": "/",
    "EQ": "=",
    "NE": "<>",
    "LT": "<",
    "GT": ">",
    "LE": "<=",
    "GE": ">=",
    "AND": "AND",
    "OR": "OR",
    "XOR": "XOR",
    "MOD": "MOD",
}


def _operator(name: str, arguments: Sequence[Value]) -> Value | None:
    """``ADD(a, b, c)`` is ``a + b + c``, ``LT(a, b, c)`` is ``a < b AND b < c``."""
    operator = _OPERATORS[name]
    if operator not in operations.COMPARISONS:
        result: Value | None = arguments[0]
        for value in arguments[1:]:
            result = None if result is None else operations.operation(operator, result, value)
        return result
    comparisons = [operations.operation(operator, a, b) for a, b in pairwise(arguments)]
    result = comparisons[0]
    for comparison in comparisons[1:]:
        if result is None or comparison is None:
            return None
        result = operations.operation("AND", result, comparison)
    return result


def _calculated(name: str, arguments: Sequence[Value]) -> Value | None:
    """ADD_TIME(t, u) and the like: the operator, of the types that the name says."""
    operator, (left, right) = _OPERATORS[_TIME_FUNCTIONS[name]], arguments
    return operations.dated(operator, left, right) or operations.operation(operator, left, right)


def _moved(_name: str, arguments: Sequence[Value]) -> Value | None:
    return arguments[0]


def _negated(_name: str, arguments: Sequence[Value]) -> Value | None:
    (value,) = arguments
    return operations.negation(value)


def _power(_name: str, arguments: Sequence[Value]) -> Value | None:
    return operations.operation("**", arguments[0], arguments[1])


def _truncating() -> list[str]:
    targets = [name for name, t in ELEMENTARY.items() if kind_of(t) is TypeKind.INTEGER]
    named = [f"{start}TRUNC_{target}" for start in ("", "REAL_", "LREAL_") for target in targets]
    return ["TRUNC", *named]


MANY: Final = 64
"""Most arguments of a function that takes any number."""

_NUMBERS_AND_TIMES = NUMBERS | {TypeKind.TIME}
_BITS: Final = ("BYTE", "WORD", "DWORD")
_BITS_BY_SIZE: Final = {ELEMENTARY[name].size: ELEMENTARY[name] for name in _BITS}
_BCD_NUMBERS: Final = ("SINT", "INT", "DINT", "USINT", "UINT", "UDINT", *_BITS)
_TIME_FUNCTIONS: Final = {
    **dict.fromkeys(["ADD_TIME", "ADD_TOD_TIME", "ADD_DT_TIME"], "ADD"),
    **dict.fromkeys(["SUB_TIME", "SUB_TOD_TIME", "SUB_DT_TIME"], "SUB"),
    **dict.fromkeys(["SUB_DATE_DATE", "SUB_TOD_TOD", "SUB_DT_DT"], "SUB"),
    **dict.fromkeys(["MUL_TIME", "MULTIME"], "MUL"),
    **dict.fromkeys(["DIV_TIME", "DIVTIME"], "DIV"),
}
_MATHEMATICS = ("SQRT", "LN", "LOG", "EXP", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN")
_EXTENSIBLE = ("ADD", "MUL", "AND", "OR", "XOR", "EQ", "LT", "GT", "LE", "GE")

RULES: Final[dict[str, Rule]] = {
    "ABS": Rule(1, 1, _result_of(_NUMBERS_AND_TIMES), ("IN",)),
    **{name: Rule(1, 1, _real, ("IN",)) for name in _MATHEMATICS},
    "ATAN2": Rule(2, 2, _real, ("Y", "X")),
    "EXPT": Rule(2, 2, _power, ("IN1", "IN2")),
    "MIN": Rule(2, MANY, _alike),
    "MAX": Rule(2, MANY, _alike),
    "LIMIT": Rule(3, 3, _alike, ("MN", "IN", "MX")),
    "SEL": Rule(3, 3, _select, ("G", "IN0", "IN1")),
    "MUX": Rule(2, MANY, _multiplex, ("K",)),
    "MOVE": Rule(1, 1, _moved, ("IN",)),
    "NOT": Rule(1, 1, _negated, ("IN",)),
    **{name: Rule(2, 2, _shift, ("IN", "N")) for name in ("SHL", "SHR", "ROL", "ROR", "ASR")},
    **{name: Rule(2, 2, _bit, ("IN", "POS")) for name in ("BIT_SET", "BIT_CLR", "BIT_TST")},
    **{name: Rule(1, 1, _is_valid, ("IN",)) for name in ("IS_VALID", "IS_VALID_BCD")},
    **{name: Rule(1, 1, _truncated, ("IN",)) for name in _truncating()},
    **{f"{name}_TO_BCD": Rule(1, 1, _to_bcd, ("IN",)) for name in _BCD_NUMBERS},
    **{
        f"{name}_TO_BCD_{bits}": Rule(1, 1, _to_bcd, ("IN",))
        for name, bits in product(_BCD_NUMBERS, _BITS)
    },
    **{f"BCD_TO_{name}": Rule(1, 1, _from_bcd, ("IN",)) for name in _BCD_NUMBERS},
    **{
        f"{bits}_BCD_TO_{name}": Rule(1, 1, _from_bcd, ("IN",))
        for name, bits in product(_BCD_NUMBERS, _BITS)
    },
    **{name: Rule(2, 2, _calculated, ("IN1", "IN2")) for name in _TIME_FUNCTIONS},
    **{name: Rule(2, MANY, _operator) for name in _EXTENSIBLE},
    **{
        name: Rule(2, 2, _operator, ("IN1", "IN2"))
        for name in _OPERATORS
        if name not in _EXTENSIBLE
    },
}
"""Built-in functions by name in capitals, but for conversions and those of a place in memory."""

EDGES: Final = frozenset(["EDGEPOS", "EDGENEG", "EDGE"])
BOUNDS: Final = frozenset(["LOWER_BOUND", "UPPER_BOUND"])
PLACE_FUNCTIONS: Final = frozenset(["ADR", "SIZEOF", "REF", "__ISVALIDREF"])
"""Functions whose argument is a place, not a value."""

_CONVERSION = Rule(1, 1, converted, ("IN",))
_OVERLOADED: Final = frozenset(
    [
        *("ABS", *_MATHEMATICS, "EXPT", "MIN", "MAX", "LIMIT", "SEL", "MUX", "MOVE", "NOT"),
        *("SHL", "SHR", "ROL", "ROR", *_OPERATORS),
    ]
)
"""Functions that the norm knows with the name of a type behind them, too."""


def rule_of(name: str) -> Rule | None:
    """Return the built-in function ``name`` (in any case), None if there is none."""
    found = RULES.get(name.upper())
    if found is None and conversion_of(name) is not None:
        return _CONVERSION
    return found


def typed_rule(name: str) -> Rule | None:
    """Return ADD for ``ADD_INT`` and the like, None for other names."""
    function, _, data_type = name.upper().rpartition("_")
    if function not in _OVERLOADED or data_type not in _CONVERTED:
        return None
    rule = RULES[function]
    return rule._replace(made=lambda _name, arguments: rule.made(function, arguments))
