"""A document that is written piece by piece."""

from __future__ import annotations

import codecs
from typing import Final
from xml.sax.saxutils import escape, quoteattr

from plcsim.library.asxml.interface import xmlERR_INVALID_POSITION
from plcsim.library.block import StatusError

LARGEST: Final = 4 << 20
"""Bytes of a document."""


class XmlWriter:
    """A writer.

    Attributes:
        address: where the document was put in PLC memory, 0 for nowhere.
    """

    def __init__(self) -> None:
        self.address = 0
        self._pieces: list[bytes] = []
        self._open: list[str] = []
        self._is_tag_open = False
        self._input = self._output = "utf-8"
        self._size = 0

    @property
    def is_full(self) -> bool:
        """Whether it is too large."""
        return self._size > LARGEST

    @property
    def data(self) -> bytes:
        """The document so far."""
        self._end_tag()
        return b"".join(self._pieces)

    def _write(self, text: str) -> None:
        data = text.encode(self._output, "xmlcharrefreplace")
        self._pieces.append(data)
        self._size += len(data)

    def text(self, data: bytes) -> str:
        """Return a text of the program."""
        return data.decode(self._input, "replace")

    def _end_tag(self) -> None:
        if self._is_tag_open:
            self._is_tag_open = False
            self._write(">")

    def declare(self, version: str, encodings: tuple[str, str], standalone: str) -> None:
        """Write the declaration.

        Args:
            version: of XML.
            encodings: of the texts, and of the document.
            standalone: yes, no, or "" for neither.

        Raises:
            LookupError: there is no such encoding.
            StatusError: something is written already.
        """
        for encoding in encodings:
            codecs.lookup(encoding)
        if self._pieces:
            raise StatusError(xmlERR_INVALID_POSITION)
        self._input, self._output = encodings
        more = f' standalone="{standalone}"' if standalone else ""
        self._write(f'<?xml version="{version}" encoding="{encodings[1]}"{more}?>\n')

    def begin(self, name: str) -> None:
        """Begin an element."""
        self._end_tag()
        self._write(f"<{name}")
        self._open.append(name)
        self._is_tag_open = True

    def attribute(self, name: str, value: str) -> bool:
        """Add an attribute; return whether there is an element that takes it."""
        if self._is_tag_open:
            self._write(f" {name}={quoteattr(value)}")
        return self._is_tag_open

    def content(self, text: str, form: str = "") -> None:
        """Write a text, or something in a form such as ``<!--{}-->``.

        Raises:
            StatusError: a text has no place outside of elements.
        """
        if not form and not self._open:
            raise StatusError(xmlERR_INVALID_POSITION)
        self._end_tag()
        self._write(form.format(text) if form else escape(text))

    def end(self) -> None:
        """End the element.

        Raises:
            StatusError: there is none.
        """
        if not self._open:
            raise StatusError(xmlERR_INVALID_POSITION)
        name = self._open.pop()
        if self._is_tag_open:
            self._is_tag_open = False
            self._write("/>")
        else:
            self._write(f"</{name}>")

    def end_document(self) -> None:
        """End all elements."""
        while self._open:
            self.end()
        self._write("\n")
