"""Texts of any bytes, and back."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.messages.text import ESCAPE, bytes_of, is_utf8, to_latin1


@given(st.binary())
def test_any_bytes_come_back(data: bytes) -> None:
    text = data.decode(errors=ESCAPE)
    assert bytes_of(text) == data
    assert is_utf8(text) == (text.encode(errors="replace") == data)


def test_a_surrogate_that_stands_for_no_byte_is_refused() -> None:
    assert not is_utf8("\ud800")
    with pytest.raises(UnicodeEncodeError):
        bytes_of("\ud800")


@pytest.mark.parametrize(
    ("data", "text"),
    [(b"gr\xc3\xbc\xc3\x9f", "grüß"), (b"gr\xfc\xdf", "grüß"), ("€ 5".encode(), "? 5"), (b"", "")],
)
def test_what_a_string_of_the_controller_holds(data: bytes, text: str) -> None:
    assert to_latin1(data.decode(errors="surrogateescape")) == text
