"""Paths of variables such as ``motor.axes[3].name``, and the walk through a type."""

from __future__ import annotations

import re
from functools import partial
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    ReferenceType,
    Section,
    StructType,
    resolve_alias,
)
from st_types.types.elementary import DataType

if TYPE_CHECKING:
    from collections.abc import Iterator

_STEP = re.compile(r"\w+|\[[^][]*\]")
_PATH = re.compile(rf"({_STEP.pattern})(\.\w+|\[[^][]*\])*")


def find(data_type: DataType[object], path: str) -> tuple[DataType[Any], int]:
    """Return the type and the offset in bytes of ``path`` inside a variable.

    Args:
        data_type: the variable's type.
        path: such as ``"motor.speed"``, ``"axes[3].name"``, ``"grid[1, 2]"``; "" is the variable.
            A member may be written in another case where that is not ambiguous.

    Raises:
        KeyError: there is no such member, an index is wrong, or it is not a path; the argument
            says which.
    """
    if path and not _PATH.fullmatch(path):
        raise KeyError(f"{path} is not a path such as axes[3].name")
    found = resolve_alias(data_type)
    offset = 0
    for step in _STEP.findall(path):
        if step.startswith("["):
            found, inner = _element(found, step)
        elif isinstance(found, StructType):
            found, inner = _member(found, step)
        else:
            raise KeyError(f"{found} has no members ({step})")
        offset += inner
    return found, offset


def _element(data_type: DataType[Any], step: str) -> tuple[DataType[Any], int]:
    if not isinstance(data_type, ArrayType):
        raise KeyError(f"{data_type} has no elements ({step})")
    try:
        position = data_type.index_of(*(int(i) for i in step.strip("[]").split(",")))
    except (ValueError, IndexError) as err:
        raise KeyError(f"{step}: {err}") from None
    element = resolve_alias(data_type.element)
    return element, position * element.size


def _member(data_type: StructType[Any], step: str) -> tuple[DataType[Any], int]:
    declared = data_type.spelling(step)
    if declared is None:
        raise KeyError(f"{data_type} has no member {step}")
    member, offset = data_type.find(declared)
    return resolve_alias(member.data_type), offset


class Part(NamedTuple):
    """A variable inside a variable.

    Attributes:
        path: such as ``axes[3].name``.
        data_type: aliases resolved.
        offset: bytes from the start.
        declared: its type as it is declared.
    """

    path: str
    data_type: DataType[Any]
    offset: int
    declared: DataType[Any]


def parts(
    declared: DataType[Any],
    path: str = "",
    offset: int = 0,
    *,
    elements: bool = True,
    blocks: bool = True,
    internals: bool = True,
) -> Iterator[Part]:
    """Yield a variable and all that lies in it, each before what it holds, in declared order.

    Args:
        declared: its type.
        path: of the variable.
        offset: of its first byte.
        elements: go into every element of an ARRAY; otherwise into the first one.
        blocks: go into the data blocks of function blocks as well.
        internals: go into the internal variables of function blocks as well.
    """
    data_type = resolve_alias(declared)
    yield Part(path, data_type, offset, declared)
    further = partial(parts, elements=elements, blocks=blocks, internals=internals)
    if isinstance(data_type, StructType):
        is_block = isinstance(data_type, DataBlockType)
        if is_block and not blocks:
            return
        for member, at in zip(data_type.members, data_type.offsets, strict=True):
            if internals or not is_block or member.section is not Section.INTERNAL:
                inner = f"{path}.{member.name}" if path else member.name
                yield from further(member.data_type, inner, offset + at)
    elif isinstance(data_type, ArrayType):
        ranges = (range(low, (high if elements else low) + 1) for low, high in data_type.bounds)
        for number, index in enumerate(product(*ranges)):
            inner = f"{path}[{','.join(map(str, index))}]"
            yield from further(data_type.element, inner, offset + number * data_type.element.size)


def leaves(
    data_type: DataType[Any],
    path: str = "",
    offset: int = 0,
    *,
    elements: bool = True,
    blocks: bool = True,
    internals: bool = True,
) -> Iterator[Part]:
    """Yield the `parts` that hold a value and no parts: no STRUCT, data block or ARRAY."""
    found = parts(data_type, path, offset, elements=elements, blocks=blocks, internals=internals)
    for part in found:
        if not isinstance(part.data_type, StructType | ArrayType):
            yield part


def inner_types(data_type: DataType[object]) -> Iterator[DataType[object]]:
    """Yield the types that stand in the declaration of ``data_type``, aliases as they are."""
    match data_type:
        case AliasType(target=target):
            yield target
        case ArrayType(element=element):
            yield element
        case StructType(members=members):
            yield from (member.data_type for member in members)
        case ReferenceType(target=DataType() as target):
            yield target
