"""Pointers, followed on demand: ``cell.head^.next^.value``, as Structured Text writes it.

A path is followed anew whenever somebody asks for it; where the pointer has changed meanwhile, what
is watched is still what it pointed to. An address that is none is told, and nothing is read there.
"""

from __future__ import annotations

import asyncio
import re
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.errors import PlcError, TagError
from plcsim.core.tag import Tag
from plcsim.shared_image.command import Cancel, SampleCommand
from plcsim.shared_image.directory import type_from
from plcsim.shared_image.samples import MOST
from plcsim.web.pointers import key_of
from st_types.types import paths
from st_types.types.elementary import UDINT

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.shared_image import Directory
    from plcsim.web.service.commander import Commander
    from plcsim.web.service.values import LiveValues
    from st_types.types.elementary import DataType

MOST_STEPS: Final = 50
"""Pointers of one path."""

PROBE: Final = MOST
"""Number of the sample by which an address is tried."""

PATIENCE_S: Final = 2.0
LOOK_S: Final = 0.02

_INDICES: Final = re.compile(r"(?:\[[^\]]*\])+$")
_HEAD: Final = re.compile(r"\w*")


class Follower:
    """Finds variables, those that pointers point to included.

    Args:
        directory: of the shared image.
        given: of `plcsim.web.pointers.pointers_of`.
        values: reads the pointers.
        commander: tries addresses.
    """

    def __init__(
        self,
        directory: Directory,
        given: Mapping[str, Any],
        values: LiveValues,
        commander: Commander,
    ) -> None:
        self._directory = directory
        self._types: list[DataType[Any]] = [type_from(each) for each in given["types"]]
        self._members: Mapping[str, Mapping[str, int]] = given["members"]
        self._values = values
        self._commander = commander
        self._probing = asyncio.Lock()

    def target(self, struct: DataType[Any], member: str, path: str) -> DataType[Any] | None:
        """Return what a member points to, None where it is no pointer.

        Args:
            struct: that has the member.
            member: its name.
            path: of the member; tells the area it lies in, or was followed from.
        """
        head = _HEAD.match(path)
        area = head[0].upper() if head else ""
        known = self._members.get(area) or self._members.get("") or {}
        number = known.get(key_of(struct, member))
        return None if number is None else self._types[number]

    def target_at(self, root: DataType[Any], rest: str, path: str) -> DataType[Any] | None:
        """Return what a pointer points to that lies in a variable.

        Args:
            root: type of the variable.
            rest: path of the pointer in it.
            path: of the variable.
        """
        parent, _, member = _INDICES.sub("", rest).rpartition(".")
        try:
            struct = paths.find(root, parent)[0] if parent else root
        except KeyError:
            return None
        return self.target(struct, member, path)

    async def find(self, path: str, known: dict[str, Tag] | None = None) -> Tag:
        """Return a variable.

        Args:
            path: such as ``cell.count`` or ``cell.head^.next^.value``.
            known: keeps where pointers lead, for further paths that are asked for just now.

        Raises:
            TagError: there is no such variable, or what should be followed is no pointer, is 0, or
                points nowhere.
        """
        first, *rest = path.split("^")
        tag = self._directory.find(first)
        if len(rest) > MOST_STEPS:
            raise TagError(f"{path[:80]}: more than {MOST_STEPS} pointers")
        target = self._first_target(first) if rest else None
        done = first
        for at, inner in enumerate(rest):
            followed = known.get(done) if known else None
            tag = followed or await self._followed(done, tag, target)
            if known is not None:
                known[done] = tag
            done = f"{done}^"
            bare = inner.removeprefix(".")
            if bare:
                root = tag.data_type
                try:
                    data_type, offset = paths.find(root, bare)
                except KeyError as err:
                    raise TagError(f"{done}: {err.args[0]}") from None
                done = f"{done}{inner}"
                tag = Tag(done, data_type, tag.address + offset)
                target = self.target_at(root, bare, first) if at + 1 < len(rest) else None
            else:
                target = None
        return tag

    def pointer(self, path: str) -> DataType[Any] | None:
        """Return what a variable points to that is not reached by pointers itself."""
        return self._first_target(path) if "^" not in path else None

    def _first_target(self, path: str) -> DataType[Any] | None:
        bare = path.removeprefix("::")
        head = bare.partition(".")[0].partition("[")[0].upper()
        for area in self._directory.areas:
            own = area.path.upper()
            rest = bare[len(own) + 1 :] if own and own == head else "" if own else bare
            target = self.target_at(area.data_type, rest, path) if rest else None
            if target is not None:
                return target
        return None

    async def _followed(self, path: str, pointer: Tag, target: DataType[Any] | None) -> Tag:
        if target is None or pointer.data_type.size != UDINT.size:
            raise TagError(f"{path} is no pointer, or to what is not known")
        address = await self._address(pointer)
        if not address:
            raise TagError(f"{path} points to nothing: it is 0")
        async with self._probing:  # one number for all
            tried = SampleCommand(PROBE, 0, 0, [(address, target.size)])
            try:
                await self._commander.ask(tried, path)
            except PlcError:
                raise TagError(f"{path}: nothing lies at 16#{address:08X}") from None
            await self._commander.ask(Cancel(PROBE), path)
        return Tag(f"{path}^", target, address)

    async def _address(self, pointer: Tag) -> int:
        watched = self._values.watch([pointer])
        try:
            async with asyncio.timeout(PATIENCE_S):
                while True:
                    self._values.refresh()
                    if isinstance(watched[0].value, int):
                        return watched[0].value
                    await asyncio.sleep(LOOK_S)
        except TimeoutError:
            raise TagError(f"{pointer.path} is not told by the scan") from None
        finally:
            self._values.leave(watched)
