"""The door: who somebody is, and what may come in at all.

A page of somebody else, opened in the same browser, must not reach the controller: a request that
writes, and every WebSocket, has to come from our own pages (its Origin is our own), and nobody may
ask for us by a name that is not ours (DNS rebinding). The cookie is SameSite=Strict and HttpOnly.
"""

from __future__ import annotations

import asyncio
import ipaddress
import os
import secrets
import time
from collections import OrderedDict
from typing import TYPE_CHECKING, Final, NamedTuple
from urllib.parse import urlsplit

from plcsim.access import Role, User
from plcsim.core.errors import PlcError
from plcsim.settings import is_loopback

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.access import Users
    from plcsim.web.settings import WebSettings

COOKIE: Final = "plcsim"
IDLE_S: Final = 12 * 3600.0
"""Who was not seen for so long has to log in again."""

MOST_SESSIONS: Final = 1000
FREE_TRIES: Final = 5
"""Wrong passwords of one address before it has to wait."""

LONGEST_WAIT_S: Final = 60.0
MOST_ADDRESSES: Final = 10_000
HASHES_AT_ONCE: Final = 2
"""Each takes 64 MiB and some 50 ms."""

LOCAL: Final = User("local", Role.ENGINEER)
"""Whoever is on this machine, while there are no users."""


class RefusedError(PlcError):
    """Somebody may not do what they ask for.

    Args:
        text: why.
        status: of HTTP.
    """

    def __init__(self, text: str, status: int = 403) -> None:
        super().__init__(text)
        self.status = status


class Caller(NamedTuple):
    """Who asks, and from where."""

    user: User
    peer: str


class _Login:
    def __init__(self, name: str) -> None:
        self.name = name
        self.seen_s = time.monotonic()


class Door:
    """Decides who somebody is.

    Args:
        settings: table [web].
        users: of the project.
    """

    def __init__(self, settings: WebSettings, users: Users) -> None:
        self._settings = settings
        self._users = users
        self._logins: OrderedDict[str, _Login] = OrderedDict()
        self._wrong: OrderedDict[str, tuple[int, float]] = OrderedDict()
        self._hashing = asyncio.Semaphore(HASHES_AT_ONCE)
        own = {"localhost", os.uname().nodename.lower()}
        self._names = own | {name.lower() for name in settings.names}

    @property
    def has_users(self) -> bool:
        """Nobody is let in without a password or a token."""
        return bool(self._users) or not is_loopback(self._settings.host)

    def check_host(self, headers: Mapping[str, str]) -> None:
        """Check the name that somebody asks for us by.

        Raises:
            RefusedError: it is not one of ours.
        """
        name = urlsplit(f"//{headers.get('host', '')}").hostname or ""
        if name in self._names:
            return
        try:
            ipaddress.ip_address(name)  # no name, so no name server can have turned it to us
        except ValueError:
            raise RefusedError(
                f"{name[:80]!r} is not a name of this host; see web.names", 421
            ) from None

    def check_origin(self, headers: Mapping[str, str], scheme: str, *, needed: bool) -> None:
        """Check that a request comes from our own pages.

        Args:
            headers: of the request.
            scheme: "http" or "https", of the connection.
            needed: a browser would tell where it comes from.

        Raises:
            RefusedError: it comes from elsewhere.
        """
        origin = headers.get("origin")
        if origin is None:
            if needed or headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
                raise RefusedError("this request does not come from the pages of this controller")
        elif origin != f"{scheme}://{headers.get('host', '')}":
            raise RefusedError("this request comes from pages of another site")

    def caller(self, headers: Mapping[str, str], cookies: Mapping[str, str], peer: str) -> Caller:
        """Return who asks.

        Raises:
            RefusedError: nobody that is known.
        """
        kind, _, token = headers.get("authorization", "").partition(" ")
        if kind:
            found = self._users.by_token(token.strip()) if kind.lower() == "bearer" else None
            if found is None:
                raise RefusedError("the token is wrong", 401)
            return Caller(found, peer)
        if not self.has_users:
            return Caller(LOCAL, peer)
        user = self._logged_in(cookies.get(COOKIE, ""))
        if user is None:
            raise RefusedError("log in first", 401)
        return Caller(user, peer)

    def present(self, caller: Caller, cookie: str) -> User | None:
        """Return what a caller may do now; None where they may nothing any more."""
        if caller.user == LOCAL:
            return None if self.has_users else LOCAL
        if cookie:
            return self._logged_in(cookie)
        return next((user for _, user in self._users.all() if user.name == caller.user.name), None)

    def _logged_in(self, cookie: str) -> User | None:
        login = self._logins.get(cookie)
        if login is None:
            return None
        now_s = time.monotonic()
        user = self._users.find(login.name)
        if user is None or now_s - login.seen_s > IDLE_S:
            del self._logins[cookie]
            return None
        login.seen_s = now_s
        return user

    async def log_in(self, name: str, password: str, peer: str) -> tuple[str, User]:
        """Return a new cookie and who it stands for.

        Raises:
            RefusedError: name or password is wrong, or there were too many wrong ones from there.
        """
        if not self._users:
            raise RefusedError("there are no users yet; plcsim users add NAME --role engineer", 401)
        self._check_tries(peer)
        async with self._hashing:
            user = await asyncio.to_thread(self._users.check, name, password)
        if user is None:
            self._note_wrong(peer)
            raise RefusedError("name or password is wrong", 401)
        self._wrong.pop(peer, None)
        cookie = secrets.token_urlsafe(32)
        self._logins[cookie] = _Login(name)
        if len(self._logins) > MOST_SESSIONS:
            self._logins.popitem(last=False)
        return cookie, user

    def log_out(self, cookie: str) -> None:
        """End a login."""
        self._logins.pop(cookie, None)

    def _check_tries(self, peer: str) -> None:
        count, since_s = self._wrong.get(peer, (0, 0.0))
        wait_s = min(LONGEST_WAIT_S, 2.0 ** (count - FREE_TRIES)) if count >= FREE_TRIES else 0.0
        left_s = since_s + wait_s - time.monotonic()
        if left_s > 0:
            raise RefusedError(f"too many wrong passwords; wait {left_s:.0f} s", 429)

    def _note_wrong(self, peer: str) -> None:
        count, _ = self._wrong.pop(peer, (0, 0.0))
        self._wrong[peer] = count + 1, time.monotonic()
        if len(self._wrong) > MOST_ADDRESSES:
            self._wrong.popitem(last=False)
