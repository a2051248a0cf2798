"""The pages and the interface for scripts, as an ASGI application.

``GET /`` and what it names are files of the package; ``/live`` is the WebSocket of the pages;
``POST /api/NAME`` does one act for a script, ``POST /trace.bag`` gives a trace. Nothing is cached
without being asked for again, and nothing is loaded from anywhere else: the Content-Security-Policy
forbids it.
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import shutil
import tempfile
import time
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from starlette.applications import Starlette
from starlette.background import BackgroundTask
from starlette.requests import HTTPConnection
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route, WebSocketRoute

from plcsim.core.errors import PlcError
from plcsim.web.service.acts import perform, text_of, whole_of
from plcsim.web.service.door import COOKIE, IDLE_S, RefusedError
from plcsim.web.service.session import LOGGED_OUT, BrowserSession
from plcsim.web.service.trace_bag import write_bag

if TYPE_CHECKING:
    from collections.abc import MutableMapping

    from starlette.requests import Request
    from starlette.types import ASGIApp, Message, Receive, Scope, Send
    from starlette.websockets import WebSocket

    from plcsim.web.service.door import Caller, Door
    from plcsim.web.service.hub import Hub

FRONT: Final = Path(__file__).parent.parent / "front"
LARGEST_MESSAGE: Final = 256 * 1024
"""Bytes of a request, and of a message over the WebSocket."""

_TYPES: Final = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".svg": "image/svg+xml",
}

HEADERS: Final = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
        "connect-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-cache",
}


class _File(NamedTuple):
    data: bytes
    media_type: str
    tag: str


def _files() -> dict[str, _File]:
    """Return all files of the pages by the path under which they are served."""
    found = {}
    for file in sorted(FRONT.rglob("*")):
        if file.suffix in _TYPES:
            data = file.read_bytes()
            tag = f'"{hashlib.sha256(data).hexdigest()[:16]}"'
            found[file.relative_to(FRONT).as_posix()] = _File(data, _TYPES[file.suffix], tag)
    found[""] = found["index.html"]
    return found


def make_app(hub: Hub, door: Door) -> ASGIApp:
    """Return the application.

    Args:
        hub: what it shows.
        door: who may see it.
    """
    pages = _Pages(hub, door)
    routes = [
        WebSocketRoute("/live", pages.live),
        Route("/login", pages.login, methods=["POST"]),
        Route("/logout", pages.logout, methods=["POST"]),
        Route("/trace.bag", pages.bag, methods=["POST"]),
        Route("/api/{name}", pages.api, methods=["POST"]),
        Route("/{path:path}", pages.file, methods=["GET", "HEAD"]),
    ]
    return _Guard(Starlette(routes=routes, exception_handlers={PlcError: _told}), door)


async def _told(_request: Request, error: Exception) -> Response:
    status = error.status if isinstance(error, RefusedError) else HTTPStatus.BAD_REQUEST
    # a body that is too long is not read to its end
    headers = {"connection": "close"} if status == HTTPStatus.REQUEST_ENTITY_TOO_LARGE else None
    return JSONResponse({"error": str(error)}, status, headers)


class _Guard:
    """Adds the headers to every answer, and refuses names that are not ours."""

    def __init__(self, app: ASGIApp, door: Door) -> None:
        self._app = app
        self._door = door

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                extra = [(k.lower().encode(), v.encode()) for k, v in HEADERS.items()]
                message = {**message, "headers": [*message.get("headers", []), *extra]}
            await send(message)

        if scope["type"] == "http":
            try:
                self._door.check_host(HTTPConnection(scope).headers)
            except RefusedError as err:
                await JSONResponse({"error": str(err)}, err.status)(
                    scope, receive, send_with_headers
                )
                return
        await self._app(scope, receive, send_with_headers)


class _Pages:
    """The answers to each kind of request."""

    def __init__(self, hub: Hub, door: Door) -> None:
        self._hub = hub
        self._door = door
        self._files = _files()
        self._writing = asyncio.Lock()

    async def file(self, request: Request) -> Response:
        """Return a file of the pages."""
        file = self._files.get(request.path_params["path"])
        if file is None:
            return Response("there is no such page\n", HTTPStatus.NOT_FOUND)
        headers = {"ETag": file.tag}
        if request.headers.get("if-none-match") == file.tag:
            return Response(status_code=HTTPStatus.NOT_MODIFIED, headers=headers)
        return Response(file.data, headers=headers, media_type=file.media_type)

    async def live(self, socket: WebSocket) -> None:
        """Serve a browser until it goes."""
        peer = socket.client.host if socket.client else ""
        scheme = "https" if socket.url.scheme == "wss" else "http"
        try:
            self._door.check_host(socket.headers)
            has_token = "authorization" in socket.headers
            if not has_token:
                self._door.check_origin(socket.headers, scheme, needed=True)
            caller = self._door.caller(socket.headers, socket.cookies, peer)
        except RefusedError as err:
            if err.status != HTTPStatus.UNAUTHORIZED:
                await socket.close(1008)  # before it is accepted: 403
                return
            await socket.accept()  # a browser tells a page no status, but a code
            await socket.close(LOGGED_OUT, str(err))
            return
        await socket.accept()
        cookie = "" if has_token else socket.cookies.get(COOKIE, "")
        await BrowserSession(self._hub, self._door, socket, caller, cookie).run()

    def _caller(self, request: Request) -> Caller:
        """Return who asks.

        Raises:
            RefusedError: nobody that is known, or pages of another site do.
        """
        if "authorization" not in request.headers:
            self._door.check_origin(
                request.headers, request.url.scheme, needed=COOKIE in request.cookies
            )
        return self._door.caller(request.headers, request.cookies, _peer(request))

    async def api(self, request: Request) -> Response:
        """Do one act for a script."""
        caller = self._caller(request)
        arguments = await _body(request)
        return JSONResponse(
            await perform(self._hub, caller, request.path_params["name"], arguments)
        )

    async def bag(self, request: Request) -> Response:
        """Return a trace as a bag; one at a time is made."""
        self._caller(request)
        key = whole_of(await _body(request), "key", 0, 1 << 62)
        trace = self._hub.trace_of(key)
        epoch_ns = time.time_ns() - self._hub.page.elapsed_ns
        folder = tempfile.mkdtemp(prefix="plcsim-trace-")
        file = Path(folder) / "trace.bag"
        gone = BackgroundTask(shutil.rmtree, folder, ignore_errors=True)
        try:
            async with self._writing:
                await asyncio.to_thread(write_bag, file, trace.tags, trace.kept, epoch_ns)
        except BaseException:
            await gone()
            raise
        return FileResponse(file, media_type="application/octet-stream", background=gone)

    async def login(self, request: Request) -> Response:
        """Check a password and give a cookie."""
        self._door.check_origin(request.headers, request.url.scheme, needed=True)
        given = await _body(request)
        name, password = text_of(given, "name"), text_of(given, "password", 2000)
        cookie, user = await self._door.log_in(name, password, _peer(request))
        answer = JSONResponse({"name": user.name, "role": user.role.value})
        answer.set_cookie(
            COOKIE,
            cookie,
            max_age=int(IDLE_S),
            httponly=True,
            samesite="strict",
            secure=request.url.scheme == "https",
        )
        return answer

    async def logout(self, request: Request) -> Response:
        """Forget a cookie."""
        self._door.check_origin(request.headers, request.url.scheme, needed=True)
        self._door.log_out(request.cookies.get(COOKIE, ""))
        answer = JSONResponse({})
        answer.delete_cookie(COOKIE, httponly=True, samesite="strict")
        return answer


def _peer(request: Request) -> str:
    return request.client.host if request.client else ""


async def _body(request: Request) -> MutableMapping[str, Any]:
    """Return the object of JSON in a request.

    Raises:
        RefusedError: it is too long.
        PlcError: it is none.
    """
    if not request.headers.get("content-type", "").startswith("application/json"):
        raise RefusedError("the Content-Type must be application/json", 415)
    data = bytearray()
    async for part in request.stream():
        data += part
        if len(data) > LARGEST_MESSAGE:
            raise RefusedError(f"more than {LARGEST_MESSAGE} bytes", 413)
    try:
        values = json.loads(data or b"{}")
    except (ValueError, RecursionError):
        raise PlcError("this is no JSON") from None
    if not isinstance(values, dict):
        raise PlcError("this is no object of JSON")
    return values
