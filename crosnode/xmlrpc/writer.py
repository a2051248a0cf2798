"""XML-RPC values to XML, a part at a time: a long answer is written over several steps of a node.

Source: xmlrpc.com/spec; elements and their contents are those that the standard library writes.
"""

from __future__ import annotations

import datetime as dt
import re
from base64 import encodebytes
from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING, Final
from xml.sax.saxutils import escape

from crosnode.errors import MessageValueError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from crosnode.xmlrpc.values import MethodFault, Value

AT_ONCE: Final = 100
"""Tags and values that are written in one part."""

MAX_DEPTH: Final = 100
"""Lists and dicts within each other."""

_NOT_XML: Final = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_LEAST, _LARGEST = -(2**31), 2**31 - 1
_HEAD: Final = "<?xml version='1.0'?>\n"


class ResponseWriter:
    """Writes a reply with a value.

    Args:
        value: where an iterator stands for a list, it is asked for each element when it is due.
    """

    def __init__(self, value: Value) -> None:
        self._pieces = _response(value)
        self._written: list[str] = []

    def write(self, most: int = AT_ONCE) -> bytes | None:
        """Write a part; return the document when it is whole.

        Raises:
            MessageValueError: a value that XML-RPC cannot carry.
        """
        before = len(self._written)
        self._written.extend(islice(self._pieces, most))
        if len(self._written) - before == most:
            return None
        return "".join(self._written).encode()


def dump_call(method: str, params: Sequence[Value]) -> bytes:
    """Return the XML of a call.

    Raises:
        MessageValueError: a value that XML-RPC cannot carry.
    """
    written = (f"<param>{''.join(_pieces(value, 0))}</param>\n" for value in params)
    return (
        f"{_HEAD}<methodCall>\n<methodName>{_text(method)}</methodName>\n"
        f"<params>\n{''.join(written)}</params>\n</methodCall>\n"
    ).encode()


def dump_fault(fault: MethodFault) -> bytes:
    """Return the XML of a fault; what XML cannot hold in its text is replaced."""
    value = {"faultCode": fault.code, "faultString": _NOT_XML.sub("?", fault.text)}
    written = "".join(_pieces(value, 0))
    return f"{_HEAD}<methodResponse>\n<fault>{written}</fault>\n</methodResponse>\n".encode()


def check_value(value: Value) -> None:
    """Check that XML-RPC can carry a value; raises as ``dump_call`` does."""
    for _ in _pieces(value, 0):
        pass


def _response(value: Value) -> Iterator[str]:
    yield f"{_HEAD}<methodResponse>\n<params>\n<param>"
    yield from _pieces(value, 0)
    yield "</param>\n</params>\n</methodResponse>\n"


def _pieces(value: Value, depth: int) -> Iterator[str]:
    if depth > MAX_DEPTH:
        raise MessageValueError(f"XML-RPC cannot carry more than {MAX_DEPTH} levels.")
    if isinstance(value, dict):
        return _struct(value, depth)
    if isinstance(value, (list, tuple, Iterator)):
        return _array(value, depth)
    return iter((f"<value>{_scalar(value)}</value>",))


def _struct(value: dict[object, Value], depth: int) -> Iterator[str]:
    yield "<value><struct>\n"
    for name, inner in value.items():
        if not isinstance(name, str):
            raise MessageValueError(f"XML-RPC cannot carry the name {name!r:.100}: no string.")
        yield f"<member>\n<name>{_text(name)}</name>\n"
        yield from _pieces(inner, depth + 1)
        yield "</member>\n"
    yield "</struct></value>\n"


def _array(values: Iterable[Value], depth: int) -> Iterator[str]:
    yield "<value><array><data>\n"
    for value in values:
        yield from _pieces(value, depth + 1)
    yield "</data></array></value>\n"


def _scalar(value: Value) -> str:
    if isinstance(value, str):
        return f"<string>{_text(value)}</string>"
    if isinstance(value, bool):
        return f"<boolean>{value:d}</boolean>"
    if isinstance(value, int):
        if not _LEAST <= value <= _LARGEST:  # a range compares an IntEnum with each number
            raise MessageValueError("XML-RPC cannot carry the value: an int of more than 32 bits.")
        return f"<int>{value:d}</int>"
    if isinstance(value, float):
        return f"<double>{float.__repr__(value)}</double>"
    if isinstance(value, (bytes, bytearray)):
        return f"<base64>\n{encodebytes(value).decode()}</base64>"
    if isinstance(value, dt.datetime):
        written = f"{value.year:04}{value:%m%dT%H:%M:%S}"
        return f"<dateTime.iso8601>{written}</dateTime.iso8601>"
    raise MessageValueError(f"XML-RPC cannot carry the value: a {type(value).__name__}.")


def _text(text: str) -> str:
    if match := _NOT_XML.search(text):
        raise MessageValueError(f"XML-RPC cannot carry the character {match[0]!r}.")
    return escape(text, {"\r": "&#13;"})  # a bare carriage return would be read as a newline
