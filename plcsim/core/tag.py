"""Tags: variables as the outside names them, ``program.member[index].member``.

A global variable has its bare name, ``gCount``; ``::gCount`` is that one even where a program has
the same name.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.errors import TagError
from plcsim.core.suggestion import did_you_mean
from st_types.errors import ValueRangeError
from st_types.types import paths
from st_types.types.derived import StructType
from st_types.types.values import encode

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from plcsim.core.memory import Memory
    from st_types.types.elementary import DataType

GLOBAL: Final = "::"
"""Before the name of a global variable, where that is to be said."""

CHANNELS: Final = "IoMap"
"""Path of the tag of all I/O channels: ``IoMap.X20DI9371.DigitalInput01``."""

_CHANNEL: Final = re.compile(r'%[IQ][XBWDO]?\."([^"]+)"\.(.+)', re.IGNORECASE)

_HEAD: Final = re.compile(r"\w*")


class Tag(NamedTuple):
    """A variable under the name by which it is read and written from outside.

    Attributes:
        path: such as ``"conveyor.motor.speed"``; of all variables of a program its name, of all
            global variables "".
        data_type: its type, aliases resolved.
        address: PLC address of its first byte.
        is_constant: it is, or lies in, a CONSTANT, which nobody may write.
    """

    path: str
    data_type: DataType[Any]
    address: int
    is_constant: bool = False


def find_tag(path: str, areas: Sequence[Tag]) -> Tag:
    """Return the tag ``path``; case does not matter.

    Args:
        path: such as ``"conveyor.motor.speed"``, ``"gCount"``.
        areas: all variables of each program, and the global ones, as one tag each; constants apart.

    Raises:
        TagError: there is no such tag; the message offers names that are near.
    """
    try:
        return locate(path, areas)
    except KeyError as err:
        known = (tag.path for area in areas for tag in leaves(area, elements=False))
        near = did_you_mean(path, known, most=3)
        raise TagError(f"{err.args[0]}{near}") from None


def locate(path: str, areas: Sequence[Tag]) -> Tag:
    """Return the tag ``path``; arguments as for `find_tag`.

    Raises:
        KeyError: there is no such tag; the argument says what is wrong.
    """
    if path.startswith("%"):
        path = _channel_path(path)
    bare = path.removeprefix(GLOBAL)
    head = _HEAD.match(bare)
    name = head[0] if head else ""
    own = [a for a in areas if a.path and a.path.upper() == name.upper() and bare == path]
    shared = [area for area in areas if not area.path]
    is_shared = any(_has(area, name) for area in shared)
    if own and not (is_shared and not any(area.data_type.size for area in own)):
        return _inside(path, bare[len(name) :].removeprefix("."), own)
    if is_shared:  # or the one instance of a program that has no variables of its own
        return _inside(path, bare, shared)
    what = "no program" if not shared else "no program and no global variable"
    raise KeyError(f"{what} {name!r} for tag {path!r}")


def _channel_path(path: str) -> str:
    """Return the path of an I/O channel that is spelled as in the map of channels."""
    found = _CHANNEL.fullmatch(path)
    if found is None:
        raise KeyError(f'{path} is no channel such as %IX."X20DI9371".DigitalInput01')
    module, channel = (re.sub(r"\W", "_", part) for part in found.groups())
    return f"{CHANNELS}.{module}.{channel}"


def _has(area: Tag, name: str) -> bool:
    data_type = area.data_type
    return isinstance(data_type, StructType) and data_type.spelling(name) is not None


def _inside(path: str, rest: str, candidates: Sequence[Tag]) -> Tag:
    """Return the tag ``rest`` of the first candidate that has it."""
    text = ""
    for area in candidates:
        try:
            data_type, offset = paths.find(area.data_type, rest)
        except KeyError as err:
            text = text or str(err.args[0])
            continue
        return Tag(path, data_type, area.address + offset, area.is_constant)
    raise KeyError(f"no tag {path!r}: {text}")


class TagTable:
    """All tags of a controller.

    Args:
        memory: where the variables lie.
        areas: see `find_tag`.
    """

    def __init__(self, memory: Memory, areas: Sequence[Tag]) -> None:
        self._memory = memory
        self._areas = areas

    def find(self, path: str) -> Tag:
        """Return the tag ``path``; case does not matter.

        Raises:
            TagError: there is no such tag; the message offers names that are near.
        """
        return find_tag(path, self._areas)

    def get(self, path: str) -> Tag | None:
        """Return the tag ``path``, None where there is none; quick in both cases."""
        try:
            return locate(path, self._areas)
        except KeyError:
            return None

    def read(self, tag: Tag) -> object:
        """Return the plain value of a tag (see `st_types.types.values.decode`)."""
        return self._memory.get(tag.data_type, tag.address)

    def write(self, tag: Tag, value: object) -> None:
        """Store a plain value.

        Raises:
            TagError: the tag cannot take the value, or is constant.
        """
        self._memory.write(tag.address, encode_tag(tag, value))

    def __iter__(self) -> Iterator[Tag]:
        """Iterate over all tags of elementary, enumeration and string types.

        Of an ARRAY only the first element's are named.
        """
        for area in self._areas:
            yield from leaves(area, elements=False)


def encode_tag(tag: Tag, value: object) -> bytes:
    """Return the bytes of a value that is to be stored in a tag.

    Raises:
        TagError: the tag cannot take the value, or is constant.
    """
    if tag.is_constant:
        raise TagError(f"tag {tag.path} is CONSTANT")
    try:
        return encode(tag.data_type, value)
    except ValueRangeError as err:
        raise TagError(f"tag {tag.path}: {err}") from None


def leaves(
    tag: Tag, *, blocks: bool = True, elements: bool = True, internals: bool = True
) -> Iterator[Tag]:
    """Iterate over the tags of elementary, enumeration and string types below a tag, or itself.

    Args:
        tag: may be all variables of a program.
        blocks: go into the data blocks of function blocks as well.
        elements: go into every element of an ARRAY; otherwise into the first one.
        internals: go into the internal variables of function blocks as well.
    """
    inside = paths.leaves(
        tag.data_type,
        tag.path,
        tag.address,
        blocks=blocks,
        elements=elements,
        internals=internals,
    )
    return (Tag(part.path, part.data_type, part.offset, tag.is_constant) for part in inside)


def differences(
    areas: Iterable[Tag], one: bytes, other: bytes
) -> Iterator[tuple[Tag, bytes, bytes]]:
    """Iterate over the tags that differ in two images of areas, each with its bytes in both.

    Args:
        areas: lie in an image one behind another.
        one: an image.
        other: as long.
    """
    begin = 0
    for area in areas:
        for leaf in leaves(area):
            start = begin + leaf.address - area.address
            here, there = (each[start : start + leaf.data_type.size] for each in (one, other))
            if here != there:
                yield leaf, here, there
        begin += area.data_type.size
