"""Requests and responses as bytes."""

import pytest

from plcsim.library.http.messages import (
    LONGEST_HEADER,
    MalformedError,
    parse_response,
    request_bytes,
)

OK = b"HTTP/1.1 200 OK\r\n"

WHOLE = [
    (OK + b"Content-Length: 3\r\n\r\nabc", b"abc"),
    (OK + b"content-length:0\r\n\r\n", b""),
    (OK + b"Transfer-Encoding: Chunked\r\n\r\n2\r\nab\r\n1;x=y\r\nc\r\n0\r\n\r\n", b"abc"),
    (b"HTTP/1.1 100 Continue\r\n\r\n" + OK + b"Content-Length: 1\r\n\r\na", b"a"),
    (b"HTTP/1.1 103 Early Hints\r\n\r\n" * 1200 + OK + b"Content-Length: 1\r\n\r\nb", b"b"),
    (b"HTTP/1.1 204 No Content\r\n\r\n", b""),
]


@pytest.mark.parametrize(("data", "body"), WHOLE)
def test_a_response_is_there_with_its_last_byte(data, body):
    found = parse_response(data, is_ended=False)
    assert (found.protocol, found.body) == ("HTTP/1.1", body)
    ends = range(max(len(data) - 200, 0), len(data))
    early = [parse_response(data[:end], is_ended=False) for end in ends]
    assert [each for each in early if each is not None and each.body != body] == []
    with pytest.raises(MalformedError):
        parse_response(data[:10], is_ended=True)


def test_without_a_length_it_is_there_at_the_end():
    data = OK + b"X: 1\r\nserver : me \r\n\r\nabc"
    assert parse_response(data, is_ended=False) is None
    found = parse_response(data, is_ended=True)
    assert (found.code, found.reason, found.body) == (200, "OK", b"abc")
    assert found.fields == {"x": "1", "server": "me"}
    assert found.header == b"X: 1\r\nserver : me "


@pytest.mark.parametrize(
    "data",
    [
        b"SSH-2.0\r\n\r\n",
        b"HTTP/1.1 20 OK\r\n\r\n",
        b"HTTP/1.1\r\n\r\n",
        OK + b"Content-Length: -1\r\n\r\n",
        OK + b"Content-Length: " + b"9" * 5000 + b"\r\n\r\n",
        OK + b"Content-Length: 5\r\n\r\nab",
        OK + b"Transfer-Encoding: chunked\r\n\r\nxx\r\n",
        OK + b"Transfer-Encoding: chunked\r\n\r\n-1\r\n",
        OK + b"Transfer-Encoding: chunked\r\n\r\n2\r\nab\r\n",
        b"x" * (LONGEST_HEADER + 1),
    ],
)
def test_what_is_no_response(data):
    with pytest.raises(MalformedError):
        parse_response(data, is_ended=True)


def test_a_header_without_an_end_is_no_response():
    with pytest.raises(MalformedError):
        parse_response(b"x" * (LONGEST_HEADER + 1), is_ended=False)


def test_a_request():
    found = request_bytes("POST / HTTP/1.1", [("Host", "a"), ("X", "°€")], b"Y: 1\r\n", b"data")
    assert found == b"POST / HTTP/1.1\r\nHost: a\r\nX: \xb0?\r\nY: 1\r\n\r\ndata"
