"""One browser: what it watches, what it asks for, and what it is told ten times a second.

Messages are JSON. In: ``{"id": 1, "do": "write", "tag": ..., "value": ...}``, an act of
`plcsim.web.service.acts`, or ``watch`` and ``follow`` of this very session. Out: ``{"id": 1, "ok":
...}`` or ``{"id": 1, "error": text}``, and what changes by itself under the key ``push``.

A browser that reads nothing costs nothing but its connection: the next values are made when the
last ones have gone, and what it asks for is not looked at before its answers have gone.
"""

from __future__ import annotations

import asyncio
import json
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final

from starlette.websockets import WebSocketDisconnect, WebSocketState

from plcsim.core.errors import PlcError, TagError
from plcsim.web.service.acts import perform, texts_of, whole_of
from plcsim.web.service.door import Caller
from plcsim.web.service.traces import MOST_TAGS

if TYPE_CHECKING:
    from starlette.websockets import WebSocket

    from plcsim.core.tag import Tag
    from plcsim.web.service.door import Door
    from plcsim.web.service.hub import Hub
    from plcsim.web.service.traces import LiveTrace
    from plcsim.web.service.values import Watched

PERIOD_S: Final = 0.1
STATUS_S: Final = 0.5
SYSTEM_S: Final = 2.0
PATIENCE_S: Final = 30.0
"""A browser that has not taken what was sent for so long is let go."""

MOST_WATCHED: Final = 2000
MOST_TRACES: Final = 4
TOPICS: Final = frozenset({"logbook", "classes", "system", "network"})
LOGGED_OUT: Final = 4401
TOO_SLOW: Final = 4408


