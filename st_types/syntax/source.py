"""Source text of declarations and programs: decoding, lines and columns.

Automation Studio writes files in the code page of its Windows host; newer files are UTF-8. Line
ends are CRLF, LF or, in very old files, CR.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from st_types.errors import Diagnostic, Severity, SourceError

if TYPE_CHECKING:
    from pathlib import Path

MAX_SOURCE_BYTES = 32 * 1024 * 1024
"""Largest file that is read; real declaration files stay below 2 MiB."""

_LINE_END = re.compile(r"\r\n?|\n")


class Location(NamedTuple):
    """A place in a file; line and column count from 1, columns count characters."""

    path: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.path}:{self.line}:{self.column}"


class Source:
    """The text of one file.

    Attributes:
        path: as it is shown in diagnostics.
        text: decoded, without a byte order mark; line ends as in the file.
        encoding: the codec that decoded it, for bytes of STRINGs.
    """

    def __init__(self, path: str, text: str, encoding: str = "utf-8") -> None:
        self.path = path
        self.text = text
        self.encoding = encoding

    @classmethod
    def decode(cls, path: str, data: bytes) -> Source:
        """Return the source of a file's bytes: by its byte order mark, else UTF-8, else Latin-1.

        Latin-1 decodes any bytes, so this cannot fail on content.

        Raises:
            SourceError: the file is larger than `MAX_SOURCE_BYTES`.
        """
        if len(data) > MAX_SOURCE_BYTES:
            message = f"the file is larger than {MAX_SOURCE_BYTES // 1024 // 1024} MiB"
            finding = Diagnostic(Severity.ERROR, path, 1, 1, message)
            raise SourceError(finding.render(), [finding])
        if data.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
            return cls(path, data.decode("utf-16", "replace"), "utf-16")
        data = data.removeprefix(BOM_UTF8)
        try:
            return cls(path, data.decode("utf-8"), "utf-8")
        except UnicodeDecodeError:
            return cls(path, data.decode("latin-1"), "latin-1")

    @classmethod
    def read(cls, path: Path, shown: str = "") -> Source:
        """Read a file; ``shown`` is the path for diagnostics where it differs.

        Raises:
            OSError: the file cannot be read.
            SourceError: the file is larger than `MAX_SOURCE_BYTES`.
        """
        with path.open("rb") as file:
            return cls.decode(shown or str(path), file.read(MAX_SOURCE_BYTES + 1))

    @cached_property
    def line_starts(self) -> list[int]:
        """Offsets of the first characters of all lines."""
        return [0, *(match.end() for match in _LINE_END.finditer(self.text))]

    @property
    def line_count(self) -> int:
        """Number of lines; a text that ends in a line end has no further line after it."""
        starts = self.line_starts
        return len(starts) - (starts[-1] == len(self.text))

    def location(self, offset: int) -> Location:
        """Return the place of the character at ``offset`` (0 up to the length of the text)."""
        line = bisect_right(self.line_starts, offset)
        return Location(self.path, line, offset - self.line_starts[line - 1] + 1)

    def line_text(self, line: int) -> str:
        """Return line number ``line`` (from 1) without its line end."""
        start = self.line_starts[line - 1]
        end = self.line_starts[line] if line < len(self.line_starts) else len(self.text)
        return self.text[start:end].rstrip("\r\n")
