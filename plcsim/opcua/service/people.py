"""Who comes: users of the project by name and password, and certificates of clients."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from asyncua.crypto.permission_rules import User, UserRole
from asyncua.crypto.truststore import TrustStore
from asyncua.crypto.validator import CertificateValidator, CertificateValidatorOptions
from asyncua.server.user_managers import UserManager

from plcsim.access import Role

if TYPE_CHECKING:
    from pathlib import Path

    from asyncua.server.internal_server import InternalServer

    from plcsim.access import Users

ANONYMOUS: Final = "anonymous"


@dataclass
class Person(User):
    """Who has a session.

    Attributes:
        may_write: the role of the user allows it.
    """

    may_write: bool = False


class People(UserManager):
    """Lets users in.

    Without any user in the project everybody may write, and the server is on loopback. Nobody is
    asyncua's administrator, who could change the address space.

    Args:
        users: of the project.
        is_loopback: nobody comes from another machine.
        may_look: where there are users, others may look.
    """

    def __init__(self, users: Users, *, is_loopback: bool, may_look: bool) -> None:
        self._users = users
        self._is_loopback = is_loopback
        self._may_look = may_look

    def get_user(
        self,
        iserver: InternalServer,
        username: str | None = None,
        password: str | None = None,
        certificate: Any = None,
    ) -> Person | None:
        """Return who it is, None for who may not come in."""
        if username is not None:
            user = self._users.check(username, password or "")
            if user is None:
                return None
            return Person(UserRole.User, user.name, user.role.includes(Role.OPERATE))
        if not self._users:
            return Person(UserRole.User, ANONYMOUS, may_write=True) if self._is_loopback else None
        return Person(UserRole.User, ANONYMOUS) if self._may_look else None


async def trust(folder: Path) -> CertificateValidator:
    """Return what takes the certificates in a folder (DER or PEM), and no others."""
    store = TrustStore([folder], [])
    await store.load()
    options = CertificateValidatorOptions.TIME_RANGE | CertificateValidatorOptions.TRUSTED
    return CertificateValidator(
        options | CertificateValidatorOptions.PEER_CLIENT, trust_store=store
    )
