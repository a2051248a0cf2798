"""The live view: tags for Foxglove, Lichtblick and PlotJuggler, while they are recorded.

A WebSocket server of foxglove-sdk (subprotocol ``foxglove.sdk.v1``) runs in the recorder's
process. Each tag is a channel, CDR with a schema of ros2msg, which all three understand, and a
parameter that can be set. The parameter `PAUSED` stops the task classes and lets them go on. On the
virtual clock the viewer's own buttons do so too, and set how fast it runs.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.control import REAL_TIME, Action
from plcsim.core.tag import leaves
from plcsim.recorder.bag.types import messages_of, typestore
from plcsim.recorder.bag.writing import tag_messages
from plcsim.recorder.errors import RecordingError
from plcsim.shared_image import CommandRefused
from plcsim.shared_image.command import Control, StoreCommand, Write
from st_types.errors import ValueRangeError
from st_types.types.values import decode, encode

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.tag import Tag
    from plcsim.process.service_main import Service
    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.bag.types import TagMessages
    from plcsim.shared_image.command import Command

HOST: Final = "127.0.0.1"
PAUSED: Final = "plcsim.paused"
PERIOD_NS: Final = 20_000_000
"""Tags are shown at most so often: people look at them."""

LONGEST_NS: Final = 24 * 3600 * 1_000_000_000
"""A viewer wants to know where a virtual run ends, and nobody does: a day after its start."""

SERVICE: Final = "live"
"""Who asks for a pause, in the logbook."""


def open_live(service: Service, head: Head) -> Live | None:
    """Return the live view, None where none is wanted; that it cannot be had ends nothing else."""
    port = service.given["live"]
    if not port:
        return None
    try:
        return Live(head, port, tag_messages(head), service.image.send)
    except RecordingError as err:
        sys.stderr.write(f"plcsim: {err}\n")
        return None


class Live:
    """A server of the live view.

    Args:
        head: what is recorded; all its tags are shown, or those chosen to be messages.
        port: where it listens, 0 for any.
        send: puts a command into the service's ring.

    Attributes:
        port: where it listens.

    Raises:
        RecordingError: foxglove-sdk is not installed, or the port is in use.
    """

    def __init__(
        self, head: Head, port: int, tags: list[TagMessages], send: Callable[[Command], int]
    ) -> None:
        try:
            foxglove: Any = import_module("foxglove")  # an extra
            websocket: Any = import_module("foxglove.websocket")
        except ImportError:
            raise RecordingError(
                "record.live needs the package foxglove-sdk: pip install 'plcsim[foxglove]'"
            ) from None
        self._head = head
        self._send = send
        self._websocket = websocket
        self._parameter = websocket.Parameter
        self._speed = 1.0
        self._now_ns = start_ns = head.epoch_ns + head.origin_ns
        self._leaves, self._tags = _shown(head, tags)
        self._variables = b""
        self._next_ns = 0
        self._last: dict[str, bytes] = {}
        self._followed: set[str] = set()
        self._is_paused = False
        self._context = context = foxglove.Context()  # its channels close with it
        schemas: dict[str, Any] = {}
        self._channels = {}
        for tag in self._tags:
            if tag.type_name not in schemas:
                schemas[tag.type_name] = _schema(foxglove, tag.type_name)
            self._channels[tag.topic] = foxglove.Channel(
                tag.topic, schema=schemas[tag.type_name], message_encoding="cdr", context=context
            )
        try:
            self._server = foxglove.start_server(
                name=f"plcsim: {head.project}",
                host=HOST,
                port=port,
                capabilities=[websocket.Capability.Parameters, websocket.Capability.Time],
                playback_time_range=(
                    (start_ns, start_ns + LONGEST_NS) if head.is_virtual else None
                ),
                server_listener=_Listener(self),
                context=context,
            )
        except (OSError, RuntimeError) as err:
            raise RecordingError(f"record.live: port {port} cannot be opened: {err}") from None
        self.port: int = self._server.port

    def show(self, time_ns: int, variables: bytes) -> None:
        """Send what has changed, where it is time.

        Args:
            time_ns: of the cycle, on the controller's clock.
            variables: of that cycle.
        """
        if not variables or time_ns < self._next_ns:
            return
        self._next_ns = time_ns + PERIOD_NS
        self._variables = variables
        epoch_ns = self._now_ns = self._head.epoch_ns + time_ns
        self._server.broadcast_time(epoch_ns)
        if self._head.is_virtual:
            self._server.broadcast_playback_state(self._playback())
        store, changed = typestore(ros2=True), []
        for tag in self._tags:
            data = variables[tag.start : tag.start + tag.size]
            if self._last.get(tag.topic) != data:
                self._last[tag.topic] = data
                changed.append(tag.topic)
                message = store.ros1_to_cdr(tag.message(data), tag.type_name)
                self._channels[tag.topic].log(bytes(message), log_time=epoch_ns)
        if followed := [path for path in self._followed if self._topic(path) in changed]:
            self._server.publish_parameter_values(self.parameters(followed))

    def _topic(self, path: str) -> str:
        place = self._leaves.get(path)
        return "" if place is None else place[2]

    def close(self) -> None:
        """End the server."""
        self._server.stop()

    # What clients ask for, on a thread of the server

    def again(self) -> None:
        """Send all values once more: somebody has come."""
        self._last.clear()

    def follow(self, names: list[str], *, on: bool) -> None:
        """Tell of changes of parameters, or no more."""
        if on:
            self._followed.update(names)
        else:
            self._followed.difference_update(names)

    def parameters(self, names: list[str]) -> list[Any]:
        """Return parameters by their names, all where none are given."""
        return [
            self._parameter(name, value=value)
            for name in names or [PAUSED, *self._leaves]
            if (value := self._value(name)) is not None
        ]

    def _value(self, name: str) -> bool | int | float | str | None:
        if name == PAUSED:
            return self._is_paused
        if name not in self._leaves or not self._variables:
            return None
        tag, start, _ = self._leaves[name]
        value = decode(tag.data_type, self._variables[start : start + tag.data_type.size])
        return value if isinstance(value, bool | int | float | str) else None

    def set(self, parameters: list[Any]) -> list[Any]:
        """Store values; return the parameters as they are, or will be in the next cycle."""
        found = []
        for each in parameters:
            name, value = each.name, each.get_value()
            try:
                self._set(name, value)
            except (KeyError, ValueRangeError, CommandRefused):
                found += self.parameters([name])
            else:
                found.append(self._parameter(name, value=value))
        return found

    def play(self, request: Any) -> Any:
        """Pause or go on, at a speed, as a viewer's buttons say; return what came of it."""
        if request.playback_speed > 0 and request.playback_speed != self._speed:
            self._speed = request.playback_speed
            self._send(Control(Action.SPEED, int(self._speed * REAL_TIME), SERVICE))
        self._pause(request.playback_command == self._websocket.PlaybackCommand.Pause)
        return self._playback(request.request_id)

    def _playback(self, request: str = "") -> Any:
        """Return how the virtual clock runs; it cannot be sent elsewhere."""
        status = self._websocket.PlaybackStatus
        is_paused = status.Paused if self._is_paused else status.Playing
        return self._websocket.PlaybackState(
            is_paused, self._now_ns, self._speed, did_seek=False, request_id=request
        )

    def _pause(self, is_paused: bool) -> None:  # a state
        if is_paused != self._is_paused:
            self._is_paused = is_paused
            self._send(Control(Action.PAUSE if is_paused else Action.CONTINUE, by=SERVICE))

    def _set(self, name: str, value: object) -> None:
        if name == PAUSED:
            self._pause(bool(value))
            return
        tag = self._leaves[name][0]
        if isinstance(value, float) and value.is_integer() and not _is_real(tag):
            value = int(value)
        self._send(Write([StoreCommand(tag.address, encode(tag.data_type, value))]))


