"""AsXml: documents are read node by node, and written piece by piece."""

import pytest

from plcsim.library.asxml import blocks
from plcsim.library.asxml.interface import (
    xmlERR_INVALID_ATTRIBUTE_INDEX,
    xmlERR_INVALID_IDENT,
    xmlERR_INVALID_PARAMETER,
    xmlERR_INVALID_POSITION,
    xmlERR_MEMORY,
    xmlERR_NAME_BUFFER_TOO_SMALL,
    xmlERR_NO_ATTRIBUTES,
    xmlERR_NO_ELEMENT_OPEN,
    xmlERR_NO_FURTHER_XML_NODE,
    xmlERR_UNSUPPORTED_ENCODING,
    xmlERR_VALUE_BUFFER_TOO_SMALL,
    xmlERR_XML_DATA_INVALID,
    xmlNODE_TYPE_CDATA,
    xmlNODE_TYPE_COMMENT,
    xmlNODE_TYPE_ELEMENT,
    xmlNODE_TYPE_ENDELEMENT,
    xmlNODE_TYPE_PI,
    xmlNODE_TYPE_SIGN_WHITESPACE,
    xmlNODE_TYPE_TEXT,
)
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK

DOCUMENT = """<?xml version="1.0"?><a x="1" y="&lt;2"> <b/><c></c><!--no--><?do it?>\
<d>Türe &amp; Tor<e>in</e></d><![CDATA[<raw>]]></a>"""


@pytest.fixture
def text(plc):
    return lambda value: plc.memory.keep(value.encode() + b"\0")


@pytest.fixture
def reading(plc):
    """``reading(document)``: call it for the next node; its name, its value."""

    class Reading:
        def __init__(self, document):
            data = document.encode()
            made = plc.call(
                blocks.xmlCreateMemoryReader,
                pXmlMemory=plc.memory.keep(data),
                memorySize=len(data),
            )
            assert made.status == ERR_OK
            self.ident = made.ident
            self.places = [plc.memory.keep(bytes(100)) for _ in range(2)]
            self.block = plc.new(blocks.xmlReadNextNode)

        def __call__(self, **inputs):
            name, value = self.places
            sizes = {"nameSize": 100, "valueSize": 100, "forceRead": False, "skipSubtree": False}
            given = {"ident": self.ident, "pName": name, "pValue": value, **sizes, **inputs}
            self.block(enable=True, **given)
            return self.block.status

        @property
        def texts(self):
            return tuple(plc.memory.string(place, 99).decode() for place in self.places)

    return Reading


def test_all_nodes_in_order(reading):
    read = reading(DOCUMENT)
    found = []
    while read() == ERR_OK:
        found.append((read.block.nodeType, read.block.depth, *read.texts))
    assert found == [
        (xmlNODE_TYPE_ELEMENT, 0, "a", ""),
        (xmlNODE_TYPE_SIGN_WHITESPACE, 1, "#text", " "),
        (xmlNODE_TYPE_ELEMENT, 1, "b", ""),
        (xmlNODE_TYPE_ELEMENT, 1, "c", ""),
        (xmlNODE_TYPE_ENDELEMENT, 1, "c", ""),
        (xmlNODE_TYPE_COMMENT, 1, "#comment", "no"),
        (xmlNODE_TYPE_PI, 1, "do", "it"),
        (xmlNODE_TYPE_ELEMENT, 1, "d", ""),
        (xmlNODE_TYPE_TEXT, 2, "#text", "Türe & Tor"),
        (xmlNODE_TYPE_ELEMENT, 2, "e", ""),
        (xmlNODE_TYPE_TEXT, 3, "#text", "in"),
        (xmlNODE_TYPE_ENDELEMENT, 2, "e", ""),
        (xmlNODE_TYPE_ENDELEMENT, 1, "d", ""),
        (xmlNODE_TYPE_CDATA, 1, "#cdata-section", "<raw>"),
        (xmlNODE_TYPE_ENDELEMENT, 0, "a", ""),
    ]
    assert read.block.status == xmlERR_NO_FURTHER_XML_NODE
    assert read() == xmlERR_NO_FURTHER_XML_NODE


def test_attributes_and_empty_elements(plc, reading):
    read = reading(DOCUMENT)
    assert (read(), read.block.attributeCount, read.block.isEmpty) == (ERR_OK, 2, False)
    name, value = read.places
    places = {"pName": name, "nameSize": 100, "pValue": value, "valueSize": 100}
    block = plc.call(blocks.xmlReadAttributeNr, ident=read.ident, index=1, **places)
    assert (block.status, read.texts, block.neededValueSize) == (ERR_OK, ("y", "<2"), 3)
    block(index=2)
    assert block.status == xmlERR_INVALID_ATTRIBUTE_INDEX
    block(index=1, valueSize=2)
    assert block.status == xmlERR_VALUE_BUFFER_TOO_SMALL
    read(), read()
    assert (read.texts[0], read.block.isEmpty) == ("b", True)
    block(index=0)
    assert block.status == xmlERR_NO_ATTRIBUTES


