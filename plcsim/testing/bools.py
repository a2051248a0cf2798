"""In tests a BOOL takes a BOOL and nothing else.

What Python programs store in their variables is converted by ctypes, in C, and ctypes gives a BOOL
the truth of whatever comes: ``self.red = "ja"`` switches it on. A check of every store would make
one 3.5 times as dear, so it is done where that costs nobody a cycle: on the virtual clock of a
test. What the source tells is found before any run (`plcsim.program.python.value_check`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from st_types.errors import ValueRangeError
from st_types.types.derived import ArrayType, StructType, resolve_alias
from st_types.types.elementary import ElementaryType, Kind

if TYPE_CHECKING:
    from collections.abc import Iterable

    from plcsim.core.tag import Tag
    from st_types import Struct
    from st_types.types.elementary import DataType


def check_bools(areas: Iterable[Tag]) -> None:
    """Let no view of these variables take anything but False, True, 0 and 1 for a BOOL.

    A store of something else raises ValueRangeError from then on, in every program that has the
    class.
    """
    seen: set[int] = set()
    for area in areas:
        _check_type(area.data_type, seen)


def _check_type(data_type: DataType[Any], seen: set[int]) -> None:
    data_type = resolve_alias(data_type)
    if isinstance(data_type, ArrayType):
        _check_type(data_type.element, seen)
    elif isinstance(data_type, StructType) and id(data_type) not in seen:
        seen.add(id(data_type))
        for member in data_type.members:
            inner = resolve_alias(member.data_type)
            if not (isinstance(inner, ElementaryType) and inner.kind is Kind.BOOL):
                _check_type(inner, seen)
            elif data_type.view is not None:  # otherwise no Python has it
                _check_member(data_type.view, member.name)


def _check_member(view: type[Struct], name: str) -> None:
    owner = next(each for each in view.__mro__ if name in vars(each))
    field = vars(owner)[name]
    if isinstance(field, property):  # it is checked already
        return

    def store(self: Struct, value: object) -> None:
        if value not in (False, True):
            raise ValueRangeError(f"{name} is BOOL and cannot be {value!r}.")
        field.__set__(self, value)

    setattr(owner, name, property(field.__get__, store))
