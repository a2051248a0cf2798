import os
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.network import VirtualNetwork
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.shared_image import CommandOutcome, ImageReader, ImageWriter, StoreCommand, Write
from plcsim.shared_image.layout import make_file
from st_types import ARRAY, BOOL, REAL, STRING, UDINT, UINT, var

MS = 1_000_000


class Fast(Program):
    count = var(UDINT)
    copy = var(UDINT)
    setpoint = var(UINT)
    word = var(UINT)
    flags = var(ARRAY(BOOL, (0, 15)))
    name = var(STRING(11), "fast")

    def cyclic(self) -> None:
        self.count += 1
        self.copy = self.count


class Slow(Program):
    level = var(REAL, 1.5)
    seen = var(UINT)
    wanted = var(UINT)

    def cyclic(self) -> None:
        self.seen = self.wanted


class World:
    """A controller on the virtual clock, its image, and both ends of it."""

    def __init__(
        self,
        setup: Setup,
        services: dict[str, object],
        exports: tuple[str, ...] = (),
        streams: dict[str, int] | None = None,
    ) -> None:
        self.clock = VirtualClock()
        network = VirtualNetwork(self.clock.now_ns).host("192.168.0.10")
        self.controller = make_controller(setup, network=network, clock=self.clock)
        self.fd = make_file()
        self.writer = ImageWriter(
            self.fd,
            self.controller,
            project="test",
            services=services,
            exports=[self.controller.tags.find(path) for path in exports],
            streams=streams,
        )
        self.reader = ImageReader(self.fd, next(iter(services), ""))
        self.controller.boot()

    def write(self, path: str, data: bytes) -> int:
        return self.reader.send(Write((StoreCommand(self.address(path), data),)))

    def is_applied(self, ticket: int) -> bool:
        return self.reader.outcome(ticket) is CommandOutcome.APPLIED

    def address(self, path: str) -> int:
        return self.controller.tags.find(path).address

    def read(self, path: str) -> object:
        tag = self.reader.directory.find(path)
        size = tag.data_type.size
        place = self.reader.directory.offset_of(tag.address, size)
        from st_types.types.values import decode

        return decode(tag.data_type, self.reader.copy(place, place + size)[1])


Make = Callable[..., World]


@pytest.fixture
def make() -> Iterator[Make]:
    worlds: list[World] = []

    def build(
        *classes: TaskClassSetup, services: tuple[str, ...] = ("modbus",), **options: Any
    ) -> World:
        chosen = classes or (TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),)
        worlds.append(World(Setup(chosen), dict.fromkeys(services), **options))
        return worlds[-1]

    yield build
    for world in worlds:
        os.close(world.fd)


@pytest.fixture
def world(make: Make) -> World:
    return make()
