"""Paths of variables: ``motor.axes[3].name``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from st_types.types.derived import ArrayType, StructType, resolve_alias

if TYPE_CHECKING:
    from st_types.types.elementary import DataType

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
        place = data_type.index_of(*(int(i) for i in step.strip("[]").split(",")))
    except (ValueError, IndexError) as err:
        raise KeyError(f"{step}: {err}") from None
    element = resolve_alias(data_type.element)
    return element, place * element.size


def _member(data_type: StructType[Any], step: str) -> tuple[DataType[Any], int]:
    declared = data_type.spelling(step)
    if declared is None:
        raise KeyError(f"{data_type} has no member {step}")
    member, offset = data_type.find(declared)
    return resolve_alias(member.data_type), offset
