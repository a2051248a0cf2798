"""The scan's side of the shared image: applies commands in LATCH, publishes in PUBLISH.

A class that is preempted has half a cycle in its variables. So while it is, its variables are
carried over from the last snapshot, and commands for them wait: inputs stand still in RUN, and
nobody outside sees half a cycle.
"""

from __future__ import annotations

import contextlib
import mmap
import os
from collections import deque
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.errors import ConfigurationError, PageFault
from plcsim.core.memory import FIRST
from plcsim.shared_image import layout
from plcsim.shared_image.command import Mask, Scatter, decode_command
from plcsim.shared_image.directory import Directory, Variables, hash_of
from plcsim.shared_image.ring import Consumer

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag
    from plcsim.core.task import TaskClass
    from plcsim.shared_image.command import Command, Operation

COMMANDS_PER_LATCH = (8, 64)
"""Of one service, at least and at most."""

CYCLE_PER_COMMAND_NS = 62_500
"""Between these bounds, a command for so much of the shortest cycle: about 4 % of its time, at 2.5
us for a command."""

STEPS_PER_COMMAND = 16
"""A command of more operations or scattered bytes counts as several; the last one of a LATCH is
applied whole."""

WHOLE_PROGRAMS = 64 * 1024
"""Bytes. Up to here a snapshot holds all variables; above, only those that extensions ask for."""

NEAR = 64
"""Bytes. Tags that lie closer together are copied in one go."""


class _Span(NamedTuple):
    """A part of the snapshot: its owner's number, PLC address, bytes, offset in the bank."""

    task_class: int
    address: int
    size: int
    place: int


class _Applied(NamedTuple):
    """A command that is applied but perhaps not shown yet."""

    position: int
    command: Command


class _Ring(NamedTuple):
    consumer: Consumer
    applied: deque[_Applied]
    wake_fd: int | None


