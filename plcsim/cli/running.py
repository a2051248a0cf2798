"""The run of a project as commands see it that look at it or write to it from outside."""

from __future__ import annotations

import contextlib
import os
import sys
import time
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import PlcError
from plcsim.core.system import State
from plcsim.process.run_file import find_runs
from plcsim.project.project_file import find_project
from plcsim.shared_image import CommandOutcome, ImageNotReady, ImageReader
from plcsim.shared_image.guest import guest
from plcsim.shared_image.status_page import StatusPage

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from plcsim.process.run_file import Run
    from plcsim.shared_image import Answer, Command

PATIENCE_S: Final = 5.0
"""A project that has just been started may take so long until it publishes, and a slow one until it
has taken a command."""

POLL_S: Final = 0.005


def find_running(project: Path) -> Run:
    """Return the run of a project that was started last; others are told.

    Raises:
        PlcError: there is none.
    """
    run, *others = find_runs(find_project(project).parent)
    if others:
        pids = ", ".join(str(other.pid) for other in others)
        print(
            f"{len(others) + 1} runs of this project; this is the one that was started last, "
            f"process {run.pid}; others: {pids}",
            file=sys.stderr,
        )
    return run


@contextlib.contextmanager
def open_image(run: Run) -> Iterator[ImageReader]:
    """Open the shared image of a run to read it.

    Raises:
        PlcError: the run has ended, or publishes nothing.
    """
    fd = run.open(run.image_fd)
    try:
        _await_image(fd)
        yield ImageReader(fd)
    finally:
        os.close(fd)


@contextlib.contextmanager
def open_as_guest(run: Run) -> Iterator[ImageReader]:
    """Open the shared image of a run to read it and to send commands; errors as `open_image`."""
    fd = run.open(run.image_fd)
    try:
        _await_image(fd)
        with guest(f"/proc/self/fd/{fd}") as reader:
            yield reader
    finally:
        os.close(fd)


def _await_image(fd: int) -> None:
    """Wait for the first snapshot; the scan process may still be loading the project."""
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            ImageReader(fd).copy(0, 0)
        except ImageNotReady:
            if time.monotonic() > deadline:
                raise
            time.sleep(POLL_S)
        else:
            return


def ask(run: Run, reader: ImageReader, command: Command, what: str) -> Answer:
    """Send a command and return its answer, once a snapshot shows what it did.

    Args:
        run: that is asked.
        reader: with a ring.
        command: what is asked.
        what: the same in words, for errors.

    Raises:
        PlcError: it is refused, or the scan takes no commands.
    """
    ticket = reader.send(command)
    deadline = time.monotonic() + PATIENCE_S
    while (answer := reader.take_answer(ticket)) is None:
        state = _state(run)
        if state is not State.RUN or time.monotonic() > deadline:
            stands = "the scan stands still" if state is State.RUN else f"it is in {state.name}"
            raise PlcError(f"{what}: {stands}, nothing was done")
        time.sleep(POLL_S)
    if answer.outcome is not CommandOutcome.APPLIED:
        raise PlcError(f"{what}: {answer.outcome.text}")
    return answer


def _state(run: Run) -> State:
    page = StatusPage(run.open(run.status_fd))
    try:
        return page.state
    finally:
        page.close()
