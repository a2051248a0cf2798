"""Helpers that compiled programs bring along: strings, copies and fills, written once.

They go by eight bytes where those cannot lie in another page than the bytes that are asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.memory import PAGE
from plcsim.program.structured_text import ir

if TYPE_CHECKING:
    from collections.abc import Mapping

MATHEMATICS: Final = tuple(name for name in ir.RUNTIME if ir.RUNTIME[name].parameters[0] == "f64")
"""Helpers of `ir.RUNTIME` that every module imports, from ``rt``."""

SIGNATURES: Final[Mapping[str, ir.Signature]] = {
    **{name: ir.RUNTIME[name] for name in ir.RUNTIME if name not in MATHEMATICS},
    "rt.copy": ir.Signature(("i32", "i32", "i32"), None),  # target, source, count
    "rt.fill": ir.Signature(("i32", "i32", "i32"), None),  # target, value, count
}
"""Helpers with code of their own, those of `ir.CopyBytes` and `ir.FillBytes` among them."""

_WORD: Final = 8
"""Bytes that are handled at once."""


def helper(name: str) -> ir.Function:
    """Return a helper's code.

    Raises:
        KeyError: there is no such helper.
    """
    signature = SIGNATURES[name]
    locals_, body = _BODIES[name]
    return ir.Function(
        name, "helper", signature.parameters, signature.result, locals_, body, line=0
    )


# A shorthand for trees; locals are named by their types.


def _int(value: int) -> ir.Const:
    return ir.Const("i32", value)


def _long(value: int) -> ir.Const:
    return ir.Const("i64", value)


def _binary(operator: ir.BinaryOperator, left: ir.Expression, right: ir.Expression) -> ir.Binary:
    kind = left.type
    assert kind is not None
    return ir.Binary(kind, operator, left, right)


def _is(left: ir.Expression, operator: ir.CompareOperator, right: ir.Expression) -> ir.Compare:
    kind = left.type
    assert kind is not None
    return ir.Compare(kind, operator, left, right)


def _load(width: ir.Width, address: ir.Expression, offset: int = 0) -> ir.Load:
    return ir.Load(ir.VALUE_TYPE[width], width, ir.Place(address, offset))


def _store(width: ir.Width, address: ir.Expression, value: ir.Expression) -> ir.Store:
    return ir.Store(0, width, ir.Place(address, 0), value)


def _set(local: ir.Local, value: ir.Expression) -> ir.SetLocal:
    return ir.SetLocal(0, local.index, value)


def _move(local: ir.Local, by: int) -> ir.SetLocal:
    return _set(local, _binary("add", local, _int(by)))


def _if(condition: ir.Expression, *body: ir.Statement) -> ir.If:
    return ir.If(0, (ir.Arm(0, condition, body),))


def _while(label: int, condition: ir.Compare, *body: ir.Statement) -> ir.Loop:
    leave = _if(_is(condition, "eq", _int(0)), ir.Break(0, label))
    return ir.Loop(0, label, (leave, *body))


def _zeros(word: ir.Expression) -> ir.Expression:
    """Return a word whose lowest bit that is set lies in the first zero byte of another."""
    ones, highs = _long(0x0101010101010101), _long(0x8080808080808080)
    borrowed = _binary("sub", word, ones)
    return _binary("and", _binary("and", borrowed, _binary("xor", word, _long(-1))), highs)


def _within_page(address: ir.Expression) -> ir.Expression:
    """Return whether a word at an address lies in the page of its first byte."""
    return _is(_binary("and", address, _int(PAGE - 1)), "le_u", _int(PAGE - _WORD))


_TARGET, _SOURCE, _COUNT = (ir.Local("i32", index) for index in range(3))
_CHARACTER = ir.Local("i32", 3)
_LONG, _BITS = ir.Local("i64", 4), ir.Local("i64", 5)

Code = tuple[tuple[ir.ValueType, ...], tuple[ir.Statement, ...]]
"""Types of the locals after the parameters, and the body."""


def _store_rest() -> tuple[ir.Statement, ...]:
    """Return the stores of the bytes of a word before its first zero byte, and of the zero."""
    parts: list[ir.Statement] = []
    sizes: tuple[tuple[ir.Width, int], ...] = (("w32", 4), ("u16", 2), ("u8", 1))
    for width, size in sizes:
        bits = size * 8
        wanted = _is(_binary("and", _BITS, _long(bits)), "ne", _long(0))
        parts.append(
            _if(
                wanted,
                _store(width, _TARGET, ir.Convert("i32", "wrap_i64", _LONG)),
                _set(_LONG, _binary("shr_u", _LONG, _long(bits))),
                _move(_TARGET, size),
            )
        )
    return (*parts, _store("u8", _TARGET, _int(0)), ir.Return(0))


def _string_assign() -> Code:
    """Go by words while neither the string, the limit nor the page ends, then by characters."""
    apart = _is(_binary("sub", _TARGET, _SOURCE), "ge_u", _int(_WORD))
    long_enough = _is(_COUNT, "ge_s", _int(_WORD))
    by_words = _while(
        1,
        _is(_binary("and", long_enough, _within_page(_SOURCE)), "ne", _int(0)),
        _set(_LONG, _load("w64", _SOURCE)),
        _set(_BITS, _zeros(_LONG)),
        _if(
            _is(_BITS, "ne", _long(0)),
            _set(_BITS, ir.Unary("i64", "ctz", _BITS)),
            *_store_rest(),
        ),
        _store("w64", _TARGET, _LONG),
        _move(_TARGET, _WORD),
        _move(_SOURCE, _WORD),
        _move(_COUNT, -_WORD),
    )
    return ("i32", "i64", "i64"), (_if(apart, by_words), *_assign_characters("u8"))


def _assign_characters(width: ir.Width) -> tuple[ir.Statement, ...]:
    size = ir.BYTES[width]
    loop = _while(
        2,
        _is(_COUNT, "gt_s", _int(0)),
        _set(_CHARACTER, _load(width, _SOURCE)),
        _if(_is(_CHARACTER, "eq", _int(0)), ir.Break(0, 2)),
        _store(width, _TARGET, _CHARACTER),
        _move(_TARGET, size),
        _move(_SOURCE, size),
        _move(_COUNT, -1),
    )
    return loop, _store(width, _TARGET, _int(0))


_LEFT, _RIGHT, _LEFT_CHARACTER, _RIGHT_CHARACTER = (ir.Local("i32", index) for index in range(4))
_LEFT_LONG, _RIGHT_LONG, _END_BITS = (ir.Local("i64", index) for index in (4, 5, 6))


def _string_compare() -> Code:
    """Go by words while no page ends, then by characters."""
    within = _binary("and", _within_page(_LEFT), _within_page(_RIGHT))
    differing = _binary("or", _binary("xor", _LEFT_LONG, _RIGHT_LONG), _zeros(_LEFT_LONG))
    by_words = _while(
        1,
        _is(within, "ne", _int(0)),
        _set(_LEFT_LONG, _load("w64", _LEFT)),
        _set(_RIGHT_LONG, _load("w64", _RIGHT)),
        _set(_END_BITS, differing),
        _if(_is(_END_BITS, "ne", _long(0)), *_return_difference()),
        _move(_LEFT, _WORD),
        _move(_RIGHT, _WORD),
    )
    return ("i32", "i32", "i64", "i64", "i64"), (by_words, *_compare_characters("u8"))


def _return_difference() -> tuple[ir.Statement, ...]:
    """Return the end of a comparison of two words that differ, or of which one has a zero."""
    shift = _binary("and", ir.Unary("i64", "ctz", _END_BITS), _long(0x38))

    def character(word: ir.Local) -> ir.Expression:
        low = ir.Convert("i32", "wrap_i64", _binary("shr_u", word, _END_BITS))
        return _binary("and", low, _int(0xFF))

    difference = _binary("sub", character(_LEFT_LONG), character(_RIGHT_LONG))
    return _set(_END_BITS, shift), ir.Return(0, difference)


def _compare_characters(width: ir.Width) -> tuple[ir.Statement, ...]:
    size = ir.BYTES[width]
    end = _binary(
        "or",
        _is(_LEFT_CHARACTER, "ne", _RIGHT_CHARACTER),
        _is(_LEFT_CHARACTER, "eq", _int(0)),
    )
    loop = ir.Loop(
        0,
        2,
        (
            _set(_LEFT_CHARACTER, _load(width, _LEFT)),
            _set(_RIGHT_CHARACTER, _load(width, _RIGHT)),
            _if(end, ir.Break(0, 2)),
            _move(_LEFT, size),
            _move(_RIGHT, size),
        ),
    )
    return loop, ir.Return(0, _binary("sub", _LEFT_CHARACTER, _RIGHT_CHARACTER))


def _copy() -> Code:
    """Go upwards, but downwards where the target begins inside the source."""
    inside = _is(_binary("sub", _TARGET, _SOURCE), "lt_u", _COUNT)
    return (), (_if(inside, *_copy_down(), ir.Return(0)), *_copy_up())


def _copy_up() -> tuple[ir.Statement, ...]:
    return tuple(
        _while(
            label,
            _is(_COUNT, "ge_u", _int(size)),
            _store(width, _TARGET, _load(width, _SOURCE)),
            _move(_TARGET, size),
            _move(_SOURCE, size),
            _move(_COUNT, -size),
        )
        for label, width, size in _BY_WORDS_THEN_BYTES
    )


def _copy_down() -> tuple[ir.Statement, ...]:
    return tuple(
        _while(
            label + 2,
            _is(_COUNT, "ge_u", _int(size)),
            _move(_COUNT, -size),
            _store(
                width,
                _binary("add", _TARGET, _COUNT),
                _load(width, _binary("add", _SOURCE, _COUNT)),
            ),
        )
        for label, width, size in _BY_WORDS_THEN_BYTES
    )


_VALUE = ir.Local("i32", 1)
_VALUES = ir.Local("i64", 3)


def _fill() -> Code:
    byte = ir.Convert("i64", "extend_i32_u", _binary("and", _VALUE, _int(0xFF)))
    values: dict[ir.Width, ir.Expression] = {"w64": _VALUES, "u8": _VALUE}
    loops = tuple(
        _while(
            label,
            _is(_COUNT, "ge_u", _int(size)),
            _store(width, _TARGET, values[width]),
            _move(_TARGET, size),
            _move(_COUNT, -size),
        )
        for label, width, size in _BY_WORDS_THEN_BYTES
    )
    return ("i64",), (_set(_VALUES, _binary("mul", byte, _long(0x0101010101010101))), *loops)


_BY_WORDS_THEN_BYTES: Final[tuple[tuple[int, ir.Width, int], ...]] = ((1, "w64", 8), (2, "u8", 1))
"""Label of a loop, width and size of its accesses."""

_BODIES: Final[Mapping[str, Code]] = {
    "rt.string_assign": _string_assign(),
    "rt.wstring_assign": (("i32",), _assign_characters("u16")),
    "rt.string_compare": _string_compare(),
    "rt.wstring_compare": (("i32", "i32"), _compare_characters("u16")),
    "rt.copy": _copy(),
    "rt.fill": _fill(),
}
