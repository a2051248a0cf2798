"""What is wrong in the files of an Automation Studio project."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path


class Finding(NamedTuple):
    """What is wrong in a file, or not to be had.

    Attributes:
        file: where.
        line: of the file, 0 where it is all of it.
        message: what is wrong.
        missing: the object that is listed and not there, "" where the file itself is wrong.
    """

    file: Path
    line: int
    message: str
    missing: str = ""

    @property
    def location(self) -> str:
        """The file, and the line where there is one."""
        return f"{self.file}:{self.line}" if self.line else str(self.file)

    @property
    def severity(self) -> str:
        """What is listed and missing may not be needed; all else is an error."""
        return "warning" if self.missing else "error"

    def __str__(self) -> str:
        return f"{self.location}: {self.severity}: {self.message}"
