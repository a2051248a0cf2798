"""Strings that are not UTF-8, kept byte for byte.

ROS says that strings are UTF-8, yet roscpp sends any bytes of a std::string. Such a byte stands in
our text as a surrogate from U+DC80 to U+DCFF (Python's ``surrogateescape``, PEP 383), so a text
that came can be sent on as it was.
"""

from __future__ import annotations

from typing import Final

ESCAPE: Final = "surrogateescape"


def bytes_of(text: str) -> bytes:
    """Return the bytes that a text stands for, UTF-8 or not.

    Raises:
        UnicodeEncodeError: a surrogate that stands for no byte.
    """
    return text.encode(errors=ESCAPE)


def is_utf8(text: str) -> bool:
    """Return whether UTF-8 can hold a text."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def to_latin1(text: str) -> str:
    """Return a text as a STRING can hold it, one byte a character.

    Other characters become ``?``. Of a text that is not UTF-8 each byte becomes a character.
    """
    if is_utf8(text):
        return text.encode("latin-1", "replace").decode("latin-1")
    return bytes_of(text).decode("latin-1")
