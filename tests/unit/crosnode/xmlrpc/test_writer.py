"""XML-RPC values to XML: whole and in parts, and what XML-RPC cannot carry."""

import datetime as dt
import enum
import xmlrpc.client
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import MessageValueError
from crosnode.xmlrpc.values import MethodFault
from crosnode.xmlrpc.writer import (
    MAX_DEPTH,
    ResponseWriter,
    check_value,
    dump_call,
    dump_fault,
)

from .test_values import VALUES, dump_response


def in_parts(value: object, most: int) -> list[bytes | None]:
    writer, parts = ResponseWriter(value), []
    while not parts or parts[-1] is None:
        parts.append(writer.write(most))
    return parts


@given(VALUES, st.integers(1, 9))
def test_in_parts_it_is_the_same_document(value: object, most: int) -> None:
    assert in_parts(value, most)[-1] == dump_response(value)


def test_a_long_value_takes_many_parts_and_an_iterator_is_asked_when_it_is_due() -> None:
    asked: list[int] = []

    def elements() -> Iterator[int]:
        for number in range(1_000):
            asked.append(number)
            yield number

    writer = ResponseWriter([elements()])
    assert writer.write(100) is None
    assert 90 < len(asked) < 100
    assert len(in_parts(list(range(1_000)), 100)) == 11
    assert dump_response([elements()]) == dump_response([list(range(1_000))])


class Level(enum.IntEnum):
    HIGH = 3


@pytest.mark.parametrize(
    ("value", "read"),
    [
        (Level.HIGH, 3),
        (np.float64(1.5), 1.5),
        (1e-9, 1e-09),
        ((1, 2), [1, 2]),
        (bytearray(b"\xff"), b"\xff"),
        (True, True),
        (dt.datetime(7, 1, 2, 3, 4, 5), dt.datetime(7, 1, 2, 3, 4, 5)),  # noqa: DTZ001
        ("a\r\n<&>]]>", "a\r\n<&>]]>"),
        ({"<k>": [{}]}, {"<k>": [{}]}),
    ],
)
def test_the_standard_library_reads(value: object, read: object) -> None:
    found = xmlrpc.client.loads(dump_response(value), use_builtin_types=True)[0][0]
    assert found == read
    assert type(found) is type(read)


DEEP: list[object] = []
for _ in range(MAX_DEPTH + 1):
    DEEP = [DEEP]


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (None, "a NoneType"),
        (2**31, "32 bits"),
        (-(2**31) - 1, "32 bits"),
        ({1: 2}, "the name 1"),
        ("\0", r"the character '\\x00'"),
        ({"\ud800": 1}, "the character"),
        (np.int64(1), "a int64"),
        (DEEP, "100 levels"),
        ({1, 2}, "a set"),
    ],
)
def test_what_cannot_be_carried(value: object, message: str) -> None:
    for write in (check_value, dump_response, lambda v: dump_call("m", [[v]])):
        with pytest.raises(MessageValueError, match=message):
            write(value)


def test_a_list_within_itself_ends() -> None:
    endless: list[object] = []
    endless.append(endless)
    with pytest.raises(MessageValueError, match="levels"):
        dump_response(endless)


def test_documents_are_read_by_the_standard_library() -> None:
    assert xmlrpc.client.loads(dump_call("a<b", [1, "x"])) == ((1, "x"), "a<b")
    assert xmlrpc.client.loads(dump_call("m", [])) == ((), "m")

    with pytest.raises(xmlrpc.client.Fault, match="no <good> \\?"):
        xmlrpc.client.loads(dump_fault(MethodFault(3, "no <good> \0")))
