import pytest

from plcsim.library import document
from plcsim.library.document import DocumentError, parse, read_document

TEXT = """\ufeff<?xml version="1.0" encoding="utf-8"?>
<?AutomationStudio Version=4.1.17.113 SP?>
<a xmlns="http://br-automation.co.at/AS/Package">
  <b Name="x" Private="TRUE">one<c/>lost</b>
  <c><b>two</b></c>
</a>"""


def test_elements_know_their_lines_attributes_and_texts():
    root = parse(TEXT.encode())
    assert (root.tag, root.line) == ("a", 3)
    assert [(each.tag, each.text, each.line) for each in root.all("b")] == [
        ("b", "one", 4),
        ("b", "two", 5),
    ]
    first = root.children[0]
    assert (first.get("Name"), first.get("none", "?"), first.is_true("Private")) == ("x", "?", True)


@pytest.mark.parametrize(
    ("data", "message", "line"),
    [
        (b"", "it is no XML: no element found", 1),
        (b"<a>\n<b>\n</a>", "it is no XML: mismatched tag", 3),
        (b'<?xml version="1.0" encoding="nonsense"?><a/>', "it is no XML: ", 1),
        (b'\n<!DOCTYPE a [<!ENTITY b "c">]>\n<a>&b;</a>', "a document type (a) has no place", 2),
        (b"<a>\n" * 200 + b"</a>" * 200, "elements are nested deeper than 100", 101),
        (b"<a>\xff\0</a>", "it is no XML: not well-formed", 1),
    ],
)
def test_what_is_no_such_document(data, message, line):
    with pytest.raises(DocumentError) as raised:
        parse(data)
    assert str(raised.value).startswith(message)
    assert raised.value.line == line


@pytest.mark.parametrize(
    ("declared", "encoding"),
    [
        *(("utf-16", "utf-16"), ("utf-8", "utf-16"), ("windows-1252", "cp1252")),
        *(("utf-8", "cp1252"), ("utf-8", "utf-8"), ("utf-8", "utf-8-sig"), ("", "cp1252")),
    ],
)
def test_texts_are_read_in_the_encoding_that_they_have(declared, encoding):
    head = f'<?xml version="1.0" encoding="{declared}"?>\n' if declared else "\n"
    root = parse(f"{head}<a Name='F\xfcller'>gro\xdf</a>".encode(encoding))
    assert (root.get("Name"), root.text, root.line) == ("F\xfcller", "gro\xdf", 2)


def test_a_file_that_cannot_be_read(tmp_path, monkeypatch):
    with pytest.raises(DocumentError, match="No such file"):
        read_document(tmp_path / "gone.pkg")
    (tmp_path / "large.pkg").write_text("<a/>" + " " * 100)
    monkeypatch.setattr(document, "MAX_BYTES", 50)
    with pytest.raises(DocumentError, match="it is larger than"):
        read_document(tmp_path / "large.pkg")


def test_an_element_knows_how_many_bytes_are_before_it():
    data = "<a>\u00e9\n <b x='\u00e9'/></a>".encode()
    root = parse(data, "UTF-8")
    assert data[root.children[0].offset :].startswith(b"<b ")


def test_an_encoding_that_is_known_overrides_what_a_text_declares():
    text = '<?xml version="1.0" encoding="windows-1252"?><a n="\u00e9"/>'
    assert parse(text.encode(), "UTF-8").get("n") == "\u00e9"