class ImageWriter:
    """Keeps the image of one controller; to be made before its boot.

    Args:
        fd: an empty shared memory file (see `plcsim.shared_image.layout.make_file`).
        controller: whose variables are published; the writer enters its image's hooks.
        project: its name.
        services: what the directory holds for each service; each gets a ring, in this order.
        exports: the tags that a snapshot must hold, whatever its size.
        wake_fds: eventfd of each ring, raised when commands were acknowledged.

    Attributes:
        directory: what the image holds.
        commands_per_latch: how many of one service one LATCH applies.
    """

    def __init__(
        self,
        fd: int,
        controller: Controller,
        *,
        project: str,
        services: Mapping[str, object],
        exports: Sequence[Tag] = (),
        wake_fds: Sequence[int] = (),
    ) -> None:
        self._memory = controller.memory
        self._bytes = self._memory.view(FIRST, self._memory.used)
        self._spans = _spans(controller, exports)
        self.directory = Directory(
            project,
            min(c.cycle_ns for c in controller.classes),
            [Variables(area.path, area.address, area.data_type) for area in controller.areas],
            [(span.address, span.size) for span in self._spans],
            services,
        )
        least, most = COMMANDS_PER_LATCH
        self.commands_per_latch = max(
            least, min(most, self.directory.cycle_ns // CYCLE_PER_COMMAND_NS)
        )
        self._in_cycle: list[int] = []
        self._owned = _owned(controller)
        self._number = 0
        self._lay_out(fd, wake_fds)
        controller.image.inputs.append(self.latch)
        controller.image.watchers.append(self.publish)

    def _lay_out(self, fd: int, wake_fds: Sequence[int]) -> None:
        directory = self.directory.to_bytes()
        rings = len(self.directory.services)
        if rings > layout.MAX_RINGS:
            raise ConfigurationError(f"{rings} services: at most {layout.MAX_RINGS}")
        regions = layout.regions(len(directory), self.directory.bank_size, rings)
        os.ftruncate(fd, regions.size)
        view = memoryview(mmap.mmap(fd, regions.size))
        self._cells = view[: layout.HEADER_SIZE].cast("Q")
        view[layout.HEADER_SIZE : layout.HEADER_SIZE + len(directory)] = directory
        self._banks = [view[at : at + self.directory.bank_size] for at in regions.banks]
        self._rings = [
            _Ring(
                Consumer(self._cells, view[at : at + layout.RING_SIZE], layout.ring_cells(number)),
                deque(),
                wake_fds[number] if number < len(wake_fds) else None,
            )
            for number, at in enumerate(regions.rings)
        ]
        cells = self._cells
        cells[layout.CELL_DIRECTORY_SIZE] = len(directory)
        cells[layout.CELL_BANK_SIZE] = self.directory.bank_size
        cells[layout.CELL_RINGS] = rings
        cells[layout.CELL_HASH] = hash_of(directory)
        cells[layout.CELL_MAGIC] = layout.MAGIC  # last: whoever sees it finds the rest in place

    def latch(self, task_class: TaskClass) -> None:
        """Apply the commands that wait, in order, as many as one LATCH may."""
        for ring in self._rings:
            self._drain(ring)
        self._in_cycle.append(task_class.number)

    def _drain(self, ring: _Ring) -> None:
        left = self.commands_per_latch
        while left > 0:
            before = ring.consumer.position
            record = ring.consumer.peek()
            if record is None:
                if ring.consumer.position != before:  # it has dropped what made no sense
                    ring.applied.append(_Applied(ring.consumer.position, ()))
                return
            try:
                command = decode_command(record)
                for operation in command:
                    self._check(operation)
            except (ValueError, PageFault):
                ring.consumer.refuse()
                command = ()
            if self._in_cycle and self._concerns_cycle(command):
                return
            self._apply(command)
            left -= 1 + sum(_steps(operation) for operation in command) // STEPS_PER_COMMAND
            ring.consumer.position += len(record)
            ring.applied.append(_Applied(ring.consumer.position, command))

    def _check(self, operation: Operation) -> None:
        """Raise PageFault for an operation outside the memory."""
        match operation:
            case Scatter(addresses=addresses):
                low, high = min(addresses, default=FIRST), max(addresses, default=FIRST)
                if not FIRST <= low <= high < FIRST + len(self._bytes):
                    raise PageFault(low, high - low + 1)
            case Mask(address=address):
                self._memory.check(address, 2)
            case _:
                self._memory.check(operation.address, len(operation.data))

    def _apply(self, command: Command) -> None:
        memory = self._memory
        for operation in command:
            match operation:
                case Scatter(addresses, data):
                    stored = self._bytes
                    for address, value in zip(addresses, data, strict=True):
                        stored[address - FIRST] = value
                case Mask(address=address):
                    word = int.from_bytes(memory.read(address, 2), "little")
                    memory.write(address, operation.applied_to(word).to_bytes(2, "little"))
                case _:
                    memory.write(*operation)

    def _concerns_cycle(self, command: Command) -> bool:
        """Return True where the command writes variables of a class in the middle of a cycle."""
        held = [self._owned[n] for n in self._in_cycle]
        return any(
            low <= address < high
            for ranges in held
            for low, high in ranges
            for operation in command
            for address in _addresses(operation)
        )

    def publish(self, task_class: TaskClass) -> None:
        """Write the next snapshot, then acknowledge the commands that it shows."""
        self._in_cycle.remove(task_class.number)
        number = self._number + 1
        new, old = self._banks[number & 1], self._banks[self._number & 1]
        cells = self._cells
        cells[layout.CELL_BEGIN[number & 1]] = number
        for owner, address, size, place in self._spans:
            end = place + size
            if owner in self._in_cycle:
                new[place:end] = old[place:end]
            else:
                new[place:end] = self._memory.read(address, size)
        cells[layout.CELL_END[number & 1]] = number
        cells[layout.CELL_LATEST] = self._number = number
        for ring in self._rings:
            if ring.applied:
                self._acknowledge(ring)

    def _acknowledge(self, ring: _Ring) -> None:
        shown = 0
        while ring.applied and not (
            self._in_cycle and self._concerns_cycle(ring.applied[0].command)
        ):
            shown = ring.applied.popleft().position
        if shown:
            ring.consumer.acknowledge(shown)
            if ring.wake_fd is not None:
                with contextlib.suppress(OSError):  # nobody has read it for 2**64 times: awake
                    os.eventfd_write(ring.wake_fd, 1)


def _steps(operation: Operation) -> int:
    return len(operation.addresses) if isinstance(operation, Scatter) else 1


def _addresses(operation: Operation) -> Sequence[int]:
    return operation.addresses if isinstance(operation, Scatter) else (operation.address,)


def _owned(controller: Controller) -> dict[int, list[tuple[int, int]]]:
    """Return the address ranges of each class' variables by its number."""
    return {
        c.number: [
            (t.variables.address, t.variables.address + t.variables.data_type.size) for t in c.tasks
        ]
        for c in controller.classes
    }


def _spans(controller: Controller, exports: Sequence[Tag]) -> list[_Span]:
    """Return what a snapshot holds: all variables, or the exported tags where that is too much."""
    whole = [(area.address, area.data_type.size) for area in controller.areas]
    if sum(size for _, size in whole) > WHOLE_PROGRAMS:
        whole = _joined(controller, exports)
    owners = _owned(controller)
    spans: list[_Span] = []
    place = 0
    for address, size in whole:
        spans.append(_Span(_owner(owners, address), address, size, place))
        place += size
    return spans


def _owner(owners: dict[int, list[tuple[int, int]]], address: int) -> int:
    """Return the class whose variable lies at an address, 0 for the exception program."""
    for number, ranges in owners.items():
        if any(low <= address < high for low, high in ranges):
            return number
    return 0


def _joined(controller: Controller, exports: Sequence[Tag]) -> list[tuple[int, int]]:
    """Return the spans of tags, those that lie near each other in one program joined."""
    result: list[tuple[int, int]] = []
    starts = {area.address for area in controller.areas}
    for tag in sorted(exports, key=lambda tag: tag.address):
        end = tag.address + tag.data_type.size
        if result:
            first, length = result[-1]
            crosses = any(first < start <= tag.address for start in starts)
            if tag.address - first - length <= NEAR and not crosses:
                result[-1] = (first, max(length, end - first))
                continue
        result.append((tag.address, tag.data_type.size))
    return result
