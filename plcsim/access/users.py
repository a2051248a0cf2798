"""The users of a project: names, roles, hashes of passwords, and tokens for scripts.

They are in a file of JSON that only its owner can read, beside what else the project keeps. A
password is hashed by Argon2id (RFC 9106), with the parameters of argon2-cffi. A token is 256 random
bits, so its SHA-256 is enough: nobody finds it by trying.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import secrets
import tempfile
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.access.role import Role
from plcsim.core.errors import PlcError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from argon2 import PasswordHasher

FILE: Final = ".plcsim/users.json"
SHORTEST: Final = 8
"""Characters of a password."""

LONGEST: Final = 1024
"""Characters of a password; hashing takes time with its length."""

_NAME: Final = re.compile(r"[A-Za-z0-9][A-Za-z0-9._@-]{0,63}")


class UsersError(PlcError):
    """The file of users cannot be used, or what is asked of it makes no sense."""


class User(NamedTuple):
    """Somebody who is known.

    Attributes:
        name: of the user, or of the token.
        role: what they may do.
    """

    name: str
    role: Role


class Users:
    """The users of a project; a change of the file is seen at the next look.

    Args:
        file: see `users_file`.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._seen: tuple[int, int] | None = None
        self._values: dict[str, dict[str, Any]] = {"users": {}, "tokens": {}}

    @property
    def file(self) -> Path:
        """The file."""
        return self._file

    def _read(self) -> Mapping[str, dict[str, Any]]:
        """Return what is in the file.

        Raises:
            UsersError: it is damaged, or others could read it.
        """
        try:
            found = self._file.stat()
        except FileNotFoundError:
            self._seen, self._values = None, {"users": {}, "tokens": {}}
            return self._values
        seen = found.st_mtime_ns, found.st_ino
        if seen != self._seen:
            if found.st_mode & 0o077:
                raise UsersError(f"{self._file}: others may read it; chmod 600 {self._file}")
            self._values = _parsed(self._file)
            self._seen = seen
        return self._values

    def _write(self, values: Mapping[str, Any]) -> None:
        self._file.parent.mkdir(parents=True, exist_ok=True)
        fd, name = tempfile.mkstemp(prefix="users-", dir=self._file.parent)  # for its owner only
        with os.fdopen(fd, "w", encoding="utf-8") as file:
            json.dump(values, file, indent=2)
            file.flush()
            os.fsync(file.fileno())
        Path(name).replace(self._file)

    def __bool__(self) -> bool:
        values = self._read()
        return bool(values["users"] or values["tokens"])

    def all(self) -> list[tuple[str, User]]:
        """Return ("user" or "token", who) of all, by name."""
        values = self._read()
        return [
            (kind.removesuffix("s"), User(name, Role(entry["role"])))
            for kind in ("users", "tokens")
            for name, entry in sorted(values[kind].items())
        ]

    def find(self, name: str) -> User | None:
        """Return the user of this name as they are now, None where there is none any more."""
        entry = self._read()["users"].get(name)
        return None if entry is None else User(name, Role(entry["role"]))

    def add(self, name: str, role: Role, password: str) -> None:
        """Add a user, or give one another role and password.

        Raises:
            UsersError: the name or the password cannot be taken.
        """
        if len(password) < SHORTEST:
            raise UsersError(f"a password has at least {SHORTEST} characters")
        if len(password) > LONGEST:
            raise UsersError(f"a password has at most {LONGEST} characters")
        entry = {"role": role.value, "password": _hasher().hash(password)}
        self._put("users", name, entry)

    def add_token(self, name: str, role: Role) -> str:
        """Add a token for scripts and return it; it cannot be shown again.

        Raises:
            UsersError: the name cannot be taken.
        """
        token = secrets.token_urlsafe(32)
        self._put("tokens", name, {"role": role.value, "sha256": _digest(token)})
        return token

    def _put(self, kind: str, name: str, entry: Mapping[str, str]) -> None:
        if not _NAME.fullmatch(name):
            raise UsersError(
                f"{name!r} is no name: letters, digits and . _ @ - , at most 64, "
                "and a letter or a digit first"
            )
        values = self._read()
        self._write({**values, kind: {**values[kind], name: entry}})

    def remove(self, name: str) -> None:
        """Remove a user or a token.

        Raises:
            UsersError: there is none of this name.
        """
        values = self._read()
        if not any(name in values[kind] for kind in ("users", "tokens")):
            raise UsersError(f"there is no user and no token {name}")
        left = {
            kind: {each: entry for each, entry in values[kind].items() if each != name}
            for kind in ("users", "tokens")
        }
        self._write({**values, **left})

    def check(self, name: str, password: str) -> User | None:
        """Return the user with this password, None for a wrong name or a wrong password.

        Both take the same time, some 50 ms.
        """
        from argon2.exceptions import Argon2Error, InvalidHashError  # noqa: PLC0415  # an extra

        entry = self._read()["users"].get(name)
        hashed = _nobody() if entry is None else entry["password"]
        try:
            _hasher().verify(hashed, password[: LONGEST + 1])
        except (Argon2Error, InvalidHashError):
            return None
        return None if entry is None else User(name, Role(entry["role"]))

    def by_token(self, token: str) -> User | None:
        """Return who a token stands for, None for a wrong one."""
        digest = _digest(token)
        for name, entry in self._read()["tokens"].items():
            if secrets.compare_digest(entry["sha256"], digest):
                return User(name, Role(entry["role"]))
        return None


def users_file(folder: Path) -> Path:
    """Return the file of the users of a project."""
    return folder / FILE


def _parsed(file: Path) -> dict[str, dict[str, Any]]:
    try:
        values = json.loads(file.read_text("utf-8"))
        for kind, key in (("users", "password"), ("tokens", "sha256")):
            for name, entry in values[kind].items():
                Role(entry["role"])
                len(name) + len(entry[key].encode())
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as err:
        raise UsersError(f"{file}: is damaged ({type(err).__name__}: {err})") from None
    return {kind: values[kind] for kind in ("users", "tokens")}


def _digest(token: str) -> str:
    return hashlib.sha256(token.encode("utf-8", "replace")).hexdigest()


@cache
def _hasher() -> PasswordHasher:
    try:
        from argon2 import PasswordHasher  # noqa: PLC0415  # an extra
    except ImportError:
        raise UsersError(
            "users need the package argon2-cffi; python3 -m pip install 'plcsim[web]'"
        ) from None
    return PasswordHasher()


@cache
def _nobody() -> str:
    """Return a hash that a wrong name is compared with."""
    return _hasher().hash(secrets.token_urlsafe(32))
