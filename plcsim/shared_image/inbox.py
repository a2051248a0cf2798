"""The inbox of one service: its commands, taken in LATCH, applied in order for each task class.

A command that concerns a class in the middle of a cycle waits, and so does every later one of the
same service that concerns the same class; all others go on. Stores are answered after the PUBLISH
that shows them, all else at once.
"""

from __future__ import annotations

import contextlib
import os
from collections import deque
from typing import TYPE_CHECKING

from plcsim.core.errors import PageFault
from plcsim.shared_image.command import (
    WRITE,
    Cancel,
    CommandOutcome,
    Follow,
    ForceCommand,
    Release,
    SampleCommand,
    decode_command,
    note_time,
)

if TYPE_CHECKING:
    from plcsim.shared_image.command import Command
    from plcsim.shared_image.hands import Hands
    from plcsim.shared_image.ring import Consumer, Taken
    from plcsim.shared_image.samples import Sampler

STEPS_PER_COMMAND = 16
"""A command of more operations or scattered bytes counts as several; the last one of a LATCH is
applied whole."""

COMMANDS_OF_OTHERS = 4
"""As so many counts a command that does not only store: it is looked up by name, or put together.
"""

MOST_WAITING = 512
"""Commands of one service that wait for classes in the middle of a cycle; more stay in the ring."""


class Inbox:
    """The commands of one service.

    Args:
        name: of the service, for the logbook.
        consumer: its ring.
        hands: does what is asked for.
        sampler: serves its requests for samples, None where it has no stream.
        wake_fd: an eventfd that is raised when commands were answered, None for none.
    """

    def __init__(
        self,
        name: str,
        consumer: Consumer,
        hands: Hands,
        sampler: Sampler | None,
        wake_fd: int | None,
    ) -> None:
        self.sampler = sampler
        self._name = name
        self._consumer = consumer
        self._hands = hands
        self._wake_fd = wake_fd
        self._waiting: deque[Taken] = deque()
        self._blocked = 0
        self._held = 0
        self._is_hurried = False
        self._applied: list[Taken] = []

    @property
    def is_busy(self) -> bool:
        """True while commands wait, here or in the ring."""
        return bool(self._waiting) or not self._consumer.is_empty

    @property
    def is_open(self) -> bool:
        """True while a command that was taken lacks its answer, or its place was not given back."""
        return bool(self._applied) or self._consumer.is_open

    def drain(self, held: int, commands: int) -> int:
        """Apply what may be applied now; return the owners of what was written, as bits.

        Args:
            held: classes in the middle of a cycle, as bits of owners.
            commands: how many at most.
        """
        written = 0
        left = commands
        if self._waiting and (self._is_hurried or held != self._held):
            left, written = self._retry(held, left)
        self._held = held
        while left > 0 and len(self._waiting) < MOST_WAITING:
            taken = self._consumer.take()
            if taken is None:
                break
            if not self._read(taken):
                left -= 1
            elif taken.owners & (held | self._blocked):
                self._waiting.append(taken)
                self._blocked |= taken.owners
            else:
                left -= self._apply(taken)
                written |= taken.owners
        return written

    def _retry(self, held: int, left: int) -> tuple[int, int]:
        """Apply what waited for classes whose cycle has ended meanwhile."""
        written, blocked = 0, held
        still: deque[Taken] = deque()
        for taken in self._waiting:
            if left <= 0 or taken.owners & blocked:
                still.append(taken)
                blocked |= taken.owners
            else:
                left -= self._apply(taken)
                written |= taken.owners
        self._waiting = still
        self._is_hurried = left <= 0
        self._blocked = 0
        for taken in still:
            self._blocked |= taken.owners
        return left, written

    def _read(self, taken: Taken) -> bool:
        """Note what a record asks for; one that makes no sense is answered: False."""
        try:
            if taken.kind == WRITE:
                taken.plan = self._hands.stores.plan(taken.record, taken.count)
                taken.owners = taken.plan.owners
                return True
            command = taken.command = decode_command(bytes(taken.record))
        except ValueError:
            taken.answer(CommandOutcome.NO_COMMAND)
            return False
        except PageFault:
            taken.answer(CommandOutcome.NO_SUCH_ADDRESS)
            return False
        if isinstance(command, ForceCommand | Release) and command.path:
            taken.owners = self._hands.owner_of_tag(command.path)
            if not taken.owners:
                taken.answer(CommandOutcome.NO_SUCH_TAG)
                return False
        return True

    def _apply(self, taken: Taken) -> int:
        """Do what a record asks for; return as how many commands it counts."""
        note_time(taken.record, self._hands.time_ns)
        if taken.plan is not None:
            self._hands.stores.apply(taken.record, taken.plan)
            self._applied.append(taken)
            return 1 + taken.plan.work // STEPS_PER_COMMAND
        if taken.command is not None:
            outcome = self._carry_out(taken.command)
            if outcome is CommandOutcome.APPLIED and taken.owners:
                self._applied.append(taken)
            else:
                taken.answer(outcome)
        return COMMANDS_OF_OTHERS

    def _carry_out(self, command: Command) -> CommandOutcome:
        try:
            if isinstance(command, SampleCommand | Cancel | Follow):
                return self._sample(command)
            return self._hands.carry_out(command, self._name)
        except PageFault:
            return CommandOutcome.NO_SUCH_ADDRESS

    def _sample(self, command: SampleCommand | Cancel | Follow) -> CommandOutcome:
        if self.sampler is None:
            return CommandOutcome.NO_COMMAND
        if isinstance(command, Cancel):
            self.sampler.cancel(command.number)
        elif isinstance(command, Follow):
            self.sampler.follows = command
        elif not self.sampler.start(command):
            return CommandOutcome.TOO_MANY
        self._consumer.serving(len(self.sampler))
        return CommandOutcome.APPLIED

    def publish(self, held: int) -> None:
        """Answer what the snapshot shows that has just been written."""
        still = []
        for taken in self._applied:
            if taken.owners & held:
                still.append(taken)
            else:
                taken.applied()
        self._applied = still
        if self._consumer.acknowledge() and self._wake_fd is not None:
            with contextlib.suppress(OSError):  # nobody has read it for 2**64 times: awake
                os.eventfd_write(self._wake_fd, 1)
