"""Where the commands print."""

from __future__ import annotations

from typing import NoReturn

from rich.console import Console

LONGEST_LINE = 1_000
"""Columns of a file or a pipe: no table is cut to the width of a terminal that is not there."""


class CommandConsole(Console):
    """A console that shows text as it is, and cuts no line where it is no terminal."""

    def __init__(self, *, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, highlight=False, markup=False, emoji=False)
        if not self.is_terminal:
            self.width = LONGEST_LINE

    def on_broken_pipe(self) -> NoReturn:
        """Leave the error to `plcsim.cli.command`; rich would end the process."""
        raise  # noqa: PLE0704  # called where it is handled