class BrowserSession:
    """Serves one WebSocket.

    Args:
        hub: shared by all.
        door: tells whether the caller may still be here.
        socket: accepted.
        caller: who it is.
        cookie: by which the caller is logged in, "" for a token or where there are no users.
    """

    def __init__(
        self, hub: Hub, door: Door, socket: WebSocket, caller: Caller, cookie: str
    ) -> None:
        self._hub = hub
        self._door = door
        self._socket = socket
        self._caller = caller
        self._cookie = cookie
        self._watched: list[Watched] = []
        self._sent: list[int] = []
        self._topics: set[str] = set()
        self._due: dict[str, float] = {}
        self._logged = 0
        self._forces = ""
        self._traces: list[LiveTrace] = []
        self._sending = asyncio.Lock()

    async def run(self) -> None:
        """Serve until one side ends it."""
        reading = asyncio.create_task(self._read())
        telling = asyncio.create_task(self._tell())
        try:
            done, _ = await asyncio.wait((reading, telling), return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                with suppress(WebSocketDisconnect):
                    task.result()
        finally:
            for task in (reading, telling):
                task.cancel()
            await asyncio.gather(reading, telling, return_exceptions=True)
            self._hub.values.leave(self._watched)
            self._look_at_classes(set())
            for trace in self._traces:
                self._hub.end_trace(trace)

    async def _send(self, message: object) -> None:
        if not isinstance(message, bytes):
            message = json.dumps(message, separators=(",", ":"))
        async with self._sending:
            try:
                async with asyncio.timeout(PATIENCE_S):  # wait_for may lose a cancellation
                    if isinstance(message, bytes):
                        await self._socket.send_bytes(message)
                    else:
                        await self._socket.send_text(message)
            except TimeoutError:
                await self._close(TOO_SLOW, "what was sent is not read")

    async def _close(self, code: int, reason: str) -> None:
        if self._socket.application_state is WebSocketState.CONNECTED:
            await self._socket.close(code, reason)
        raise WebSocketDisconnect(code, reason)

    async def _read(self) -> None:
        await self._send({"push": "hello", "user": self._who(), "facts": self._hub.facts()})
        while True:
            message = await self._socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            await self._answer(message.get("text") or "")

    def _who(self) -> dict[str, Any]:
        user = self._caller.user
        return {
            "name": user.name,
            "role": user.role.value,
            "has_users": self._door.has_users,
        }

    async def _answer(self, text: str) -> None:
        number: object = None
        try:
            message = _parsed(text)
            number = message.get("id")
            await self._check_caller()
            answer = {"id": number, "ok": await self._do(message)}
        except PlcError as err:
            answer = {"id": number, "error": str(err)}
        await self._send(answer)

    async def _check_caller(self) -> None:
        user = self._door.present(self._caller, self._cookie)
        if user is None:
            await self._close(LOGGED_OUT, "log in again")
        elif user != self._caller.user:
            self._caller = Caller(user, self._caller.peer)

    async def _do(self, message: dict[str, Any]) -> object:
        match message.get("do"):
            case "watch":
                return await self._watch(texts_of(message, "tags", MOST_WATCHED))
            case "follow":
                return self._follow(texts_of(message, "topics", len(TOPICS)))
            case "trace":
                return await self._trace(message)
            case "untrace":
                return self._untrace(message.get("number"))
            case str(name):
                return await perform(self._hub, self._caller, name, message)
        raise PlcError("'do' must be the name of an act")

    async def _watch(self, paths: list[str]) -> object:
        """Watch these tags from now on, instead of those before; pointers are followed now."""
        known: dict[str, Tag] = {}
        tags = [await self._found(path, known) for path in paths]
        before = self._watched
        self._watched = self._hub.values.watch(tags)
        self._sent = [-1] * len(tags)
        self._hub.values.leave(before)
        return {"count": len(tags)}

    async def _found(self, path: str, known: dict[str, Tag]) -> Tag:
        """Return a variable; where a pointer leads nowhere any more, the pointer itself."""
        try:
            return await self._hub.follower.find(path, known)
        except TagError:
            if "^" not in path:
                raise
            return self._hub.image.directory.find(path.partition("^")[0])

    def _follow(self, topics: list[str]) -> object:
        unknown = set(topics) - TOPICS
        if unknown:
            raise PlcError(f"there is no topic {', '.join(sorted(unknown))[:80]}")
        self._look_at_classes(set(topics))
        self._due.clear()
        self._logged = 0
        return {}

    def _look_at_classes(self, topics: set[str]) -> None:
        """Have the scan tell of its cycles only while a browser shows them."""
        more = ("classes" in topics) - ("classes" in self._topics)
        self._topics = topics
        if more:
            self._hub.follow(more)

    async def _trace(self, message: dict[str, Any]) -> object:
        """LiveTrace these tags in every cycle from now on."""
        if len(self._traces) >= MOST_TRACES:
            raise PlcError(f"a browser has {MOST_TRACES} traces at most")
        find = self._hub.image.directory.find
        tags = [find(path) for path in texts_of(message, "tags", MOST_TAGS)]
        number = whole_of(message, "class", 0, 8) or self._hub.class_of(tags)
        trace = await self._hub.start_trace(tags, number)
        self._traces.append(trace)
        return {"number": trace.number, "key": trace.key, "class": number}

    def _untrace(self, number: object) -> object:
        for trace in [each for each in self._traces if each.number == number]:
            self._traces.remove(trace)
            self._hub.end_trace(trace)
        return {}

    async def _tell(self) -> None:
        while True:
            started_s = time.monotonic()
            await self._check_caller()
            for message in self._news(started_s):
                await self._send(message)
            for trace in list(self._traces):
                while (data := trace.message()) is not None:
                    await self._send(data)
            await asyncio.sleep(max(0.01, started_s + PERIOD_S - time.monotonic()))

    def _is_due(self, what: str, now_s: float, period_s: float) -> bool:
        if now_s < self._due.get(what, 0.0):
            return False
        self._due[what] = now_s + period_s
        return True

    def _news(self, now_s: float) -> list[dict[str, Any]]:
        """Return what this browser does not know yet."""
        hub = self._hub
        news: list[dict[str, Any]] = []
        if self._watched:
            hub.refresh()
            values = self._changed_values()
            if values:
                news.append({"push": "values", "values": values})
        if self._is_due("status", now_s, STATUS_S):
            news.append({"push": "status", **hub.status()})
            forces = hub.forces()
            if json.dumps(forces) != self._forces:
                self._forces = json.dumps(forces)
                news.append({"push": "forces", "forces": forces})
        if "system" in self._topics and self._is_due("system", now_s, SYSTEM_S):
            news.append({"push": "system", **hub.system()})
        if "classes" in self._topics and self._is_due("classes", now_s, STATUS_S):
            news.append({"push": "classes", **hub.task_classes()})
        if "network" in self._topics and self._is_due("network", now_s, SYSTEM_S):
            news.append({"push": "network", **hub.network()})
        if "logbook" in self._topics and self._logged < hub.entries_seen:
            fresh = [entry for number, entry in hub.entries if number > self._logged]
            self._logged = hub.entries_seen
            news.append({"push": "logbook", "entries": fresh, "lost": hub.lost})
        return news

    def _changed_values(self) -> list[list[object]]:
        changed: list[list[object]] = []
        for index, one in enumerate(self._watched):
            if one.version != self._sent[index]:
                self._sent[index] = one.version
                changed.append([index, one.value])
        return changed


def _parsed(text: str) -> dict[str, Any]:
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        raise PlcError("this is no message of JSON") from None
    if not isinstance(message, dict):
        raise PlcError("a message is an object of JSON")
    return message
