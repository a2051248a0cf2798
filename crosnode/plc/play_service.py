"""Plays a bag on the real clock beside the scan; `plcsim.process.service_main` calls `serve`."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final

from crosnode.graph.arguments import node_settings
from crosnode.messages import MessageTypes
from crosnode.node import CrosNode
from crosnode.node.options import NodeOptions
from crosnode.plc.playback import Playback, PlaybackState
from crosnode.transport.budget import UNPACED
from crosnode.xmlrpc.api_caller import CallState
from plcsim.core.context import Context
from plcsim.core.control import Action
from plcsim.core.memory import Memory
from plcsim.network import OsNetwork
from plcsim.recorder.bag.reading import open_bag
from plcsim.shared_image.command import Control

if TYPE_CHECKING:
    from crosnode.xmlrpc.api_caller import ApiCall
    from plcsim.core.logbook import Severity
    from plcsim.process.service_main import Service

REST_S: Final = 0.001
"""Between two steps; a message is late by as much at most."""

ASK_NS: Final = 200_000_000
"""Between two questions to the master who subscribes."""

NODE: Final = "player"
AFTERWARDS_S: Final = 0.5
"""The last messages are still on their way through TCP and the program."""


def serve(service: Service) -> None:
    """Play until the end, then stop the controller."""
    given = service.given
    context = Context(Memory(), OsNetwork())
    context.release_ns = time.monotonic_ns()
    who = node_settings(NODE, (), {"ROS_MASTER_URI": given["master"]}, host=given["host"])
    node = CrosNode(context, who, MessageTypes(), NodeOptions(step=UNPACED))
    with open_bag(Path(given["bag"])) as bag:
        playback = Playback(
            bag, node, _Subscribed(node), _tell, given["topics"], with_clock=given["clock"]
        )
        service.serving(f"plays {bag.path.name}")
        while not service.is_stopping and playback.state is not PlaybackState.OVER:
            context.release_ns = time.monotonic_ns()
            playback.step(context.release_ns)
            time.sleep(REST_S)
    if not service.is_stopping:
        time.sleep(AFTERWARDS_S)
        service.image.send(Control(Action.STOP, by="play"))
        while not service.is_stopping:
            time.sleep(REST_S)
    node.destroy()


class _Subscribed:
    """The topics that nodes subscribe to, as the master said last."""

    def __init__(self, node: CrosNode) -> None:
        self._node = node
        self._call: ApiCall | None = None
        self._topics: set[str] = set()
        self._next_ns = 0

    def __call__(self) -> set[str]:
        """Return them, and ask again now and then."""
        now_ns = time.monotonic_ns()
        if self._call is not None and self._call.state is CallState.DONE:
            self._topics = _subscribed(self._call.value, self._node.name)
            self._call = None
        elif self._call is not None and self._call.state is CallState.FAILED:
            self._call = None
        if self._call is None and now_ns >= self._next_ns:
            self._next_ns = now_ns + ASK_NS
            self._call = self._node.call_master("getSystemState")
        return self._topics


def _subscribed(state: object, own: str) -> set[str]:
    """Return the topics of an answer to getSystemState that others subscribe to."""
    if not isinstance(state, list) or len(state) != 3 or not isinstance(state[1], list):
        return set()
    found = set()
    for entry in state[1]:
        if isinstance(entry, list) and len(entry) == 2 and isinstance(entry[1], list):
            topic, nodes = entry
            if isinstance(topic, str) and any(node != own for node in nodes):
                found.add(topic)
    return found


def _tell(_severity: Severity, text: str) -> None:
    sys.stderr.write(f"play: {text}\n")
