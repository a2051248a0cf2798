"""A terminal that shows a live table, and above it what the processes of a run print."""

from __future__ import annotations

import re
import threading
from typing import TYPE_CHECKING

from rich.live import Live
from rich.text import Text

from plcsim.core.text import escaped
from plcsim.process.output import PATIENCE_S, ROOM

if TYPE_CHECKING:
    from collections.abc import Callable

    from rich.console import Console, RenderableType

PERIOD_S = 0.25
"""The table is drawn anew this often, and whenever something is printed."""

_COLOUR = re.compile(r"(\x1b\[[0-9;:]*m)")


class Terminal:
    """Draws a table and prints lines above it, by a thread of its own.

    A thread, so that a terminal that does not take output (Ctrl-S) holds up neither the scan nor
    the watchdog. It is a `plcsim.process.output.Sink`.

    Args:
        console: of the terminal.
    """

    whole_lines = True

    def __init__(self, console: Console) -> None:
        self._console = console
        self._picture: Callable[[], RenderableType] | None = None
        self._live: Live | None = None
        self._waiting: list[bytes] = []
        self._size = 0
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def show(self, picture: Callable[[], RenderableType]) -> None:
        """Show a table from now on.

        Args:
            picture: makes it; called in another thread.
        """
        self._show(picture)

    def hide(self) -> None:
        """Take the table away, unless the terminal takes no output for `PATIENCE_S`."""
        self._show(None)
        with self._changed:
            self._changed.wait_for(lambda: self._live is None, PATIENCE_S)

    def _show(self, picture: Callable[[], RenderableType] | None) -> None:
        with self._changed:
            self._picture = picture
            self._changed.notify_all()

    # plcsim.process.output.Sink

    @property
    def room(self) -> int:
        """Bytes that it takes now."""
        return ROOM - self._size

    def put(self, data: bytes) -> None:
        """Take lines."""
        with self._changed:
            self._waiting.append(data)
            self._size += len(data)
            self._changed.notify_all()

    def flush(self, patient: Callable[[], bool]) -> int:
        """Wait until everything has been printed; see `plcsim.process.output.Sink`."""
        with self._changed:
            before = -1
            while self._size and (self._size != before or patient()):
                before = self._size
                self._changed.wait(PATIENCE_S)
            return self._size

    # its thread

    def _run(self) -> None:
        try:
            while True:
                self._draw(*self._next())
        except (OSError, ValueError):  # the terminal has gone, or the run whose table it was
            while True:
                self._done()
                self._next()

    def _next(self) -> tuple[bytes, Callable[[], RenderableType] | None]:
        """Return the lines to print and the table to show, once there is something to do."""
        with self._changed:
            if not self._waiting:
                self._changed.wait(PERIOD_S if self._picture else None)
            lines = b"".join(self._waiting)
            self._waiting.clear()
            return lines, self._picture

    def _draw(self, lines: bytes, picture: Callable[[], RenderableType] | None) -> None:
        if picture is not None and self._live is None:
            self._live = Live(console=self._console, auto_refresh=False, transient=True)
            self._live.start()
        if lines:
            self._console.print(text_of(lines), end="", soft_wrap=True)
        if self._live is not None and picture is not None:
            self._live.update(picture(), refresh=True)
        elif self._live is not None:
            self._live.stop()
        self._done(keep=picture is not None)

    def _done(self, *, keep: bool = False) -> None:
        """Tell those who wait that everything taken has been drawn."""
        with self._changed:
            if not keep:
                self._live = None
            self._size = sum(map(len, self._waiting))
            self._changed.notify_all()


def text_of(lines: bytes) -> Text:
    """Return what a program printed, with its colours; nothing else in it moves the cursor."""
    text = lines.decode("utf-8", "backslashreplace").replace("\r\n", "\n")
    parts = _COLOUR.split(text)  # every second one is a colour
    parts[::2] = map(escaped, parts[::2])
    return Text.from_ansi("".join(parts))
