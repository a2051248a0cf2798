"""The blocks of AsXml; each is done in its call."""

# ruff: noqa: N801  # the library names them so

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.library.asxml import interface
from plcsim.library.asxml.interface import (
    xmlERR_INVALID_ATTRIBUTE_INDEX,
    xmlERR_INVALID_IDENT,
    xmlERR_INVALID_PARAMETER,
    xmlERR_MEMORY,
    xmlERR_NAME_BUFFER_TOO_SMALL,
    xmlERR_NO_ATTRIBUTES,
    xmlERR_NO_ELEMENT_OPEN,
    xmlERR_NO_FURTHER_XML_NODE,
    xmlERR_UNSUPPORTED_ENCODING,
    xmlERR_VALUE_BUFFER_TOO_SMALL,
    xmlERR_XML_DATA_INVALID,
)
from plcsim.library.asxml.reader import XmlReader
from plcsim.library.asxml.writer import LARGEST, XmlWriter
from plcsim.library.block import ActingBlock, StatusError
from plcsim.library.heap import heap_of
from plcsim.library.idents import Idents

if TYPE_CHECKING:
    from plcsim.core.context import Context

MOST: Final = 64
"""Readers and writers at a time, together."""


class XmlDocuments(Idents[Any]):
    """The readers and writers of a controller."""

    def __init__(self, context: Context) -> None:
        super().__init__(context, MOST)


class XmlBlock(ActingBlock):
    """Base of the blocks.

    Status of all: xmlERR_INVALID_IDENT, xmlERR_INVALID_PARAMETER (an address is 0).
    """

    __slots__ = ()

    ident: int

    @property
    def documents(self) -> XmlDocuments:
        """The readers and writers of the controller."""
        return self.context.library(XmlDocuments)

    def add(self, made: XmlReader | XmlWriter) -> int:
        """Return a new ident.

        Raises:
            StatusError: there are too many.
        """
        if self.documents.full:
            raise StatusError(xmlERR_MEMORY)
        return self.documents.add(made)

    @property
    def reader(self) -> XmlReader:
        """The reader of the ident."""
        found = self.documents.find(self.ident)
        if not isinstance(found, XmlReader):
            raise StatusError(xmlERR_INVALID_IDENT)
        return found

    @property
    def writer(self) -> XmlWriter:
        """The writer of the ident."""
        found = self.documents.find(self.ident)
        if not isinstance(found, XmlWriter):
            raise StatusError(xmlERR_INVALID_IDENT)
        if found.is_full:
            raise StatusError(xmlERR_MEMORY)
        return found

    def text(self, address: int, length: int | None = None) -> str:
        """Return a text for the writer; it ends at its NUL, or after a length."""
        if not address:
            raise StatusError(xmlERR_INVALID_PARAMETER)
        if length is None:
            return self.writer.text(self.context.memory.string(address, LARGEST))
        return self.writer.text(self.context.memory.read(address, min(length, LARGEST)))

    def give(self, places: tuple[int, int, int, int], name: bytes, value: bytes) -> None:
        """Store a name and a value; 0 for an address is nowhere.

        Args:
            places: address and bytes for the name, then for the value.
            name: of a node or an attribute.
            value: likewise.
        """
        p_name, name_size, p_value, value_size = places
        if p_name and name_size <= len(name):
            raise StatusError(xmlERR_NAME_BUFFER_TOO_SMALL)
        if p_value and value_size <= len(value):
            raise StatusError(xmlERR_VALUE_BUFFER_TOO_SMALL)
        for address, data in ((p_name, name), (p_value, value)):
            if address:
                self.context.memory.write(address, data + b"\0")


class xmlCreateMemoryReader(interface.xmlCreateMemoryReader, XmlBlock):
    """Make a reader of a copy of the document. What is wrong in it shows when it is read."""

    def act(self) -> None:
        """Make it."""
        self.ident = 0
        if not self.pXmlMemory or not self.memorySize:
            raise StatusError(xmlERR_INVALID_PARAMETER)
        if self.memorySize > LARGEST:
            raise StatusError(xmlERR_MEMORY)
        data = self.context.memory.read(self.pXmlMemory, self.memorySize)
        self.ident = self.add(XmlReader(data.rstrip(b"\0")))


