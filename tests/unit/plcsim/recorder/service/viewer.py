"""A client of the live view: what Foxglove says and hears, over a plain WebSocket."""

import json
import struct
from contextlib import ExitStack
from importlib import import_module
from typing import Any

PLAY, PAUSE = 0, 1
PLAYING, PAUSED = 0, 1
"""Commands and states of the protocol."""


class Viewer:
    """A client."""

    def __init__(self, port: int) -> None:
        self._open = ExitStack()
        connection = import_module("websockets.sync.client").connect(
            f"ws://127.0.0.1:{port}",
            subprotocols=["foxglove.sdk.v1"],
            proxy=None,
            open_timeout=100,
        )
        self._socket = self._open.enter_context(connection)

    def told(self, operation: str) -> Any:
        """Return the next text message of a kind; others are passed over."""
        while True:
            data = self._socket.recv(timeout=100)
            if isinstance(data, str) and (found := json.loads(data))["op"] == operation:
                return found

    def data(self) -> tuple[int, int, bytes]:
        """Return subscription, time and bytes of the next message of a channel."""
        while True:
            data = self._socket.recv(timeout=100)
            if isinstance(data, bytes) and data[0] == 1:
                return *struct.unpack_from("<IQ", data, 1), data[13:]

    def press(self, command: int, speed: float) -> None:
        """Send a PlaybackControlRequest: no seek, an identifier."""
        self._socket.send(struct.pack("<BBfBQI2s", 3, command, speed, 0, 0, 2, b"id"))

    def playback(self) -> tuple[int, float]:
        """Return status and speed of the next PlaybackState."""
        while True:
            data = self._socket.recv(timeout=100)
            if isinstance(data, bytes) and data[0] == 5:
                status, _, speed = struct.unpack_from("<BQf", data, 1)
                return status, speed

    def say(self, operation: str, **values: object) -> None:
        self._socket.send(json.dumps({"op": operation, **values}))

    def close(self) -> None:
        self._open.close()
