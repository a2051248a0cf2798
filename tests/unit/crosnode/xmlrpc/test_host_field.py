"""A head without Host gets one, however its bytes are cut; one with Host is left as it is."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.xmlrpc.host_field import HostField

LINE = b"POST / HTTP/1.1\r\n"


@pytest.mark.parametrize(
    ("data", "passed"),
    [
        (LINE + b"A: 1\r\n\r\nbody\r\n\r\n", LINE + b"A: 1\r\nHost:\r\n\r\nbody\r\n\r\n"),
        (LINE + b"A: 1\r\nhOsT: x\r\n\r\nbody", LINE + b"A: 1\r\nhOsT: x\r\n\r\nbody"),
        (LINE + b"\r\n", LINE + b"Host:\r\n\r\n"),
        (b"POST / HTTP/1.1\n\nbody", b"POST / HTTP/1.1\nHost:\r\n\nbody"),
        (LINE + b"Hos: 1\r\nXHost: 2\r\n\r\n", LINE + b"Hos: 1\r\nXHost: 2\r\nHost:\r\n\r\n"),
        (b"\x16\x03\x01", b"\x16\x03\x01"),
    ],
)
@given(st.data())
def test_whatever_the_pieces(data: bytes, passed: bytes, draw: st.DataObject) -> None:
    field, done, rest = HostField(), b"", data
    while rest:
        size = draw.draw(st.integers(1, len(rest)))
        done += field.complete(rest[:size])
        rest = rest[size:]
    assert done == passed


def test_the_next_request_gets_its_own() -> None:
    field = HostField()
    field.complete(LINE + b"Host: x\r\n\r\n")
    field.begin()
    assert field.complete(LINE + b"\r\n") == LINE + b"Host:\r\n\r\n"
