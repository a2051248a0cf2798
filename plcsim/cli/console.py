"""Where the commands print, and how."""

from __future__ import annotations

import contextlib
import sys
from typing import TYPE_CHECKING, Any, NoReturn

from rich.console import Console

from plcsim.core.text import escaped

if TYPE_CHECKING:
    from rich.text import Text

LONGEST_LINE = 1_000
"""Columns of a file or a pipe: no table is cut to the width of a terminal that is not there."""


class CommandConsole(Console):
    """A console that shows text as it is, and cuts no line where it is no terminal.

    What a terminal would act on, in a name or in the text of an exception, is shown as a number.
    """

    def __init__(self, *, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, highlight=False, markup=False, emoji=False)
        if not self.is_terminal:
            self.width = LONGEST_LINE

    def render_str(self, text: str, **options: Any) -> Text:
        """Return a text that was given as a string, of a line or of a cell."""
        return super().render_str(escaped(text), **options)

    def on_broken_pipe(self) -> NoReturn:
        """Leave the error to `plcsim.cli.command`; rich would end the process."""
        raise  # noqa: PLE0704  # called where it is handled


def print_error(error: object) -> None:
    """Print an error in one line, where somebody is left to read it."""
    with contextlib.suppress(OSError):
        print(f"plcsim: {escaped(str(error))}", file=sys.stderr)
