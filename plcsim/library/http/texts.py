"""The blocks of AsHttp that convert texts: base64, URLs and UTF-8.

A text is written with its terminator, and nothing is where it has no room. What no document says is
ours: in URLs all but letters, digits and ``-._~`` is encoded; code pages are Latin-1, whatever the
mapping table.
"""

from __future__ import annotations

import binascii
from base64 import b64decode, b64encode
from typing import TYPE_CHECKING, ClassVar, Final
from urllib.parse import quote_from_bytes, unquote_to_bytes

from plcsim.library.block import StatusError
from plcsim.library.http.statuses import (
    BUFFER_SIZE,
    ILLEGAL_CHARACTERS,
    INVALID_PARAM,
    NOT_FOUND,
)
from plcsim.library.runtime import ERR_OK
from plcsim.library.status_block import StatusBlock

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.memory import Memory
    from plcsim.library.members import BlockVariables

LONGEST: Final = 0x10_0000
"""Bytes of a text that are read."""

LONGEST_WIDE: Final = 0x1_0000
"""Likewise of a WSTRING."""


class _Conversion(StatusBlock):
    """A block that makes one text of another.

    Attributes:
        source: the input with the address of the one.
        result: names of the address, the size and the length of the other.
        terminator: of the other.
        needs_terminator: whether it has to have room.
    """

    source: ClassVar[str] = "pSrc"
    result: ClassVar[tuple[str, str, str]] = ("pDest", "destSize", "destLen")
    terminator: ClassVar[bytes] = b"\0"
    needs_terminator: ClassVar[bool] = True

    def step(self, variables: BlockVariables) -> int:
        """Convert."""
        target, size, length = self.result
        if not (variables.address(self.source) and variables.address(target)):
            return INVALID_PARAM
        try:
            data = self.convert(self.given(variables), variables)
        except StatusError as refused:
            variables.set(**{length: 0})
            return refused.status
        room = int(variables.number(size))
        if len(data) + len(self.terminator) * self.needs_terminator > room:
            variables.set(**{length: 0})
            return BUFFER_SIZE
        written = (data + self.terminator)[:room]
        self.context.memory.write(variables.address(target), written)
        variables.set(**{length: len(data) // len(self.terminator)})
        return ERR_OK

    def given(self, variables: BlockVariables) -> bytes:
        """Return the text that is to be converted."""
        return self.text(variables.address(self.source))

    def text(self, address: int) -> bytes:
        """Return the text at an address.

        Raises:
            PageFault: the address is wild.
        """
        return self.context.memory.string(address, LONGEST)

    def convert(self, data: bytes, variables: BlockVariables) -> bytes:
        """Return the other text.

        Raises:
            StatusError: there is none.
        """
        raise NotImplementedError(type(self).__name__)


class EncodeBase64(_Conversion):
    """httpEncodeBase64."""

    def given(self, variables: BlockVariables) -> bytes:
        """Return srcLen bytes."""
        return _bytes_of(self.context.memory, variables)

    def convert(self, data: bytes, _variables: BlockVariables) -> bytes:
        """Encode."""
        return b64encode(data)


class DecodeBase64(_Conversion):
    """httpDecodeBase64: what it decodes may be no text."""

    needs_terminator: ClassVar[bool] = False

    def given(self, variables: BlockVariables) -> bytes:
        """Return srcLen bytes."""
        return _bytes_of(self.context.memory, variables)

    def convert(self, data: bytes, _variables: BlockVariables) -> bytes:
        """Decode."""
        try:
            return b64decode(data, validate=True)
        except binascii.Error:
            raise StatusError(ILLEGAL_CHARACTERS) from None


def _bytes_of(memory: Memory, variables: BlockVariables) -> bytes:
    size = min(int(variables.number("srcLen")), LONGEST)
    return memory.read(variables.address("pSrc"), size)


class EncodeUrl(_Conversion):
    """httpEncodeUrl."""

    def convert(self, data: bytes, _variables: BlockVariables) -> bytes:
        """Encode."""
        return quote_from_bytes(data, safe="").encode()


class DecodeUrl(_Conversion):
    """httpDecodeUrl: a plus is a space."""

    def convert(self, data: bytes, _variables: BlockVariables) -> bytes:
        """Decode."""
        return _decoded(data)


def _decoded(data: bytes) -> bytes:
    return unquote_to_bytes(data.replace(b"+", b" "))


class GetParameter(_Conversion):
    """httpGetParamUrl: the value behind ``name=`` in a URL, or in the data of a form."""

    result: ClassVar[tuple[str, str, str]] = ("pValue", "valueSize", "valueLen")

    def convert(self, data: bytes, variables: BlockVariables) -> bytes:
        """Find it."""
        if not variables.address("pParam"):
            raise StatusError(INVALID_PARAM)
        wanted = self.text(variables.address("pParam"))
        for part in data.rpartition(b"?")[2].split(b"&"):
            name, equals, value = part.partition(b"=")
            if equals and _decoded(name) == wanted:
                return _decoded(value)
        raise StatusError(NOT_FOUND)


class SetParameter(_Conversion):
    """httpSetParamUrl: adds ``name=value`` to the text at pDest."""

    source: ClassVar[str] = "pParam"

    def convert(self, data: bytes, variables: BlockVariables) -> bytes:
        """Add it, behind ``?`` or ``&`` unless it is the first of a form."""
        if not variables.address("pValue"):
            raise StatusError(INVALID_PARAM)
        before = self.text(variables.address("pDest"))
        value = quote_from_bytes(self.text(variables.address("pValue")), safe="").encode()
        between = b"" if not before else b"&" if b"=" in before else b"?"
        return before + between + quote_from_bytes(data, safe="").encode() + b"=" + value


class Utf8ToString(_Conversion):
    """httpUtf8ToString."""

    def convert(self, data: bytes, _variables: BlockVariables) -> bytes:
        """Convert."""
        return _recoded(data, "utf-8", "latin-1")


class StringToUtf8(_Conversion):
    """httpStringToUtf8."""

    def convert(self, data: bytes, _variables: BlockVariables) -> bytes:
        """Convert."""
        return _recoded(data, "latin-1", "utf-8")


class Utf8ToWString(_Conversion):
    """httpUtf8ToWString."""

    terminator: ClassVar[bytes] = b"\0\0"

    def convert(self, data: bytes, _variables: BlockVariables) -> bytes:
        """Convert."""
        return _recoded(data, "utf-8", "utf-16-le")


class WStringToUtf8(_Conversion):
    """httpWStringToUtf8."""

    def given(self, variables: BlockVariables) -> bytes:
        """Return the characters before the first that is 0."""
        address, memory = variables.address(self.source), self.context.memory
        size = 0
        while size < LONGEST_WIDE and memory.read(address + size, 2) != b"\0\0":
            size += 2
        return memory.read(address, size)

    def convert(self, data: bytes, _variables: BlockVariables) -> bytes:
        """Convert."""
        return _recoded(data, "utf-16-le", "utf-8")


def _recoded(data: bytes, source: str, target: str) -> bytes:
    try:
        return data.decode(source).encode(target)
    except UnicodeError:
        raise StatusError(ILLEGAL_CHARACTERS) from None


BLOCKS: Final[Mapping[str, type[StatusBlock]]] = {
    "httpEncodeBase64": EncodeBase64,
    "httpDecodeBase64": DecodeBase64,
    "httpEncodeUrl": EncodeUrl,
    "httpDecodeUrl": DecodeUrl,
    "httpGetParamUrl": GetParameter,
    "httpSetParamUrl": SetParameter,
    "httpUtf8ToString": Utf8ToString,
    "httpStringToUtf8": StringToUtf8,
    "httpUtf8ToWString": Utf8ToWString,
    "httpWStringToUtf8": WStringToUtf8,
}
"""What runs the blocks by their names."""
