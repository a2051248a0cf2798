"""The scan's side of the shared image: applies commands in LATCH, publishes in PUBLISH.

A class that is preempted has half a cycle in its variables. So while it is, its variables are
carried over from the last snapshot, and commands for them wait: inputs stand still in RUN, and
nobody outside sees half a cycle.
"""

from __future__ import annotations

import mmap
import os
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from plcsim.core.owners import bit_of
from plcsim.shared_image import layout
from plcsim.shared_image.directory import Directory, hash_of
from plcsim.shared_image.events import EventKind, encode_entry, encode_violation
from plcsim.shared_image.figures import FiguresWriter
from plcsim.shared_image.force_list import encode_forces, write_forces
from plcsim.shared_image.hands import Hands
from plcsim.shared_image.inbox import Inbox
from plcsim.shared_image.ring import Consumer
from plcsim.shared_image.samples import Sampler
from plcsim.shared_image.snapshot import Snapshots, spans_of, whole_or
from plcsim.shared_image.stream import StreamWriter

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.logbook import Entry
    from plcsim.core.tag import Tag
    from plcsim.core.task import TaskClass, Violation

COMMANDS_PER_LATCH = (8, 64)
"""Of one service, at least and at most."""

CYCLE_PER_COMMAND_NS = 62_500
"""Between these bounds, a command for so much of the shortest cycle: some 6 % of its time, at 4 us
for a command."""

GUEST_NAME = "plcsim"
"""What the logbook calls a guest: a command on the command line."""


