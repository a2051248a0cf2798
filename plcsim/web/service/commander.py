"""Commands to the scan, each with its answer."""

from __future__ import annotations

import asyncio
import contextlib
import os
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import PlcError
from plcsim.shared_image import CommandOutcome

if TYPE_CHECKING:
    from plcsim.shared_image import Answer, Command, ImageReader

PATIENCE_S: Final = 5.0
"""A scan that has not answered by then stands still."""

MOST_OPEN: Final = 256
"""Commands that wait for an answer."""


class Commander:
    """Sends commands and waits for what becomes of them.

    Args:
        image: with a ring.
        wake_fd: an eventfd, raised when commands were answered.
    """

    def __init__(self, image: ImageReader, wake_fd: int) -> None:
        self._image = image
        self._wake_fd = wake_fd
        self._open: dict[int, asyncio.Future[Answer]] = {}

    def start(self) -> None:
        """Listen for answers, on the running event loop."""
        asyncio.get_running_loop().add_reader(self._wake_fd, self._woken)

    def _woken(self) -> None:
        with contextlib.suppress(BlockingIOError):
            os.eventfd_read(self._wake_fd)
        for ticket, future in list(self._open.items()):
            answer = self._image.take_answer(ticket)
            if answer is not None:
                del self._open[ticket]
                if not future.done():
                    future.set_result(answer)

    async def ask(self, command: Command, what: str) -> Answer:
        """Send a command and return its answer, once a snapshot shows what it did.

        Args:
            command: what is asked.
            what: the same in words, for errors.

        Raises:
            PlcError: it is refused, or the scan takes no commands.
        """
        if len(self._open) >= MOST_OPEN:
            raise PlcError(f"{what}: too many commands wait")
        ticket = self._image.send(command)
        future: asyncio.Future[Answer] = asyncio.get_running_loop().create_future()
        self._open[ticket] = future
        try:
            async with asyncio.timeout(PATIENCE_S):
                answer = await future
        except TimeoutError:
            raise PlcError(f"{what}: the scan takes no commands; nothing was done yet") from None
        finally:
            self._open.pop(ticket, None)
        if answer.outcome is not CommandOutcome.APPLIED:
            raise PlcError(f"{what}: {answer.outcome.text}")
        return answer
