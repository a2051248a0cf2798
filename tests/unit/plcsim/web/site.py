"""A controller in virtual time with what its pages need, and requests without a network."""

import asyncio
import json
import os
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from plcsim import Program
from plcsim.access import Role, User, Users
from plcsim.access.users import users_file
from plcsim.core.clock import VirtualClock
from plcsim.network import VirtualNetwork
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.shared_image import ImageReader, ImageWriter
from plcsim.shared_image.layout import make_file
from plcsim.shared_image.status_page import StatusPage
from plcsim.web.extension import WebExtension
from plcsim.web.service.app import make_app
from plcsim.web.service.door import Caller, Door
from plcsim.web.service.hub import Hub
from plcsim.web.settings import WebProject, WebSettings
from st_types import ARRAY, BOOL, INT, LINT, LREAL, REAL, STRING, TIME, UDINT, Struct, var
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    Member,
    ReferenceType,
    StructType,
)

MS = 1_000_000
MODE = EnumerationType("Mode", {"OFF": 0, "AUTO": 1, "MANUAL": 2})
T = TypeVar("T")


class Axis(Struct):
    speed = var(REAL)
    count = var(UDINT)


NODE = StructType(
    "Node",
    [
        Member("value", REAL),
        Member("next", ReferenceType(lambda: NODE, "POINTER TO Node", is_pointer=True)),
    ],
)


class Site(Program):
    running = var(BOOL, True)
    level = var(REAL, 1.5)
    exact = var(LREAL)
    count = var(UDINT)
    small = var(INT, -7)
    large = var(LINT)
    name = var(STRING(20), "<b>it's</b>")
    mode = var(MODE, 1)
    delay = var(TIME, 1500)
    axes = var(ARRAY(Axis, (1, 3)))
    many = var(ARRAY(INT, (0, 1999)))
    nodes = var(ArrayType(NODE, [(1, 2)]))
    head = var(ReferenceType(NODE, "POINTER TO Node", is_pointer=True))
    heads = var(ArrayType(ReferenceType(NODE, "POINTER TO Node", is_pointer=True), [(0, 1)]))
    limit = var(ReferenceType(REAL, "REFERENCE TO REAL"))

    def cyclic(self) -> None:
        self.count += 1


@dataclass
class FakeService:
    """What a service process has."""

    image: ImageReader
    given: dict[str, Any]
    wake_fd: int
    page: StatusPage = field(default_factory=StatusPage)
    table: str = "web"


class World:
    """A controller, its image and the hub of its pages."""

    def __init__(self, folder: Path, settings: WebSettings | None = None) -> None:
        settings = settings or WebSettings()
        clock = VirtualClock()
        network = VirtualNetwork(clock.now_ns).host("192.168.0.10")
        setup = Setup([TaskClassSetup(1, MS, [ProgramSetup("p", PythonCode(Site))])])
        self.plc = make_controller(setup, network=network, clock=clock)
        attached = WebExtension().attach(WebProject(settings, folder), self.plc)
        fd = make_file()
        wake_fd = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        self.writer = ImageWriter(
            fd,
            self.plc,
            project="virtual",
            services={"web": attached.for_service},
            streams={"web": attached.stream_size},
            wake_fds=[wake_fd],
        )
        self.service = FakeService(ImageReader(fd, "web"), attached.for_service, wake_fd)
        os.close(fd)
        self.plc.boot()
        self.plc.run(cycles=1)
        self.users = Users(users_file(folder))
        self.door = Door(settings, self.users)
        self.hub = Hub(self.service)  # type: ignore[arg-type]  # all that the hub asks of it
        self.app = make_app(self.hub, self.door)
        self.folder = folder

    def do(self, act: Callable[[], Awaitable[T]]) -> T:
        """Carry something out while the scan runs beside it."""

        async def both() -> T:
            self.hub.commander.start()
            doing = asyncio.ensure_future(act())
            while not doing.done():
                self.plc.run(cycles=1)
                self.hub.read()
                await asyncio.sleep(0)
            return doing.result()

        return asyncio.run(both())

    def value(self, path: str) -> object:
        return self.plc.tags.read(self.plc.tags.find(path))

    def audit(self) -> list[dict[str, Any]]:
        file = self.folder / ".plcsim" / "web-audit.jsonl"
        lines = file.read_text().splitlines() if file.exists() else []
        return [json.loads(line) for line in lines]


def caller(role: Role = Role.ENGINEER, name: str = "anna") -> Caller:
    return Caller(User(name, role), "127.0.0.1")


