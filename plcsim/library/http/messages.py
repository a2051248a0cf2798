"""Requests and responses of HTTP/1.x as bytes (RFC 9112), as far as a client needs them."""

from __future__ import annotations

from typing import Final, NamedTuple

CRLF: Final = b"\r\n"
LONGEST_HEADER: Final = 0x1_0000
"""Bytes of a header; a longer one is malformed."""

WITHOUT_BODY: Final = frozenset([204, 304])
"""Responses that end with their header."""


FIRST_FINAL: Final = 200
"""Responses with a lower code are followed by another."""

LONGEST_LENGTH: Final = 12
"""Digits of a Content-Length."""


class MalformedError(Exception):
    """What came is no response."""


class Response(NamedTuple):
    """A response that has come in whole.

    Attributes:
        protocol: such as ``HTTP/1.1``.
        code: such as 200.
        reason: such as ``OK``.
        header: the raw lines, without the first and the empty one.
        fields: of the header, by their names in lower case.
        body: decoded, where it came in chunks.
    """

    protocol: str
    code: int
    reason: str
    header: bytes
    fields: dict[str, str]
    body: bytes


def request_bytes(first_line: str, fields: list[tuple[str, str]], raw: bytes, body: bytes) -> bytes:
    """Return a request.

    Args:
        first_line: without its end.
        fields: of the header, in order.
        raw: more lines of the header, each with its end.
        body: behind it.
    """
    lines = "".join(f"{name}: {value}\r\n" for name, value in fields)
    return f"{first_line}\r\n{lines}".encode("latin-1", "replace") + raw + CRLF + body


def parse_response(data: bytes, *, is_ended: bool) -> Response | None:
    """Return the response that the bytes hold, None where more are to come.

    Args:
        data: all that has come in.
        is_ended: whether the other side has finished.

    Raises:
        MalformedError: they hold none, or end within one.
    """
    code = 100
    while code < FIRST_FINAL:
        head, end, data = data.partition(CRLF + CRLF)
        if not end and (is_ended or len(head) > LONGEST_HEADER):
            raise MalformedError
        if not end:
            return None
        first, _, header = head.partition(CRLF)
        protocol, code, reason = _status_line(first)
    fields = _fields(header)
    body = b"" if code in WITHOUT_BODY else _body(data, fields, is_ended=is_ended)
    return None if body is None else Response(protocol, code, reason, header, fields, body)


def _status_line(line: bytes) -> tuple[str, int, str]:
    protocol, _, status = line.decode("latin-1").partition(" ")
    code, _, reason = status.partition(" ")
    if not protocol.startswith("HTTP/") or not code.isdecimal() or len(code) != len("200"):
        raise MalformedError
    return protocol, int(code), reason


def _fields(header: bytes) -> dict[str, str]:
    lines = (line.partition(":") for line in header.decode("latin-1").split("\r\n"))
    return {name.strip().lower(): value.strip() for name, colon, value in lines if colon}


def _body(data: bytes, fields: dict[str, str], *, is_ended: bool) -> bytes | None:
    """Return the body, None where more is to come."""
    body: bytes | None
    if "chunked" in fields.get("transfer-encoding", "").lower():
        body = _joined(data)
    elif "content-length" in fields:
        size = fields["content-length"]
        if not (size.isascii() and size.isdecimal()) or len(size) > LONGEST_LENGTH:
            raise MalformedError
        body = data[: int(size)] if len(data) >= int(size) else None
    else:
        return data if is_ended else None
    if body is None and is_ended:
        raise MalformedError
    return body


def _joined(data: bytes) -> bytes | None:
    """Return what chunks hold, None where the last has not come."""
    found: list[bytes] = []
    while True:
        line, end, data = data.partition(CRLF)
        if not end:
            return None
        size = _chunk_size(line)
        if size == 0:
            return b"".join(found)
        if len(data) < size + len(CRLF):
            return None
        found.append(data[:size])
        data = data[size + len(CRLF) :]


def _chunk_size(line: bytes) -> int:
    try:
        size = int(line.partition(b";")[0].strip() or b"-1", 16)
    except ValueError:
        raise MalformedError from None
    if size < 0:
        raise MalformedError
    return size