def test_a_node_that_does_not_fit_is_read_once_more(reading):
    read = reading("<root>text</root>")
    assert (read(nameSize=4), read.block.neededNameSize) == (xmlERR_NAME_BUFFER_TOO_SMALL, 5)
    assert (read(), read.texts[0]) == (ERR_OK, "root")
    assert read(valueSize=4) == xmlERR_VALUE_BUFFER_TOO_SMALL
    assert (read(forceRead=True), read.block.nodeType) == (ERR_OK, xmlNODE_TYPE_ENDELEMENT)


def test_what_is_inside_is_left_out(reading):
    read = reading("<a><b><c/>text</b><d/></a>")
    assert (read(), read(), read.texts[0]) == (ERR_OK, ERR_OK, "b")
    assert (read(skipSubtree=True), read.texts[0]) == (ERR_OK, "d")


@pytest.mark.parametrize("document", ["<a><b></a>", "<a>", '<!DOCTYPE a [<!ENTITY x "y">]><a/>'])
def test_a_document_that_is_wrong_ends_at_its_fault(reading, document):
    read = reading(document)
    for _ in range(5):
        status = read()
        if status != ERR_OK:
            break
    assert status == xmlERR_XML_DATA_INVALID


def test_readers_that_are_not_there(plc, reading):
    assert plc.call(blocks.xmlCreateMemoryReader).status == xmlERR_INVALID_PARAMETER
    read = reading("<a/>")
    assert read(ident=77) == xmlERR_INVALID_IDENT
    close = plc.call(blocks.xmlCloseMemoryReader, ident=read.ident)
    assert close.status == ERR_OK
    close()
    assert (close.status, read()) == (xmlERR_INVALID_IDENT, xmlERR_INVALID_IDENT)
    close(enable=False)
    assert close.status == ERR_FUB_ENABLE_FALSE


@pytest.fixture
def write(plc, text):
    """``write("StartElement", "a")``: call a block of a writer with addresses of texts."""
    ident = plc.call(blocks.xmlCreateMemoryWriter).ident

    def write(name, *texts, **inputs):
        view = getattr(blocks, f"xml{name if name.startswith('Close') else 'Write' + name}")
        places = [n for n in ("pTarget", "pName", "pText", "pCData", "pValue") if hasattr(view, n)]
        given = {place: text(value) for place, value in zip(places, texts, strict=False)}
        return plc.call(view, ident=ident, **given, **inputs).status

    write.ident = ident
    return write


def written(plc, write):
    info = plc.call(blocks.xmlGetMemoryInfo, ident=write.ident)
    assert info.status == ERR_OK
    return plc.memory.read(info.pXmlData, info.xmlDataSize + 1)


def test_a_document_is_written(plc, text, write):
    assert write("StartDocument") == ERR_OK
    write("StartElement", "a")
    write("Attribute", "x", '1 & "2"')
    write("ElementText", "Türe <")
    write("StartElement", "b")
    assert write("EndElement") == ERR_OK
    write("ElementTextEx", "abcdef", textLen=2)
    write("Comment", "c")
    write("CData", "<d>")
    write("PI", "do", "it")
    write("StartElement", "e")
    assert write("EndDocument") == ERR_OK
    assert written(plc, write).decode() == (
        '<?xml version="1.0" encoding="UTF-8"?>\n<a x=\'1 &amp; "2"\'>Türe &lt;<b/>ab<!--c-->'
        "<![CDATA[<d>]]><?do it?><e/></a>\n\0"
    )
    assert write("CloseMemoryWriter") == ERR_OK
    assert write("EndElement") == xmlERR_INVALID_IDENT


def test_texts_are_converted(plc, text, write):
    inputs = {"pInputEncoding": text("ISO-8859-1"), "pOutputEncoding": text("UTF-8")}
    assert write("StartDocEnc", **inputs) == ERR_OK
    write("StartElement", "a")
    latin = plc.memory.keep(b"T\xfcr\0")
    plc.call(blocks.xmlWriteElementText, ident=write.ident, pText=latin)
    write("EndDocument")
    assert "<a>Tür</a>" in written(plc, write).decode()


def test_what_has_no_place(plc, text, write):
    assert write("ElementText", "a") == xmlERR_INVALID_POSITION
    assert write("EndElement") == xmlERR_INVALID_POSITION
    assert write("Attribute", "a", "b") == xmlERR_NO_ELEMENT_OPEN
    assert write("StartElement") == xmlERR_INVALID_PARAMETER
    wrong = {"pEncoding": text("KLINGON")}
    assert write("StartDocument", **wrong) == xmlERR_UNSUPPORTED_ENCODING
    write("StartElement", "a")
    assert write("StartDocument") == xmlERR_INVALID_POSITION


def test_there_are_not_too_many(plc):
    for _ in range(blocks.MOST):
        assert plc.call(blocks.xmlCreateMemoryWriter).status == ERR_OK
    assert plc.call(blocks.xmlCreateMemoryWriter).status == xmlERR_MEMORY