@dataclass
class Answer:
    """The answer to a request."""

    status: int
    headers: dict[str, str]
    body: bytes

    def json(self) -> Any:
        return json.loads(self.body)


async def request(
    world: World,
    method: str,
    path: str,
    values: object = None,
    *,
    body: bytes | None = None,
    headers: Mapping[str, str] | None = None,
) -> Answer:
    """Ask the application for something, as a browser on this machine does."""
    sent = {"host": "localhost:8080", **(headers or {})}
    if method == "POST":
        sent.setdefault("content-type", "application/json")
    parts = [body if body is not None else json.dumps(values or {}).encode()]
    scope = {
        "type": "http",
        "asgi": {"version": "3.0"},
        "http_version": "1.1",
        "method": method,
        "scheme": "http",
        "path": path,
        "raw_path": path.encode(),
        "query_string": b"",
        "root_path": "",
        "headers": [(k.lower().encode(), v.encode()) for k, v in sent.items()],
        "client": ("127.0.0.1", 50000),
        "server": ("127.0.0.1", 8080),
    }
    told: list[Any] = []

    async def receive() -> dict[str, Any]:
        if parts:
            return {"type": "http.request", "body": parts.pop(), "more_body": False}
        await asyncio.sleep(3600)
        raise AssertionError

    async def send(message: Any) -> None:
        told.append(message)

    await world.app(scope, receive, send)
    start, *rest = told
    found = {k.decode(): v.decode() for k, v in start["headers"]}
    return Answer(start["status"], found, b"".join(m.get("body", b"") for m in rest))


class Socket:
    """A WebSocket of a browser, to the application."""

    def __init__(self, world: World, headers: Mapping[str, str] | None = None) -> None:
        sent = {"host": "localhost:8080", "origin": "http://localhost:8080", **(headers or {})}
        self._scope = {
            "type": "websocket",
            "asgi": {"version": "3.0"},
            "http_version": "1.1",
            "scheme": "ws",
            "path": "/live",
            "raw_path": b"/live",
            "query_string": b"",
            "root_path": "",
            "headers": [(k.lower().encode(), v.encode()) for k, v in sent.items()],
            "client": ("127.0.0.1", 50000),
            "server": ("127.0.0.1", 8080),
            "subprotocols": [],
        }
        self._world = world
        self._in: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        self._out: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        self.code = 0
        self._number = 0
        self._pushed: list[dict[str, Any]] = []

    async def __aenter__(self) -> "Socket":
        await self._in.put({"type": "websocket.connect"})
        self._serving = asyncio.create_task(
            self._world.app(self._scope, self._in.get, self._out.put)  # type: ignore[arg-type]
        )
        first = await asyncio.wait_for(self._out.get(), 100)
        self.is_accepted = first["type"] == "websocket.accept"
        if not self.is_accepted:
            self.code = first.get("code", 1000)
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._in.put({"type": "websocket.disconnect", "code": 1001})
        await asyncio.wait_for(self._serving, 100)

    async def _next(self) -> dict[str, Any] | bytes | None:
        """Return the next message, None at the end."""
        message = await asyncio.wait_for(self._out.get(), 100)
        if message["type"] == "websocket.close":
            self.code = message["code"]
            return None
        if message.get("bytes"):
            return bytes(message["bytes"])
        found: dict[str, Any] = json.loads(message["text"])
        return found

    async def closed(self) -> int:
        """Wait until the application ends it; return the code."""
        while await self._next() is not None:
            pass
        return self.code

    async def pushed(self, kind: str) -> dict[str, Any]:
        """Wait for the next message of a kind that comes by itself."""
        for at, message in enumerate(self._pushed):
            if message["push"] == kind:
                return self._pushed.pop(at)
        while True:
            found = await self._next()
            assert found is not None, f"closed with {self.code}"
            if isinstance(found, dict) and found.get("push") == kind:
                return found

    async def data(self) -> bytes:
        """Wait for the next message of bytes."""
        while True:
            found = await self._next()
            assert found is not None, f"closed with {self.code}"
            if isinstance(found, bytes):
                return found

    async def tell(self, text: str) -> None:
        await self._in.put({"type": "websocket.receive", "text": text})

    async def ask(self, act: str, **values: object) -> dict[str, Any]:
        """Ask for an act and return the answer."""
        self._number += 1
        await self.tell(json.dumps({"id": self._number, "do": act, **values}))
        while True:
            found = await self._next()
            assert found is not None, f"closed with {self.code}"
            if isinstance(found, dict):
                if found.get("id") == self._number and "push" not in found:
                    return found
                self._pushed.append(found)
