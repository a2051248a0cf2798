"""The blocks of ArUser, on users that programs have made.

Those of the configuration are not read: whoever is not known logs in with any password.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.library.accounts.accounts import (
    DOES_NOT_EXIST,
    INTERNAL,
    MOST,
    USERS,
    Accounts,
)
from plcsim.library.block import StatusError
from plcsim.library.block_model import BlockModel
from plcsim.library.members import BlockVariables, rises

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import FindType
    from st_types.types.derived import StructType


class _Running:
    """The blocks that are Busy, by address; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.blocks: set[int] = set()


class AccountBlock(BlockModel):
    """Runs the blocks of one type on one controller.

    One with an output Busy is so in the call with the rising edge of Execute, and done in the next
    one; one without is done at once. Done and Error stay while Execute is TRUE.
    """

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._is_delayed = self._members.find("Busy") is not None

    def run(self, address: int) -> None:
        """Run the block whose data block lies at an address."""
        variables = self.variables(address)
        running = self.context.library(_Running).blocks
        is_edge = rises(self.context, address, variables, "Execute")
        if is_edge and self._is_delayed:
            running.add(address)
            variables.set(Busy=True, Done=False, Error=False, ErrorID=0)
        elif is_edge or address in running:
            running.discard(address)
            self._finish(variables)
        elif not variables.is_true("Execute"):
            variables.set(Busy=False, Done=False, Error=False, ErrorID=0)

    def _finish(self, variables: BlockVariables) -> None:
        error_id = 0
        try:
            self.act(variables, self.context.library(Accounts))
        except StatusError as refused:
            error_id = refused.status
        variables.set(Busy=False, Done=not error_id, Error=error_id != 0, ErrorID=error_id)

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Do what the block is for.

        Raises:
            StatusError: it cannot.
        """
        raise NotImplementedError(type(self).__name__)


class CreateUser(AccountBlock):
    """ArUserCreate."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Make it, without a password."""
        accounts.make(accounts.users, variables.own_text("UserName"))


class DeleteUser(AccountBlock):
    """ArUserDelete."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Delete it."""
        accounts.of(USERS, variables.own_text("UserName"))
        del accounts.users[variables.own_text("UserName")]


class CreateRole(AccountBlock):
    """ArUserCreateRole."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Make it."""
        accounts.make(accounts.roles, variables.own_text("RoleName"))


class SetPassword(AccountBlock):
    """ArUserSetPassword."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Set it."""
        user = accounts.of(USERS, variables.own_text("UserName"))
        user.password = variables.own_text("Password")


class AuthenticatePassword(AccountBlock):
    """ArUserAuthenticatePassword."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Compare it."""
        user = accounts.users.get(variables.own_text("UserName"))
        is_right = user is None or user.password == variables.own_text("Password")
        variables.set(IsAuthentic=is_right)


class AssignRole(AccountBlock):
    """ArUserAssignRole: a role that there is not is made."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Assign it."""
        user, role = accounts.of(USERS, variables.own_text("UserName")), _role(variables)
        if role not in accounts.roles:
            accounts.make(accounts.roles, role)
        user.roles[role] = None


class ReleaseRole(AccountBlock):
    """ArUserReleaseRole."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Release it."""
        user, role = accounts.of(USERS, variables.own_text("UserName")), _role(variables)
        if role not in user.roles:
            raise StatusError(DOES_NOT_EXIST)
        del user.roles[role]


class HasRole(AccountBlock):
    """ArUserHasRole."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Look."""
        user = accounts.of(USERS, variables.own_text("UserName"))
        variables.set(HasRole=_role(variables) in user.roles)


def _role(variables: BlockVariables) -> str:
    return variables.own_text("RoleName")


class BeginList(AccountBlock):
    """ArUserInitList."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Begin it."""
        kind, name = int(variables.number("ListType")), variables.own_text("ElementName")
        variables.set(List__Handle=accounts.begin_list(kind, name))


class FirstInList(AccountBlock):
    """ArUserGetFirst."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Give the first name."""
        names = accounts.list_of(int(variables.number("List.Handle")))
        variables.set(ElementName=names.first())


class NextInList(AccountBlock):
    """ArUserGetNext."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Give the next name."""
        names = accounts.list_of(int(variables.number("List.Handle")))
        variables.set(ElementName=names.next())


class SetProperty(AccountBlock):
    """ArUserSetProperty."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Set it."""
        properties = _properties(variables, accounts)
        name = variables.own_text("PropertyName")
        if name not in properties and len(properties) >= MOST:
            raise StatusError(INTERNAL)
        properties[name] = variables.own_text("PropertyValue")


class GetProperty(AccountBlock):
    """ArUserGetProperty."""

    def act(self, variables: BlockVariables, accounts: Accounts) -> None:
        """Give it."""
        found = _properties(variables, accounts).get(variables.own_text("PropertyName"))
        if found is None:
            raise StatusError(DOES_NOT_EXIST)
        variables.set(PropertyValue=found)


def _properties(variables: BlockVariables, accounts: Accounts) -> dict[str, str]:
    kind, name = int(variables.number("ElementType")), variables.own_text("ElementName")
    return accounts.of(kind, name).properties


BLOCKS: Final[Mapping[str, type[AccountBlock]]] = {
    "ArUserCreate": CreateUser,
    "ArUserDelete": DeleteUser,
    "ArUserCreateRole": CreateRole,
    "ArUserSetPassword": SetPassword,
    "ArUserAuthenticatePassword": AuthenticatePassword,
    "ArUserAssignRole": AssignRole,
    "ArUserReleaseRole": ReleaseRole,
    "ArUserHasRole": HasRole,
    "ArUserInitList": BeginList,
    "ArUserGetFirst": FirstInList,
    "ArUserGetNext": NextInList,
    "ArUserSetProperty": SetProperty,
    "ArUserGetProperty": GetProperty,
}
"""What runs the blocks by their names."""
