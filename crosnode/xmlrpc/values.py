"""XML to XML-RPC values, by the unmarshaller of the standard library, made safe.

Expat reads the XML in the pieces in which it comes; a document type, and with it every entity and
every bomb made of them, is refused, and depth, number of elements and size are bounded. Untyped
values are strings, as roscpp sends them. Source: xmlrpc.com/spec.
"""

from __future__ import annotations

import xmlrpc.client
from typing import Any, Final, NamedTuple, TypeAlias
from xml.parsers import expat

from crosnode.errors import LimitError, XmlRpcError

Value: TypeAlias = Any
"""bool, int (32 bits), float, str, bytes, datetime, list or dict with str keys."""

MIB: Final = 1 << 20
MAX_TOKEN: Final = 8192
"""Bytes of one tag or comment; expat reads an incomplete one again with each piece."""


AT_ONCE: Final = 64
SLICE: Final = 256
"""``feed_part`` ends with the slice, of so many bytes, in which the count of elements is passed."""


class ValueLimits(NamedTuple):
    """What a received document may take.

    Attributes:
        max_size: bytes.
        max_depth: elements within each other; an array takes three, a struct three.
        max_elements: elements in all.
    """

    max_size: int = 4 * MIB
    max_depth: int = 128
    max_elements: int = 500_000


class MethodCall(NamedTuple):
    """A method call."""

    method: str
    params: list[Value]


class MethodFault(NamedTuple):
    """A fault reply."""

    code: int
    text: str


class MethodResponse(NamedTuple):
    """A reply with a value."""

    value: Value


class ValueParser:
    """Reads one XML-RPC document, piece by piece.

    The work lies in the elements, not in the bytes, so ``feed_part`` is bounded by elements.
    """

    def __init__(self, limits: ValueLimits) -> None:
        self._limits = limits
        self._size = self._elements = self._silent = 0
        self._open: list[_Element] = [_Element("")]
        self._text: list[str] = []
        self._target = xmlrpc.client.Unmarshaller(use_builtin_types=True)
        self._target.xml("", None)  # texts come decoded
        self._parser = expat.ParserCreate()
        self._parser.StartDoctypeDeclHandler = _refuse_doctype
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._data

    def feed_part(self, data: bytes) -> bytes:
        """Parse some elements of the next piece; return what is left of it.

        Raises:
            XmlRpcError: the document is not XML-RPC, or over a limit.
        """
        offset, most = 0, self._elements + AT_ONCE
        while offset < len(data) and self._elements < most:
            self.feed(data[offset : offset + SLICE])
            offset += SLICE
        return data[offset:]

    def feed(self, data: bytes) -> None:
        """Parse the next piece.

        Raises:
            XmlRpcError: the document is not XML-RPC, or over a limit.
        """
        self._size += len(data)
        self._silent += len(data)
        if self._size > self._limits.max_size:
            raise LimitError(f"document of more than {self._limits.max_size} bytes")
        self._parse(data, is_final=False)
        if self._silent > MAX_TOKEN:
            raise LimitError(f"tag or comment of more than {MAX_TOKEN} bytes")

    def close(self) -> MethodCall | MethodResponse | MethodFault:
        """Return what the document says; raises as ``feed`` does."""
        self._parse(b"", is_final=True)
        # The parser and this object hold each other; without a collector they would stay.
        self._parser.StartElementHandler = self._parser.EndElementHandler = None
        self._parser.CharacterDataHandler = None
        try:
            params = self._target.close()
        except xmlrpc.client.Fault as fault:
            return MethodFault(int(fault.faultCode), str(fault.faultString))
        except _FAULTS as error:
            raise XmlRpcError(f"not an XML-RPC document: {error!r}") from error
        method = self._target.getmethodname()
        if method is not None:
            return MethodCall(method, list(params))
        if len(params) != 1:
            raise XmlRpcError(f"reply with {len(params)} values")
        return MethodResponse(params[0])

    def _parse(self, data: bytes, *, is_final: bool) -> None:
        try:
            self._parser.Parse(data, is_final)
        except _FAULTS as error:
            raise XmlRpcError(f"not an XML-RPC document: {error}") from error

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        self._silent = 0
        self._elements += 1
        if len(self._open) > self._limits.max_depth:
            raise LimitError(f"more than {self._limits.max_depth} elements within each other")
        if self._elements > self._limits.max_elements:
            raise LimitError(f"more than {self._limits.max_elements} elements")
        self._open[-1].add(tag)
        self._open.append(_Element(tag))
        self._text.clear()
        self._target.start(tag, attributes)

    def _data(self, text: str) -> None:
        self._silent = 0
        self._text.append(text)

    def _end(self, tag: str) -> None:
        self._silent = 0
        self._open.pop().check_complete()
        text = "".join(self._text)
        self._text.clear()
        self._target.end_dispatch(tag, text)


_SCALARS: Final = ("int", "i4", "i8", "boolean", "double", "string", "dateTime.iso8601", "base64")
_CHILDREN: Final[dict[str, tuple[str, ...]]] = {
    "": ("methodCall", "methodResponse"),
    "methodCall": ("methodName", "params"),
    "methodResponse": ("params", "fault"),
    "params": ("param",),
    "param": ("value",),
    "fault": ("value",),
    "value": (*_SCALARS, "array", "struct"),
    "array": ("data",),
    "data": ("value",),
    "struct": ("member",),
    "member": ("name", "value"),
}
"""Elements that may stand in each other; the unmarshaller itself takes them in any order."""

_MANY: Final = frozenset({"params", "data", "struct"})


class _Element:
    """An open element: its tag, and how many children it has so far."""

    __slots__ = ("count", "tag")

    def __init__(self, tag: str) -> None:
        self.tag = tag
        self.count = 0

    def add(self, tag: str) -> None:
        """Count a child, where it may stand here."""
        allowed = _CHILDREN.get(self.tag, ())
        if self.tag in ("methodCall", "member"):
            allowed = allowed[self.count : self.count + 1]
        elif self.count and self.tag not in _MANY:
            allowed = ()
        if tag not in allowed:
            raise XmlRpcError(f"element {tag[:100]!r} in {self.tag!r}")
        self.count += 1

    def check_complete(self) -> None:
        """Check at the end of a member that it has a name and a value."""
        if self.tag == "member" and self.count != 2:
            raise XmlRpcError("member without name or value")


_FAULTS: Final = (
    expat.ExpatError,
    xmlrpc.client.Error,
    AttributeError,
    LookupError,
    OverflowError,
    TypeError,
    ValueError,
)
"""What expat and the unmarshaller raise for a document that is not XML-RPC."""


def _refuse_doctype(*_: object) -> None:
    raise XmlRpcError("document type declarations are refused")
