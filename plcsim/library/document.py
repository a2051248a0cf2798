"""XML files of Automation Studio, read into elements that know their lines.

A document type is refused: its entities can make much of little. So is what is too large, or nested
too deep.
"""

from __future__ import annotations

import codecs
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final
from xml.parsers import expat

from st_types.syntax.source import read_at_most

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

MAX_BYTES: Final = 32 << 20
"""Bytes of a file that are read; real ones stay below 4 MiB."""

_DECLARED: Final = re.compile(rb"\s*<\?xml[^>]*encoding\s*=\s*[\"'](?!utf-?8)", re.IGNORECASE)
"""The head of a text that declares another encoding than UTF-8."""

_FILE_VERSION: Final = re.compile(r"""\bFileVersion=["']?([^"'\s]+)""")

MAX_DEPTH: Final = 100
"""Elements one inside the other; real ones stay below 20."""


class DocumentError(Exception):
    """A file cannot be read as XML.

    Attributes:
        line: where, 0 where it is the whole file.
        root: what was read before, of a file that was saved half; None for nothing.
    """

    def __init__(self, message: str, line: int = 0, root: XmlElement | None = None) -> None:
        super().__init__(message)
        self.line = line
        self.root = root


@dataclass(slots=True)
class XmlElement:
    """An element of a document.

    Attributes:
        tag: its name without the namespace.
        attributes: as they are spelled.
        line: where it begins.
        text: of the element itself, before its first child.
        children: the elements in it.
        offset: bytes of the document before it.
        file_version: of the root: what the head of the file gives as FileVersion.
    """

    tag: str
    attributes: Mapping[str, str]
    line: int
    text: str = ""
    children: list[XmlElement] = field(default_factory=list)
    offset: int = 0
    file_version: str = ""

    def get(self, key: str, default: str = "") -> str:
        """Return an attribute."""
        return self.attributes.get(key, default)

    def is_true(self, key: str) -> bool:
        """Whether an attribute says "true"."""
        return self.get(key).strip().lower() == "true"

    def all(self, *tags: str) -> Iterator[XmlElement]:
        """Yield this element and those in it, in order, that have one of ``tags``."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            if element.tag in tags:
                yield element
            waiting += reversed(element.children)


def read_document(file: Path) -> XmlElement:
    """Return the root element of an XML file.

    Raises:
        DocumentError: the file cannot be read, or is no such XML.
    """
    try:
        with file.open("rb") as stream:
            data = read_at_most(stream, MAX_BYTES + 1)
    except OSError as err:
        raise DocumentError(err.strerror or str(err)) from None
    if len(data) > MAX_BYTES:
        raise DocumentError(f"it is larger than {MAX_BYTES >> 20} MiB")
    return parse(data)


def parse(data: bytes, encoding: str | None = None) -> XmlElement:
    """Return the root element of an XML text.

    Args:
        data: the text.
        encoding: that it has, whatever it declares; None where it is to be found out.

    Raises:
        DocumentError: it is no such XML.
    """
    builder = _Builder(encoding or _encoding(data))
    try:
        builder.parser.Parse(data, True)  # noqa: FBT003  # expat takes no names
    except expat.ExpatError as err:
        message = expat.ErrorString(err.code)
        raise DocumentError(f"it is no XML: {message}", err.lineno, builder.complete()) from None
    except (LookupError, ValueError) as err:
        raise DocumentError(f"it is no XML: {err}", builder.line) from None
    assert builder.root is not None  # or expat had found no element
    return builder.root


def _encoding(data: bytes) -> str | None:
    """Return the encoding of a text that is not as it declares itself, None for what it declares.

    Scripts and old versions have left files in UTF-16 and in that of Windows behind, as UTF-8.
    """
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "UTF-16"
    if _DECLARED.match(data) is None:
        try:
            data.decode("utf-8")
        except UnicodeDecodeError:
            return "ISO-8859-1"  # of those that expat knows the nearest
    return None


class _Builder:
    """Makes elements of what the parser finds."""

    def __init__(self, encoding: str | None) -> None:
        self.root: XmlElement | None = None
        self._open: list[XmlElement] = []
        self.parser = expat.ParserCreate(encoding)
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text
        self.parser.StartDoctypeDeclHandler = self._doctype
        self.parser.ProcessingInstructionHandler = self._instruction
        self._file_version = ""

    @property
    def line(self) -> int:
        return self.parser.CurrentLineNumber

    def complete(self) -> XmlElement | None:
        """Return what was read up to here, without the element that has not ended."""
        if len(self._open) > 1 and not self._open[-1].children:
            self._open[-2].children.remove(self._open[-1])
        return self.root

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        if len(self._open) >= MAX_DEPTH:
            raise DocumentError(f"elements are nested deeper than {MAX_DEPTH}", self.line)
        tag, place = name.rpartition(":")[2], self.parser.CurrentByteIndex
        element = XmlElement(tag, attributes, self.line, offset=place)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self.root = element
            element.file_version = self._file_version
        self._open.append(element)

    def _end(self, _name: str) -> None:
        self._open.pop()

    def _text(self, text: str) -> None:
        element = self._open[-1]
        if not element.children:
            element.text += text

    def _instruction(self, target: str, text: str) -> None:
        found = _FILE_VERSION.search(text) if target == "AutomationStudio" else None
        if found is not None:
            self._file_version = found[1]

    def _doctype(self, name: str, *_rest: object) -> None:
        raise DocumentError(f"a document type ({name}) has no place here", self.line)
