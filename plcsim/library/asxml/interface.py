"""Library AsXml as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

__all__ = [
    "xmlERR_CONVERT",
    "xmlERR_CONVERT_TEXT",
    "xmlERR_GENERAL",
    "xmlERR_INVALID_ATTRIBUTE_INDEX",
    "xmlERR_INVALID_IDENT",
    "xmlERR_INVALID_PARAMETER",
    "xmlERR_INVALID_POSITION",
    "xmlERR_MEMORY",
    "xmlERR_NAME_BUFFER_TOO_SMALL",
    "xmlERR_NO_ATTRIBUTES",
    "xmlERR_NO_ELEMENT_OPEN",
    "xmlERR_NO_FURTHER_XML_NODE",
    "xmlERR_UNSUPPORTED_ENCODING",
    "xmlERR_VALUE_BUFFER_TOO_SMALL",
    "xmlERR_XML_DATA_INVALID",
    "xmlNODE_TYPE_CDATA",
    "xmlNODE_TYPE_COMMENT",
    "xmlNODE_TYPE_ELEMENT",
    "xmlNODE_TYPE_ENDELEMENT",
    "xmlNODE_TYPE_PI",
    "xmlNODE_TYPE_SIGN_WHITESPACE",
    "xmlNODE_TYPE_TEXT",
    "xmlNODE_TYPE_WHITESPACE",
]

_DECLARED = declared_beside(__name__)

xmlERR_MEMORY: Final = 33810

xmlERR_INVALID_PARAMETER: Final = 33811

xmlERR_GENERAL: Final = 33812

xmlERR_NO_FURTHER_XML_NODE: Final = 33813

xmlERR_NAME_BUFFER_TOO_SMALL: Final = 33814

xmlERR_VALUE_BUFFER_TOO_SMALL: Final = 33815

xmlERR_INVALID_ATTRIBUTE_INDEX: Final = 33816

xmlERR_NO_ATTRIBUTES: Final = 33817

xmlERR_XML_DATA_INVALID: Final = 33818

xmlERR_INVALID_IDENT: Final = 33819

xmlERR_NO_ELEMENT_OPEN: Final = 33820

xmlERR_INVALID_POSITION: Final = 33821

xmlERR_CONVERT: Final = 33822

xmlERR_CONVERT_TEXT: Final = 33823

xmlERR_UNSUPPORTED_ENCODING: Final = 33824

xmlNODE_TYPE_ELEMENT: Final = 1

xmlNODE_TYPE_TEXT: Final = 3

xmlNODE_TYPE_CDATA: Final = 4

xmlNODE_TYPE_PI: Final = 7

xmlNODE_TYPE_COMMENT: Final = 8

xmlNODE_TYPE_WHITESPACE: Final = 13

xmlNODE_TYPE_SIGN_WHITESPACE: Final = 14

xmlNODE_TYPE_ENDELEMENT: Final = 15


class xmlCreateMemoryReader(FunctionBlock):
    """Makes a reader."""

    _plc_type = _DECLARED["xmlCreateMemoryReader"]

    enable: bool
    """Run the block."""

    pXmlMemory: int
    """Address of the XML."""

    memorySize: int
    """Bytes of it."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """Of the reader or writer."""


class xmlCloseMemoryReader(FunctionBlock):
    """Ends a reader."""

    _plc_type = _DECLARED["xmlCloseMemoryReader"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlReadNextNode(FunctionBlock):
    """Reads the next node."""

    _plc_type = _DECLARED["xmlReadNextNode"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    forceRead: bool
    """Go on, though the last node did not fit."""

    skipSubtree: bool
    """Leave out what is inside the last node."""

    pName: int
    """Where its name goes."""

    nameSize: int
    """Bytes there are for it."""

    pValue: int
    """Where its value goes."""

    valueSize: int
    """Bytes there are for it."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""

    nodeType: int
    """XmlNODE_TYPE_."""

    depth: int
    """0 for the root."""

    isEmpty: bool
    """An element without an end of its own."""

    attributeCount: int

    neededNameSize: int

    neededValueSize: int


