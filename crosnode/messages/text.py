"""Strings that are not UTF-8, kept byte for byte.

ROS says that strings are UTF-8, yet roscpp sends any bytes of a std::string. Such a byte stands in
our text as a surrogate from U+DC80 to U+DCFF (Python's ``surrogateescape``, PEP 383), so a text
that came can be sent on as it was. rosbags' compiled code knows UTF-8 alone; it is tried first, and
where it fails once more with values whose own ``encode`` and ``decode`` know the escapes.
"""

from __future__ import annotations

from copy import copy
from dataclasses import fields, is_dataclass
from typing import Any, Final

ESCAPE: Final = "surrogateescape"


class EscapedText(str):
    """A text that is encoded to the bytes it came from by rosbags' plain ``encode()``."""

    __slots__ = ()

    def encode(self, encoding: str = "utf-8", errors: str = ESCAPE) -> bytes:
        """Return the bytes; raises UnicodeEncodeError for surrogates that stand for no byte."""
        return super().encode(encoding, errors)


class EscapedBytes(bytes):
    """Received bytes whose slices rosbags' plain ``bytes(...).decode()`` makes such texts of."""

    __slots__ = ()

    def __bytes__(self) -> bytes:
        return self

    def __getitem__(self, place: Any) -> Any:
        found = super().__getitem__(place)
        return EscapedBytes(found) if isinstance(place, slice) else found

    def decode(self, encoding: str = "utf-8", errors: str = ESCAPE) -> str:
        """Return the text; no bytes are refused."""
        return super().decode(encoding, errors)


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


def escaped(value: Any) -> Any:
    """Return a copy of a message, at all levels, whose texts are ``EscapedText``."""
    if isinstance(value, str):
        return EscapedText(value)
    if isinstance(value, (list, tuple)):
        return [escaped(element) for element in value]
    if not is_dataclass(value):
        return value
    result = copy(value)
    for field in fields(value):
        setattr(result, field.name, escaped(getattr(value, field.name)))
    return result
