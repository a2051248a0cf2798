"""Users and roles of a controller, and the lists of them that a program goes through."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from plcsim.library.block import StatusError

if TYPE_CHECKING:
    from plcsim.core.context import Context

INTERNAL: Final = -1070585889
END_OF_LIST: Final = -2144327714
DOES_NOT_EXIST: Final = -1070585892
ALREADY_EXISTS: Final = -1070585893
PARAMETER: Final = -1070585894
"""ErrorID, as the vendor's ArUser.var has it."""

USERS: Final = 1
ROLES: Final = 2
ROLES_OF_USER: Final = 3
PROPERTIES_OF_ROLE: Final = 4
PROPERTIES_OF_USER: Final = 5
"""ListType."""

_OWNERS: Final = {
    ROLES_OF_USER: USERS,
    PROPERTIES_OF_ROLE: ROLES,
    PROPERTIES_OF_USER: USERS,
}
"""Whose lists of some types are."""

MOST: Final = 1_000
"""Users, roles, and properties of one of them."""

MOST_LISTS: Final = 64
"""Lists that are kept; older ones make room."""


@dataclass(slots=True)
class Account:
    """A user, or a role.

    Attributes:
        password: of a user.
        roles: of a user, in the order in which they were assigned.
        properties: by their names.
    """

    password: str = ""
    roles: dict[str, None] = field(default_factory=dict)
    properties: dict[str, str] = field(default_factory=dict)


class NameList:
    """A list that a program goes through.

    Args:
        names: in it.
    """

    def __init__(self, names: list[str]) -> None:
        self._names = names
        self._next = 0

    def first(self) -> str:
        """Return the first name.

        Raises:
            StatusError: it is empty.
        """
        self._next = 0
        return self.next()

    def next(self) -> str:
        """Return the next name.

        Raises:
            StatusError: there is none.
        """
        if self._next >= len(self._names):
            raise StatusError(END_OF_LIST)
        self._next += 1
        return self._names[self._next - 1]


class Accounts:
    """The users and roles of a controller; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.users: dict[str, Account] = {}
        self.roles: dict[str, Account] = {}
        self._lists: dict[int, NameList] = {}
        self._last = 0

    def make(self, accounts: dict[str, Account], name: str) -> None:
        """Make a user or a role.

        Raises:
            StatusError: there is one of this name, or there are too many.
        """
        if not name:
            raise StatusError(PARAMETER)
        if name in accounts:
            raise StatusError(ALREADY_EXISTS)
        if len(accounts) >= MOST:
            raise StatusError(INTERNAL)
        accounts[name] = Account()

    def of(self, kind: int, name: str) -> Account:
        """Return a user or a role by its kind and name.

        Raises:
            StatusError: there is none.
        """
        accounts = {USERS: self.users, ROLES: self.roles}.get(kind)
        if accounts is None:
            raise StatusError(PARAMETER)
        if name not in accounts:
            raise StatusError(DOES_NOT_EXIST)
        return accounts[name]

    def begin_list(self, kind: int, name: str) -> int:
        """Return the handle of a list of what there is now.

        Raises:
            StatusError: there is no such list, or nothing of this name.
        """
        names = self._names(kind, name)
        self._last += 1
        self._lists[self._last] = NameList(names)
        if len(self._lists) > MOST_LISTS:
            del self._lists[min(self._lists)]
        return self._last

    def _names(self, kind: int, name: str) -> list[str]:
        whole = {USERS: self.users, ROLES: self.roles}.get(kind)
        if whole is not None:
            return [*whole]
        owner = self.of(_OWNERS.get(kind, 0), name)
        return [*(owner.roles if kind == ROLES_OF_USER else owner.properties)]

    def list_of(self, handle: int) -> NameList:
        """Return the list that a handle stands for.

        Raises:
            StatusError: it stands for none.
        """
        if handle not in self._lists:
            raise StatusError(PARAMETER)
        return self._lists[handle]
