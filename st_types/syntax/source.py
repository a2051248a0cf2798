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

from st_types.errors import Diagnostic, DiagnosticSeverity, SourceError

if TYPE_CHECKING:
    from pathlib import Path
    from typing import BinaryIO

MAX_SOURCE_BYTES = 32 * 1024 * 1024
"""Largest file that is read; real declaration files stay below 2 MiB."""

_PART = 64 * 1024

_LINE_END = re.compile(r"\r\n?|\n")
_UTF16 = {BOM_UTF16_LE: "utf-16-le", BOM_UTF16_BE: "utf-16-be"}


def read_at_most(file: BinaryIO, most: int) -> bytes:
    """Return what is left in a file, up to a number of bytes.

    Python makes room for all that ``file.read`` is asked for, however small the file is; where the
    process has locked its memory that is real memory, and time to clear it.
    """
    parts = []
    while most > 0 and (part := file.read(min(most, _PART))):
        parts.append(part)
        most -= len(part)
    return b"".join(parts)


class Location(NamedTuple):
    """A location in a file; line and column count from 1, columns count characters."""

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
        mark: the byte order mark, empty if there is none.
    """

    def __init__(self, path: str, text: str, encoding: str = "utf-8", mark: bytes = b"") -> None:
        self.path = path
        self.text = text
        self.encoding = encoding
        self.mark = mark

    @classmethod
    def decode(cls, path: str, data: bytes) -> Source:
        """Return the source of a file's bytes: by its byte order mark, else UTF-8, else Latin-1.

        Latin-1 decodes any bytes, so this cannot fail on content.

        Raises:
            SourceError: the file is larger than `MAX_SOURCE_BYTES`.
        """
        if len(data) > MAX_SOURCE_BYTES:
            message = f"the file is larger than {MAX_SOURCE_BYTES // 1024 // 1024} MiB"
            finding = Diagnostic(DiagnosticSeverity.ERROR, path, 1, 1, message)
            raise SourceError(finding.render(), [finding])
        for mark, encoding in _UTF16.items():
            if data.startswith(mark):
                return cls(path, data[len(mark) :].decode(encoding, "replace"), encoding, mark)
        mark = BOM_UTF8 if data.startswith(BOM_UTF8) else b""
        data = data.removeprefix(mark)
        try:
            return cls(path, data.decode("utf-8"), "utf-8", mark)
        except UnicodeDecodeError:
            return cls(path, data.decode("latin-1"), "latin-1", mark)

    def encode(self, text: str) -> bytes:
        """Return ``text`` with the encoding, the byte order mark and the line ends of this source.

        Line ends are those of its first line, LF if it has only one.
        """
        first = _LINE_END.search(self.text)
        lines = _LINE_END.split(text)
        body = (first.group() if first is not None else "\n").join(lines)
        return self.mark + body.encode(self.encoding, "surrogatepass")

    @classmethod
    def read(cls, path: Path, shown: str = "") -> Source:
        """Read a file; ``shown`` is the path for diagnostics where it differs.

        Raises:
            OSError: the file cannot be read.
            SourceError: the file is larger than `MAX_SOURCE_BYTES`.
        """
        with path.open("rb") as file:
            return cls.decode(shown or str(path), read_at_most(file, MAX_SOURCE_BYTES + 1))

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
