from io import BytesIO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.errors import SourceError
from st_types.syntax import source
from st_types.syntax.source import Location, Source, read_at_most


@pytest.mark.parametrize(
    ("data", "text", "encoding"),
    [
        (b"", "", "utf-8"),
        (b"TYPE", "TYPE", "utf-8"),
        (b"\xef\xbb\xbfTYPE", "TYPE", "utf-8"),
        ("für".encode(), "für", "utf-8"),
        ("für".encode("latin-1"), "für", "latin-1"),
        ("für".encode("utf-16"), "für", "utf-16-le"),
        (b"\xfe\xff\x00A", "A", "utf-16-be"),
    ],
)
def test_decoding(data: bytes, text: str, encoding: str) -> None:
    found = Source.decode("a.typ", data)
    assert (found.text, found.encoding) == (text, encoding)


@pytest.mark.parametrize("size", [0, 5, 64 * 1024, 200_000])
@pytest.mark.parametrize("most", [0, 4, 64 * 1024, 150_000, 1 << 40])
def test_a_file_is_read_up_to_a_number_of_bytes_without_room_for_all(size: int, most: int) -> None:
    assert read_at_most(BytesIO(bytes(size)), most) == bytes(min(size, most))


@given(st.binary())
def test_any_bytes_decode(data: bytes) -> None:
    Source.decode("a.typ", data)


def test_a_file_that_is_too_large_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(source, "MAX_SOURCE_BYTES", 1024 * 1024)
    with pytest.raises(SourceError, match=r"big\.typ:1:1: error: the file is larger than 1 MiB"):
        Source.decode("big.typ", bytes(1024 * 1024 + 1))


def test_reading_names_the_path_as_told(tmp_path) -> None:
    (tmp_path / "A.typ").write_bytes(b"TYPE END_TYPE")
    assert Source.read(tmp_path / "A.typ", "A.typ").location(0) == Location("A.typ", 1, 1)
    assert Source.read(tmp_path / "A.typ").path == str(tmp_path / "A.typ")


@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_lines_and_columns(line_end: str) -> None:
    found = Source("a", f"ab{line_end}{line_end}cd")
    assert found.line_count == 3
    assert found.location(1) == ("a", 1, 2)
    assert found.location(found.text.index("d")) == ("a", 3, 2)
    assert found.location(len(found.text)) == ("a", 3, 3)
    assert [found.line_text(line) for line in (1, 2, 3)] == ["ab", "", "cd"]


def test_a_last_line_end_starts_no_line() -> None:
    assert Source("a", "x\ny\n").line_count == 2
    assert Source("a", "x\ny\n").location(4) == ("a", 3, 1)


def test_a_location_reads_as_compilers_write_it() -> None:
    assert str(Location("Types.typ", 3, 14)) == "Types.typ:3:14"
