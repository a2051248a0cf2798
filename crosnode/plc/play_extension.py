"""The extension of the table [ros_play]: plays a bag to the programs (docs/record.md).

On the virtual clock the player and, where the project has none, a master are hosts of the virtual
network, stepped after every cycle. On the real clock a process beside the scan plays.
"""

from __future__ import annotations

import os
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any, NamedTuple

from crosnode.graph.arguments import node_settings
from crosnode.master.server import MasterOptions, MasterServer
from crosnode.node import CrosNode, NodeOptions
from crosnode.plc.playback import Playback, PlaybackState
from crosnode.plc.project import MASTER_IP, SharedTypes, surroundings
from plcsim.core.context import Context
from plcsim.core.control import Ending, Step
from plcsim.core.memory import Memory
from plcsim.network import network_of
from plcsim.project.extension import Attachment, Extension
from plcsim.recorder.bag.reading import open_bag
from plcsim.settings import settings

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from plcsim.core.controller import Controller
    from plcsim.core.task import TaskClass
    from plcsim.settings.table import Table

PLAYER_IP = "192.168.0.102"
NODE = "player"
AFTERWARDS = 3
"""Cycles that the programs have after the last message."""

USE_SIM_TIME = "/use_sim_time"


@settings
class PlaySettings:
    """What [ros_play] says.

    Attributes:
        bag: the file, in the project's folder.
        topics: that are played; none for all that programs subscribe to.
        clock: publish /clock, and on the virtual clock let ROS time be that of the bag.
    """

    bag: str
    topics: tuple[str, ...] = ()
    clock: bool = False


class PlayProject(NamedTuple):
    """The settings, the bag, and whether the scan plays it itself."""

    settings: PlaySettings
    bag: Path
    is_in_process: bool = False


class PlayExtension(Extension):
    """A bag for the programs."""

    def read(self, table: Table) -> PlayProject:
        """Return the settings."""
        made = table.read(PlaySettings)
        return PlayProject(made, table.folder.resolve() / made.bag)

    def in_process(self, settings: PlayProject, ip: str) -> PlayProject:
        """Return the settings for the virtual clock."""
        return settings._replace(is_in_process=bool(ip))

    def service(self, settings: PlayProject) -> str:
        """Return the module that plays on the real clock."""
        return "" if settings.is_in_process else "crosnode.plc.play_service"

    def attach(self, settings: PlayProject, controller: Controller) -> Attachment:
        """Play from the first cycle on."""
        if settings.is_in_process:
            _InScan(settings, controller)
            return Attachment()
        found = surroundings(controller.context)  # extensions attach in the order of their names
        return Attachment(
            {
                "bag": str(settings.bag),
                "topics": list(settings.settings.topics),
                "clock": settings.settings.clock,
                "master": found.settings.master_uri if found else os.environ.get("ROS_MASTER_URI"),
                "host": found.settings.host if found else "127.0.0.1",
            }
        )


class _InScan:
    """The hosts beside a controller on the virtual clock, made in its first cycle."""

    def __init__(self, given: PlayProject, controller: Controller) -> None:
        self._given = given
        self._controller = controller
        self._files = ExitStack()
        self._bag = self._files.enter_context(open_bag(given.bag))
        self._steps: list[tuple[Context, Callable[[], None]]] = []
        self._playback: Playback | None = None
        self._last_ns = -1
        self._left = AFTERWARDS
        controller.image.inputs.insert(0, self._latch)
        controller.image.watchers.append(self._publish)
        controller.follow_steps(self._stepped)

    def _latch(self, _task_class: TaskClass) -> None:
        if self._playback is None:
            self._make()

    def _make(self) -> None:
        """Make the other hosts."""
        context = self._controller.context
        found = surroundings(context)
        assert found is not None  # plcsim replay gives a project without [ros] an empty one
        parameters = {USE_SIM_TIME: True} if self._given.settings.clock else {}
        if found.master is None:
            here = self._host(MASTER_IP)
            options = MasterOptions(host=MASTER_IP, parameters=parameters)
            self._steps.append((here, MasterServer(here, options).step))
        else:
            for name, value in parameters.items():
                context.library(found.master).master.set_param(f"/{NODE}", name, value)
        here = self._host(PLAYER_IP)
        environment = {"ROS_MASTER_URI": found.settings.master_uri}
        who = node_settings(NODE, (), environment, host=PLAYER_IP)
        options_of_node = NodeOptions(epoch=found.epoch)
        node = CrosNode(here, who, context.library(SharedTypes), options_of_node)
        self._playback = Playback(
            self._bag,
            node,
            lambda: {topic for _, topic in context.traffic.inlets},
            lambda severity, text: self._controller.log(severity, "play", text),
            self._given.settings.topics,
            with_clock=self._given.settings.clock,
            traffic=context.traffic,
        )
        self._steps.append((here, self._play))
        context.give_settings(found._replace(beside=self._step))

    def _host(self, ip: str) -> Context:
        network: Any = network_of(self._controller.context)
        network = getattr(network, "recorded", network)
        made = Context(Memory(), network.net.host(ip))
        made.release_ns = self._controller.context.release_ns
        return made

    def _publish(self, _task_class: TaskClass) -> None:
        now_ns = self._controller.context.release_ns
        if now_ns <= self._last_ns:  # task classes may be released together
            return
        self._last_ns = now_ns
        self._step()
        if self._playback is not None and self._playback.state is PlaybackState.OVER:
            self._left -= 1
            if not self._left:
                self._controller.end_run(Ending.STOP)

    def _step(self) -> None:
        now_ns = self._controller.context.release_ns
        for context, step in self._steps:
            context.release_ns = now_ns
            step()

    def _play(self) -> None:
        assert self._playback is not None
        self._playback.step(self._controller.context.release_ns)

    def _stepped(self, step: Step, _until_ns: int, _cycles: int) -> None:
        if step is Step.CLOSE:
            self._files.close()


EXTENSION = PlayExtension()
