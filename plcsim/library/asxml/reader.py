"""The nodes of a document, in order."""

from __future__ import annotations

from typing import NamedTuple
from xml.parsers import expat

from plcsim.library.asxml.interface import (
    xmlNODE_TYPE_CDATA,
    xmlNODE_TYPE_COMMENT,
    xmlNODE_TYPE_ELEMENT,
    xmlNODE_TYPE_ENDELEMENT,
    xmlNODE_TYPE_PI,
    xmlNODE_TYPE_SIGN_WHITESPACE,
    xmlNODE_TYPE_TEXT,
)


class XmlNode(NamedTuple):
    """A node: names and values are UTF-8.

    Attributes:
        kind: xmlNODE_TYPE_...
        depth: 0 for the root.
        name: of an element; as XPath has it for others, such as ``#text``.
        value: of what is no element.
        attributes: of an element.
        is_empty: it is an element without an end of its own.
    """

    kind: int
    depth: int
    name: bytes
    value: bytes = b""
    attributes: tuple[tuple[bytes, bytes], ...] = ()
    is_empty: bool = False


class XmlNodes:
    """The nodes of a document.

    Args:
        data: the document.

    Attributes:
        nodes: in order, those before a fault where it has one.
        is_broken: it has one.
    """

    def __init__(self, data: bytes) -> None:
        self.nodes: list[XmlNode] = []
        self._depth = 0
        self._data = data
        self._in_cdata = False
        self._parser = parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.ordered_attributes = True
        parser.StartElementHandler = self._begin
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.CommentHandler = self._comment
        parser.ProcessingInstructionHandler = self._instruction
        parser.StartCdataSectionHandler = lambda: self._cdata(begins=True)
        parser.EndCdataSectionHandler = lambda: self._cdata(begins=False)
        parser.StartDoctypeDeclHandler = self._doctype
        self.is_broken = False
        try:
            parser.Parse(data, True)  # noqa: FBT003  # expat takes no names
        except (expat.ExpatError, LookupError, ValueError):
            self.is_broken = True

    def _add(self, kind: int, name: str, value: str = "") -> None:
        node = XmlNode(kind, self._depth, name.encode(), value.encode("utf-8", "replace"))
        self.nodes.append(node)

    def _begin(self, name: str, attributes: list[str]) -> None:
        pairs = zip(attributes[::2], attributes[1::2], strict=True)
        encoded = tuple((key.encode(), value.encode()) for key, value in pairs)
        self.nodes.append(
            XmlNode(xmlNODE_TYPE_ELEMENT, self._depth, name.encode(), attributes=encoded)
        )
        self._depth += 1

    def _end(self, name: str) -> None:
        self._depth -= 1
        last, place = self.nodes[-1], self._parser.CurrentByteIndex
        is_own = last.kind == xmlNODE_TYPE_ELEMENT and not last.is_empty
        if is_own and self._data[place - 2 : place] == b"/>":
            self.nodes[-1] = last._replace(is_empty=True)
        else:
            self._add(xmlNODE_TYPE_ENDELEMENT, name)

    def _text(self, text: str) -> None:
        if self._in_cdata:
            self._add(xmlNODE_TYPE_CDATA, "#cdata-section", text)
        elif text.strip():
            self._add(xmlNODE_TYPE_TEXT, "#text", text)
        else:
            self._add(xmlNODE_TYPE_SIGN_WHITESPACE, "#text", text)

    def _comment(self, text: str) -> None:
        self._add(xmlNODE_TYPE_COMMENT, "#comment", text)

    def _instruction(self, target: str, text: str) -> None:
        self._add(xmlNODE_TYPE_PI, target, text)

    def _cdata(self, *, begins: bool) -> None:
        self._in_cdata = begins

    def _doctype(self, *_parts: object) -> None:
        raise ValueError("a document type has no place here")


class XmlReader:
    """A reader.

    Args:
        data: the document.

    Attributes:
        current: the node that was read last, None before the first.
        is_pending: it did not fit, and is read once more.
    """

    def __init__(self, data: bytes) -> None:
        self._document = XmlNodes(data)
        self._next = 0
        self.current: XmlNode | None = None
        self.is_pending = False

    @property
    def is_broken(self) -> bool:
        """Whether the document ends with a fault."""
        return self._document.is_broken

    def advance(self, *, skip: bool) -> XmlNode | None:
        """Go to the next node; None at the end.

        Args:
            skip: leave out what is inside the last node, and its end.
        """
        nodes, last = self._document.nodes, self.current
        if skip and last is not None and last.kind == xmlNODE_TYPE_ELEMENT and not last.is_empty:
            while self._next < len(nodes) and nodes[self._next].depth > last.depth:
                self._next += 1
            self._next += 1
        self.current = nodes[self._next] if self._next < len(nodes) else None
        self._next += 1
        return self.current