class _Listener:
    """Hands on what clients ask for; foxglove-sdk calls every method by its name."""

    def __init__(self, live: Live) -> None:
        self._live = live

    def on_subscribe(self, _client: object, _channel: object) -> None:
        self._live.again()

    def on_get_parameters(self, _client: object, names: list[str], _request: object) -> list[Any]:
        return self._live.parameters(names)

    def on_set_parameters(
        self, _client: object, parameters: list[Any], _request: object
    ) -> list[Any]:
        return self._live.set(parameters)

    def on_playback_control_request(self, request: object) -> Any:
        return self._live.play(request)

    def on_parameters_subscribe(self, names: list[str]) -> None:
        self._live.follow(names, on=True)

    def on_parameters_unsubscribe(self, names: list[str]) -> None:
        self._live.follow(names, on=False)


def _shown(
    head: Head, chosen: list[TagMessages]
) -> tuple[dict[str, tuple[Tag, int, str]], list[TagMessages]]:
    """Return each leaf with its place and topic, and those that are channels."""
    found: dict[str, tuple[Tag, int, str]] = {}
    made: list[TagMessages] = []
    wanted = {each.topic for each in chosen}
    for area, start in head.starts().items():
        for leaf in leaves(area):
            (message,) = messages_of(leaf, start + leaf.address - area.address)
            if not wanted or message.topic in wanted:
                found[leaf.path] = (leaf, message.start, message.topic)
                made.append(message)
    return found, made


def _schema(foxglove: Any, type_name: str) -> Any:
    text, _ = typestore(ros2=True).generate_msgdef(type_name, ros_version=2)
    return foxglove.Schema(name=type_name, encoding="ros2msg", data=text.encode())


def _is_real(tag: Tag) -> bool:
    return isinstance(decode(tag.data_type, bytes(tag.data_type.size)), float)