class xmlCloseMemoryReader(interface.xmlCloseMemoryReader, XmlBlock):
    """End a reader."""

    def act(self) -> None:
        """End it."""
        if not isinstance(self.documents.find(self.ident), XmlReader):
            raise StatusError(xmlERR_INVALID_IDENT)
        self.documents.remove(self.ident)


class xmlReadNextNode(interface.xmlReadNextNode, XmlBlock):
    """Read the next node, or once more the one that did not fit, unless forceRead goes on.

    Status: xmlERR_NO_FURTHER_XML_NODE, xmlERR_XML_DATA_INVALID at the fault of a document,
    xmlERR_NAME_BUFFER_TOO_SMALL, xmlERR_VALUE_BUFFER_TOO_SMALL.
    """

    def act(self) -> None:
        """Read it."""
        reader = self.reader
        again = reader.is_pending and not self.forceRead
        node = reader.current if again else reader.advance(skip=self.skipSubtree)
        reader.is_pending = False
        self.nodeType = self.attributeCount = self.neededNameSize = self.neededValueSize = 0
        if node is None:
            broken, end = xmlERR_XML_DATA_INVALID, xmlERR_NO_FURTHER_XML_NODE
            raise StatusError(broken if reader.is_broken else end)
        self.nodeType, self.depth, self.isEmpty = node.kind, node.depth, node.is_empty
        self.attributeCount = len(node.attributes)
        self.neededNameSize, self.neededValueSize = len(node.name) + 1, len(node.value) + 1
        reader.is_pending = True
        places = self.pName, self.nameSize, self.pValue, self.valueSize
        self.give(places, node.name, node.value)
        reader.is_pending = False


class xmlReadAttributeNr(interface.xmlReadAttributeNr, XmlBlock):
    """Read an attribute of the node that was read last.

    Status: xmlERR_NO_ATTRIBUTES, xmlERR_INVALID_ATTRIBUTE_INDEX, and where it does not fit.
    """

    def act(self) -> None:
        """Read it."""
        node = self.reader.current
        if node is None or not node.attributes:
            raise StatusError(xmlERR_NO_ATTRIBUTES)
        if self.index >= len(node.attributes):
            raise StatusError(xmlERR_INVALID_ATTRIBUTE_INDEX)
        name, value = node.attributes[self.index]
        self.neededNameSize, self.neededValueSize = len(name) + 1, len(value) + 1
        self.give((self.pName, self.nameSize, self.pValue, self.valueSize), name, value)


class xmlCreateMemoryWriter(interface.xmlCreateMemoryWriter, XmlBlock):
    """Make a writer."""

    def act(self) -> None:
        """Make it."""
        self.ident = 0
        self.ident = self.add(XmlWriter())


class xmlGetMemoryInfo(interface.xmlGetMemoryInfo, XmlBlock):
    """Put the document on the heap; it lies there until the next time, or until the end."""

    def act(self) -> None:
        """Put it there."""
        writer, heap = self.writer, heap_of(self.context)
        heap.release(writer.address)
        data = writer.data
        writer.address = heap.allocate(len(data) + 1) or 0
        if not writer.address:
            raise StatusError(xmlERR_MEMORY)
        self.context.memory.write(writer.address, data + b"\0")
        self.pXmlData, self.xmlDataSize = writer.address, len(data)


class xmlCloseMemoryWriter(interface.xmlCloseMemoryWriter, XmlBlock):
    """End a writer, and give its memory back."""

    def act(self) -> None:
        """End it."""
        found = self.documents.find(self.ident)
        if not isinstance(found, XmlWriter):
            raise StatusError(xmlERR_INVALID_IDENT)
        heap_of(self.context).release(found.address)
        self.documents.remove(self.ident)