class ImageWriter:
    """Keeps the image of one controller; to be made before its boot.

    Args:
        fd: an empty shared memory file (see `plcsim.shared_image.layout.make_file`).
        controller: whose variables are published; the writer enters its image's hooks.
        project: its name.
        services: what the directory holds for each service; each gets a ring, in this order.
        streams: bytes of the stream that carries samples to a service, by its name.
        exports: the tags that a snapshot must hold, whatever its size.
        wake_fds: eventfd of each ring, raised when commands were answered.

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
        streams: Mapping[str, int] | None = None,
        exports: Sequence[Tag] = (),
        wake_fds: Sequence[int] = (),
    ) -> None:
        self._controller = controller
        self._context = controller.context
        areas = [(a.address, a.data_type.size) for a in controller.areas]
        asked = [(tag.address, tag.data_type.size) for tag in exports]
        self._spans = spans_of(whole_or(areas, asked), controller.owners)
        self.directory = Directory(
            project,
            min(c.cycle_ns for c in controller.classes),
            controller.areas,
            [(span.address, span.size) for span in self._spans],
            services,
            _stream_sizes(services, streams or {}),
        )
        least, most = COMMANDS_PER_LATCH
        self.commands_per_latch = max(
            least, min(most, self.directory.cycle_ns // CYCLE_PER_COMMAND_NS)
        )
        self._hands = Hands(controller)
        self._written = 0
        self._origin_ns = 0
        self._lay_out(fd, wake_fds)
        controller.logbook.follow(self._entered)
        controller.follow_violations(self._violated)
        controller.forces.follow(self._show_forces)
        controller.image.inputs.append(self.latch)
        controller.image.watchers.append(self.publish)
        controller.image.exchanges.append(self.exchange)

    def _lay_out(self, fd: int, wake_fds: Sequence[int]) -> None:
        directory = self.directory.to_bytes()
        streams = self.directory.streams
        if len(streams) > layout.MAX_RINGS:
            most = layout.MAX_RINGS - layout.GUESTS
            raise ConfigurationError(f"{len(self.directory.services)} services: at most {most}")
        bank_size = self.directory.bank_size
        regions = layout.regions(len(directory), bank_size, streams)
        os.ftruncate(fd, regions.size)
        # all pages now: a stream comes to a new one every few cycles otherwise
        flags = mmap.MAP_SHARED | mmap.MAP_POPULATE
        view = memoryview(mmap.mmap(fd, regions.size, flags))
        self._cells = cells = view[: layout.HEADER_SIZE].cast("Q")
        view[layout.HEADER_SIZE : layout.HEADER_SIZE + len(directory)] = directory
        banks = [view[at : at + bank_size] for at in regions.banks]
        memory = self._controller.memory
        self._snapshots = Snapshots(memory, self._spans, cells, banks)
        self._forces = view[regions.forces : regions.forces + layout.FORCES_SIZE]
        events = view[regions.events : regions.events + layout.EVENTS_SIZE]
        self._events = StreamWriter(cells, events, layout.EVENT_CELLS)
        self._inboxes = []
        self._streams: dict[str, StreamWriter] = {}
        names = [*self.directory.services, *[GUEST_NAME] * layout.GUESTS]
        for number, (name, at, start) in enumerate(
            zip(names, regions.rings, regions.streams, strict=True)
        ):
            ring = view[at : at + layout.RING_SIZE]
            stream = StreamWriter(
                cells, view[start : start + streams[number]], layout.stream_cells(number)
            )
            self._streams.setdefault(name, stream)
            self._inboxes.append(
                Inbox(
                    name,
                    Consumer(cells, ring, layout.ring_cells(number)),
                    self._hands,
                    Sampler(memory, self._controller.owners, stream) if streams[number] else None,
                    wake_fds[number] if number < len(wake_fds) else None,
                )
            )
        self._samplers = [i.sampler for i in self._inboxes if i.sampler is not None]
        self._follows = [sampler.follows for sampler in self._samplers]
        self._figures = FiguresWriter(self._controller)
        self._heads = cells[layout.HEADS : layout.HEADS + layout.MAX_RINGS]
        self._seen = b""
        self._is_busy = False
        self._open: list[Inbox] = []
        self._sampling: list[Sampler] = []
        cells[layout.CELL_DIRECTORY_SIZE] = len(directory)
        cells[layout.CELL_HASH] = hash_of(directory)
        cells[layout.CELL_MAGIC] = layout.MAGIC  # last: whoever sees it finds the rest in place

    def stream_of(self, service: str) -> StreamWriter:
        """Return the stream to a service; it takes nothing where the service asked for none."""
        return self._streams[service]

    def latch(self, _task_class: TaskClass) -> None:
        """Apply the commands that wait, in order, as many as one LATCH may."""
        if self._is_busy or self._heads.tobytes() != self._seen:
            self._drain(self._controller.image.held())

    def _drain(self, held: int) -> None:
        self._seen = self._heads.tobytes()
        self._hands.time_ns = self._context.release_ns - self._controller.origin_ns
        self._is_busy = False
        for inbox in self._inboxes:
            if inbox.is_busy:
                self._written |= inbox.drain(held, self.commands_per_latch)
                self._is_busy |= inbox.is_busy
                if inbox not in self._open:
                    self._open.append(inbox)
        self._sampling = [sampler for sampler in self._samplers if sampler]
        follows = [sampler.follows for sampler in self._samplers]
        if follows != self._follows:
            self._follows = follows
            self._figures.serve(self._samplers)

    def publish(self, task_class: TaskClass) -> None:
        """Write the next snapshot and the samples, then answer the commands that they show."""
        held, now_ns = self._controller.image.held(), self._context.release_ns
        self._publish(bit_of(task_class), held, now_ns)
        for sampler in self._sampling:
            time_ns = now_ns - self._controller.origin_ns
            sampler.publish(task_class, held, now_ns, time_ns)

    def _publish(self, changed: int, held: int, now_ns: int) -> None:
        origin_ns = self._controller.scan.origin_ns
        if origin_ns != self._origin_ns:  # after a boot everything has another value
            self._origin_ns, changed = origin_ns, -1
        self._snapshots.publish(changed | self._written, held, now_ns)
        self._written &= held
        if self._open:
            for inbox in self._open:
                inbox.publish(held)
            self._open = [inbox for inbox in self._open if inbox.is_open]

    def exchange(self) -> None:
        """Apply commands and publish between two cycles, while the controller is paused."""
        self._drain(0)
        self._controller.forces.apply(0)
        self._publish(-1, 0, self._context.release_ns)

    def _entered(self, entry: Entry) -> None:
        self._events.write(EventKind.ENTRY.value, entry.time_ns, encode_entry(entry))

    def _violated(self, violation: Violation) -> None:
        time_ns = self._controller.clock.stamp_ns() - self._controller.origin_ns
        self._events.write(EventKind.VIOLATION.value, time_ns, encode_violation(violation))

    def _show_forces(self) -> None:
        self._written = -1
        forces = list(self._controller.forces)
        text = encode_forces(forces)
        while len(text) > layout.FORCES_SIZE:  # those of tests may be more than a service's
            del forces[len(forces) // 2 :]
            text = encode_forces(forces)
        write_forces(self._cells, self._forces, text)


def _stream_sizes(services: Mapping[str, object], streams: Mapping[str, int]) -> list[int]:
    """Return the bytes of the stream beside each ring."""
    sizes = [-(-streams.get(name, 0) // 64) * 64 for name in services]
    return [*sizes, *[layout.GUEST_STREAM_SIZE] * layout.GUESTS]
