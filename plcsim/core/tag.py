"""Tags: the variables of programs as the outside names them, ``program.member[index].member``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from plcsim.core.errors import TagError
from plcsim.core.suggestion import did_you_mean
from st_types.errors import ValueRangeError
from st_types.types import paths
from st_types.types.values import encode

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from plcsim.core.memory import Memory
    from st_types.types.elementary import DataType


class Tag(NamedTuple):
    """A variable under the name by which it is read and written from outside.

    Attributes:
        path: such as ``"conveyor.motor.speed"``.
        data_type: its type, aliases resolved.
        address: PLC address of its first byte.
    """

    path: str
    data_type: DataType[Any]
    address: int


def find_tag(path: str, programs: Mapping[str, Tag]) -> Tag:
    """Return the tag ``path``; case does not matter.

    Args:
        path: such as ``"conveyor.motor.speed"``.
        programs: all variables of each program as one tag, by the program's name in capitals.

    Raises:
        TagError: there is no such tag; the message offers names that are near.
    """
    try:
        return locate(path, programs)
    except KeyError as err:
        raise TagError(f"{err.args[0]}{_nearest(path, programs)}") from None


def locate(path: str, programs: Mapping[str, Tag]) -> Tag:
    """Return the tag ``path``; arguments as for `find_tag`.

    Raises:
        KeyError: there is no such tag; the argument says what is wrong.
    """
    name, _, rest = path.partition(".")
    program = programs.get(name.upper())
    if program is None:
        raise KeyError(f"no program {name!r} for tag {path!r}")
    try:
        data_type, offset = paths.find(program.data_type, rest)
    except KeyError as err:
        raise KeyError(f"no tag {path!r}: {err.args[0]}") from None
    return Tag(path, data_type, program.address + offset)


def _nearest(path: str, programs: Mapping[str, Tag]) -> str:
    known = (tag.path for p in programs.values() for tag in leaves(*p, elements=False))
    return did_you_mean(path, known, most=3)


class TagTable:
    """All tags of a controller.

    Args:
        memory: where the variables lie.
        areas: all variables of each program as one tag; its path is the first part of theirs.
    """

    def __init__(self, memory: Memory, areas: Sequence[Tag]) -> None:
        self._memory = memory
        self._programs = {area.path.upper(): area for area in areas}

    def find(self, path: str) -> Tag:
        """Return the tag ``path``; case does not matter.

        Raises:
            TagError: there is no such tag; the message offers names that are near.
        """
        return find_tag(path, self._programs)

    def get(self, path: str) -> Tag | None:
        """Return the tag ``path``, None where there is none; quick in both cases."""
        try:
            return locate(path, self._programs)
        except KeyError:
            return None

    def read(self, tag: Tag) -> object:
        """Return the plain value of a tag (see `st_types.types.values.decode`)."""
        return self._memory.get(tag.data_type, tag.address)

    def write(self, tag: Tag, value: object) -> None:
        """Store a plain value.

        Raises:
            TagError: the tag cannot take the value.
        """
        try:
            data = encode(tag.data_type, value)
        except ValueRangeError as err:
            raise TagError(f"tag {tag.path}: {err}") from None
        self._memory.write(tag.address, data)

    def __iter__(self) -> Iterator[Tag]:
        """Iterate over all tags of elementary, enumeration and string types.

        Of an ARRAY only the first element's are named.
        """
        for program in self._programs.values():
            yield from leaves(*program, elements=False)


def leaves(
    path: str,
    data_type: DataType[Any],
    address: int,
    *,
    blocks: bool = True,
    elements: bool = True,
    internals: bool = True,
) -> Iterator[Tag]:
    """Iterate over the tags below one variable.

    Args:
        path: of the variable.
        data_type: its type.
        address: PLC address of its first byte.
        blocks: go into the data blocks of function blocks as well.
        elements: go into every element of an ARRAY; otherwise into the first one.
        internals: go into the internal variables of function blocks as well.
    """
    inside = paths.leaves(
        data_type, path, address, blocks=blocks, elements=elements, internals=internals
    )
    return (Tag(part.path, part.data_type, part.offset) for part in inside)
