"""MpUserXLogin of mapp UserX: whoever logs in is known, with all rights.

Users, passwords and levels of the configuration are not read: any name that is not empty logs in.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Final

from plcsim.library.mapp.command import CommandBlock
from plcsim.library.mapp.errors import NO_ERROR
from plcsim.library.members import target_of
from st_types.types.derived import WStringType

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.mapp.block import MappBlock
    from plcsim.library.members import BlockVariables, FindType
    from st_types.types.derived import StructType

NOBODY_LEVEL: Final = 1
USER_LEVEL: Final = 100
"""CurrentLevel with nobody and with somebody who is logged in."""

ACCESS_NONE: Final = 1
ACCESS_FULL: Final = 4
"""mpUSERX_ACCESS_NONE and ..._FULL."""


class _Users:
    """Who is logged in, by MpLink; a restart forgets it."""

    def __init__(self, _context: Context) -> None:
        self.by_link: dict[int, str] = {}


class UserLogin(CommandBlock):
    """MpUserXLogin: blocks with one MpLink know one user."""

    commands: ClassVar[tuple[str, ...]] = ("Login", "Logout")

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._name_type = target_of(data_type, "UserName")

    def seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return who is logged in, and what it is about to do."""
        return self.running(variables), self.context.library(_Users).by_link.get(link, "")

    def call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Take a command, and show who is logged in."""
        super().call(address, variables, link)
        user = self.context.library(_Users).by_link.get(link, "")
        variables.set(CurrentUser=user, CurrentLevel=USER_LEVEL if user else NOBODY_LEVEL)
        for index in range(variables.count_of("AccessRights")):
            variables.set_element("AccessRights", index, ACCESS_FULL if user else ACCESS_NONE)

    def do(self, name: str, _address: int, variables: BlockVariables, link: int) -> int:
        """Log in or out."""
        user = self._user(variables) if name == "Login" else ""
        self.context.library(_Users).by_link[link] = user
        return NO_ERROR

    def _user(self, variables: BlockVariables) -> str:
        """Return UserName, a WSTRING or, in older versions, a STRING."""
        if not isinstance(self._name_type, WStringType):
            return variables.text("UserName")
        address = variables.address("UserName")
        found: str = self.context.memory.get(self._name_type, address) if address else ""
        return found


BLOCKS: Final[Mapping[str, type[MappBlock]]] = {"MpUserXLogin": UserLogin}
"""What runs the blocks by their names."""
