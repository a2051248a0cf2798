"""Hypothesis strategies for tags, from their declared types, and for stimuli."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, Literal

from hypothesis import strategies as st

from plcsim.testing.times import duration_ns
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
from st_types.types.elementary import ElementaryType, Kind

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from plcsim.testing.plc import Plc
    from st_types.types.elementary import DataType

__tracebackhide__ = True


def values_of(data_type: DataType[Any]) -> st.SearchStrategy[Any]:
    """Return a strategy for plain values that variables of a type can take.

    Integers, and so TIME and dates, go over the whole range of the type; REAL and LREAL are finite
    numbers that the type holds exactly; a STRUCT gives a dict, an ARRAY a list.
    """
    match resolve_alias(data_type):
        case ElementaryType(kind=Kind.BOOL):
            return st.booleans()
        case ElementaryType(kind=Kind.REAL, size=size):
            return st.floats(allow_nan=False, allow_infinity=False, width=32 if size == 4 else 64)
        case ElementaryType(minimum=low, maximum=high) | SubrangeType(minimum=low, maximum=high):
            return st.integers(low, high)
        case EnumerationType(values=values):
            return st.sampled_from(sorted(set(values.values())))
        case ReferenceType():
            return st.just(0)
        case StringType(length=length):
            return _text(length, "latin-1")
        case WStringType(length=length):
            return _text(length // 2, "utf-16-le")
        case ArrayType(element=element, count=count):
            return st.lists(values_of(element), min_size=count, max_size=count)
        case StructType(members=members):
            return st.fixed_dictionaries({m.name: values_of(m.data_type) for m in members})
    raise TypeError(f"{data_type} has no values.")


def _text(length: int, codec: str) -> st.SearchStrategy[str]:
    """Return texts without NUL, which ends a string on the controller."""
    return st.text(st.characters(codec=codec, exclude_characters="\0"), max_size=length)


def tag_values(
    plc: Plc, path: str, low: float | None = None, high: float | None = None
) -> st.SearchStrategy[Any]:
    """Return a strategy for values of a tag, from its declared type.

    Args:
        plc: the controller.
        path: the tag.
        low: smallest number, where the plant cannot give less.
        high: largest number.

    Raises:
        TagError: there is no such tag.
    """
    data_type = plc.tags.find(path).data_type
    if low is None and high is None:
        return values_of(data_type)
    if isinstance(data_type, ElementaryType) and data_type.kind is Kind.REAL:
        width: Literal[32, 64] = 32 if data_type.size == 4 else 64
        bounds = [_held(bound, width) for bound in (low, high)]
        return st.floats(*bounds, allow_nan=False, allow_infinity=False, width=width)
    return st.integers(
        getattr(data_type, "minimum", 0) if low is None else int(low),
        getattr(data_type, "maximum", 0) if high is None else int(high),
    )


def _held(bound: float | None, width: int) -> float | None:
    """Return a bound as a number that the type holds."""
    if bound is None or width == 64:
        return bound
    rounded: float = struct.unpack("<f", struct.pack("<f", bound))[0]
    return rounded


def stimuli(
    plc: Plc,
    paths: Sequence[str] | Mapping[str, st.SearchStrategy[Any]],
    duration: str,
    most: int = 20,
) -> st.SearchStrategy[list[tuple[int, dict[str, Any]]]]:
    """Return a strategy for stimuli, as `Plc.stimulate` takes them.

    Args:
        plc: the controller.
        paths: the tags to be written; a mapping gives the strategy of each.
        duration: the times lie within it.
        most: number of stimuli at most.
    """
    if isinstance(paths, dict):
        values = dict(paths)
    else:
        values = {path: tag_values(plc, path) for path in paths}
    written = st.sampled_from(sorted(values)).flatmap(
        lambda path: st.fixed_dictionaries({path: values[path]})
    )
    moment = st.integers(0, duration_ns(duration, "stimuli"))
    return st.lists(st.tuples(moment, written), max_size=most).map(
        lambda drawn: sorted(drawn, key=lambda one: one[0])
    )