class _Declaration(XmlBlock):
    """What begins a document. Status: xmlERR_UNSUPPORTED_ENCODING, xmlERR_INVALID_POSITION."""

    __slots__ = ()

    pVersion: int  # noqa: N815  # as the library names it
    pStandalone: int  # noqa: N815  # likewise

    def declare(self, p_input: int, p_output: int) -> None:
        """Write it."""
        writer = self.writer
        version = self.text(self.pVersion) if self.pVersion else "1.0"
        standalone = self.text(self.pStandalone) if self.pStandalone else ""
        output = self.text(p_output) if p_output else "UTF-8"
        given = self.text(p_input) if p_input else output
        try:
            writer.declare(version, (given, output), standalone)
        except LookupError:
            raise StatusError(xmlERR_UNSUPPORTED_ENCODING) from None


class xmlWriteStartDocument(interface.xmlWriteStartDocument, _Declaration):
    """Write the declaration; texts have the encoding of the document."""

    def act(self) -> None:
        """Write it."""
        self.declare(0, self.pEncoding)


class xmlWriteStartDocEnc(interface.xmlWriteStartDocEnc, _Declaration):
    """Write the declaration; texts have an encoding of their own."""

    def act(self) -> None:
        """Write it."""
        self.declare(self.pInputEncoding, self.pOutputEncoding)


class xmlWriteEndDocument(interface.xmlWriteEndDocument, XmlBlock):
    """End all elements."""

    def act(self) -> None:
        """End them."""
        self.writer.end_document()


class xmlWriteStartElement(interface.xmlWriteStartElement, XmlBlock):
    """Begin an element."""

    def act(self) -> None:
        """Begin it."""
        self.writer.begin(self.text(self.pName))


class xmlWriteAttribute(interface.xmlWriteAttribute, XmlBlock):
    """Add an attribute to the element that was begun last. Status: xmlERR_NO_ELEMENT_OPEN."""

    def act(self) -> None:
        """Add it."""
        if not self.writer.attribute(self.text(self.pName), self.text(self.pValue)):
            raise StatusError(xmlERR_NO_ELEMENT_OPEN)


class xmlWriteEndElement(interface.xmlWriteEndElement, XmlBlock):
    """End the element. Status: xmlERR_INVALID_POSITION."""

    def act(self) -> None:
        """End it."""
        self.writer.end()


class xmlWriteElementText(interface.xmlWriteElementText, XmlBlock):
    """Write a text into the element. Status: xmlERR_INVALID_POSITION."""

    def act(self) -> None:
        """Write it."""
        self.writer.content(self.text(self.pText))


class xmlWriteElementTextEx(interface.xmlWriteElementTextEx, XmlBlock):
    """Likewise, of a length."""

    def act(self) -> None:
        """Write it."""
        self.writer.content(self.text(self.pText, self.textLen))


class xmlWriteComment(interface.xmlWriteComment, XmlBlock):
    """Write a comment."""

    def act(self) -> None:
        """Write it."""
        self.writer.content(self.text(self.pText), "<!--{}-->")


class xmlWriteCommentEx(interface.xmlWriteCommentEx, XmlBlock):
    """Likewise, of a length."""

    def act(self) -> None:
        """Write it."""
        self.writer.content(self.text(self.pText, self.textLen), "<!--{}-->")


class xmlWriteCData(interface.xmlWriteCData, XmlBlock):
    """Write a CDATA section."""

    def act(self) -> None:
        """Write it."""
        self.writer.content(self.text(self.pCData), "<![CDATA[{}]]>")


class xmlWriteCDataEx(interface.xmlWriteCDataEx, XmlBlock):
    """Likewise, of a length."""

    def act(self) -> None:
        """Write it."""
        self.writer.content(self.text(self.pCData, self.cdataLen), "<![CDATA[{}]]>")


class xmlWritePI(interface.xmlWritePI, XmlBlock):
    """Write a processing instruction."""

    def act(self) -> None:
        """Write it."""
        self.writer.content(f"{self.text(self.pTarget)} {self.text(self.pValue)}", "<?{}?>")