class xmlReadAttributeNr(FunctionBlock):
    """Reads an attribute of the node."""

    _plc_type = _DECLARED["xmlReadAttributeNr"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    index: int
    """From 0 on."""

    pName: int
    """Where its name goes."""

    nameSize: int
    """Bytes there are for it."""

    pValue: int
    """Where its value goes."""

    valueSize: int
    """Bytes there are for it."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""

    neededNameSize: int

    neededValueSize: int


class xmlCreateMemoryWriter(FunctionBlock):
    """Makes a writer."""

    _plc_type = _DECLARED["xmlCreateMemoryWriter"]

    enable: bool
    """Run the block."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """Of the reader or writer."""


class xmlGetMemoryInfo(FunctionBlock):
    """Where the XML lies that was written."""

    _plc_type = _DECLARED["xmlGetMemoryInfo"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""

    pXmlData: int
    """Its address."""

    xmlDataSize: int
    """Bytes of it."""


class xmlCloseMemoryWriter(FunctionBlock):
    """Ends a writer."""

    _plc_type = _DECLARED["xmlCloseMemoryWriter"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteStartDocument(FunctionBlock):
    """Writes the declaration."""

    _plc_type = _DECLARED["xmlWriteStartDocument"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pVersion: int
    """Address, 0 for 1.0."""

    pEncoding: int
    """Address, 0 for UTF-8."""

    pStandalone: int
    """Address, 0 for none."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteStartDocEnc(FunctionBlock):
    """Writes the declaration; texts are converted."""

    _plc_type = _DECLARED["xmlWriteStartDocEnc"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pVersion: int
    """Address, 0 for 1.0."""

    pInputEncoding: int
    """Of the texts."""

    pOutputEncoding: int
    """Of the XML."""

    pStandalone: int
    """Address, 0 for none."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteEndDocument(FunctionBlock):
    """Ends all elements."""

    _plc_type = _DECLARED["xmlWriteEndDocument"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteStartElement(FunctionBlock):
    """Begins an element."""

    _plc_type = _DECLARED["xmlWriteStartElement"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pName: int
    """Address of its name."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteAttribute(FunctionBlock):
    """Adds an attribute."""

    _plc_type = _DECLARED["xmlWriteAttribute"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pName: int
    """Address of its name."""

    pValue: int
    """Address of its value."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteElementText(FunctionBlock):
    """Writes a text."""

    _plc_type = _DECLARED["xmlWriteElementText"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pText: int
    """Address of it."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteElementTextEx(FunctionBlock):
    """Writes a text of a length."""

    _plc_type = _DECLARED["xmlWriteElementTextEx"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pText: int
    """Address of it."""

    textLen: int
    """Bytes."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteEndElement(FunctionBlock):
    """Ends the element."""

    _plc_type = _DECLARED["xmlWriteEndElement"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteComment(FunctionBlock):
    """Writes a comment."""

    _plc_type = _DECLARED["xmlWriteComment"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pText: int
    """Address of it."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteCommentEx(FunctionBlock):
    """Writes a comment of a length."""

    _plc_type = _DECLARED["xmlWriteCommentEx"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pText: int
    """Address of it."""

    textLen: int
    """Bytes."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteCData(FunctionBlock):
    """Writes a CDATA section."""

    _plc_type = _DECLARED["xmlWriteCData"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pCData: int
    """Address of it."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWriteCDataEx(FunctionBlock):
    """Writes a CDATA section of a length."""

    _plc_type = _DECLARED["xmlWriteCDataEx"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pCData: int
    """Address of it."""

    cdataLen: int
    """Bytes."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""


class xmlWritePI(FunctionBlock):
    """Writes a processing instruction."""

    _plc_type = _DECLARED["xmlWritePI"]

    enable: bool
    """Run the block."""

    ident: int
    """Of the reader or writer."""

    pTarget: int
    """Address of its target."""

    pValue: int
    """Address of its value."""

    status: int
    """0, ERR_FUB_ENABLE_FALSE or an error."""
