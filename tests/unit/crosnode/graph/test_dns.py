"""Questions and answers of DNS against bytes written by RFC 1035."""

import struct

from hypothesis import given
from hypothesis import strategies as st

from crosnode.graph.dns import NameAnswer, is_name, parse_answer, parse_name_servers, question

NAME = "master.plant"
ASKED = b"\x06master\x05plant\0" + b"\0\x01\0\x01"


def answer(
    records: bytes, count: int, *, number: int = 7, flags: int = 0x8180, asked: bytes = ASKED
) -> bytes:
    return struct.pack(">HHHHHH", number, flags, 1, count, 0, 0) + asked + records


def record(kind: int, data: bytes, ttl_s: int = 60, name: bytes = b"\xc0\x0c") -> bytes:
    return name + struct.pack(">HHIH", kind, 1, ttl_s, len(data)) + data


def test_a_question() -> None:
    assert question(7, NAME) == b"\0\x07\x01\0\0\x01\0\0\0\0\0\0" + ASKED
    assert question(7, NAME + ".") == question(7, NAME)


def test_an_address() -> None:
    assert parse_answer(7, NAME, answer(record(1, b"\x0a\0\0\x05"), 1)) == NameAnswer(
        "10.0.0.5", 60
    )
    upper = ASKED.replace(b"master", b"MASTER")
    data = answer(record(1, b"\x0a\0\0\x05"), 1, asked=upper)
    assert parse_answer(7, NAME, data) == NameAnswer("10.0.0.5", 60)


def test_an_address_behind_another_name() -> None:
    alias = record(5, b"\x03one\x05plant\0") + record(1, b"\x0a\0\0\x06", 9, b"\x03one\xc0\x13")
    assert parse_answer(7, NAME, answer(alias, 2)) == NameAnswer("10.0.0.6", 9)


def test_names_without_an_address() -> None:
    assert parse_answer(7, NAME, answer(b"", 0)) == NameAnswer("", 0)
    assert parse_answer(7, NAME, answer(b"", 0, flags=0x8183)) == NameAnswer("", 0)
    assert parse_answer(7, NAME, answer(record(28, bytes(16)), 1)) == NameAnswer("", 0)


def test_what_is_no_answer() -> None:
    good = answer(record(1, b"\x0a\0\0\x05"), 1)
    assert parse_answer(8, NAME, good) is None
    assert parse_answer(7, "other.plant", good) is None
    assert parse_answer(7, NAME, answer(b"", 0, flags=0x0100)) is None
    assert parse_answer(7, NAME, answer(b"", 0, flags=0x8182)) is None  # a server's failure
    for size in range(len(good)):
        assert parse_answer(7, NAME, good[:size]) is None


@given(st.binary(max_size=600))
def test_any_bytes_are_taken(data: bytes) -> None:
    parse_answer(7, NAME, answer(data, 65_535))
    parse_answer(7, NAME, data)


def test_names_that_may_be_asked_for() -> None:
    assert is_name(NAME)
    assert is_name("plc_1")
    for text in ("", ".", "a..b", "a b", "ü.de", "x" * 64, "a." * 130):
        assert not is_name(text)


def test_resolv_conf() -> None:
    text = "# made by hand\nnameserver 10.0.0.1\nnameserver ::1\nsearch plant.example bad..name\n"
    found = parse_name_servers(text + "nameserver 10.0.0.2\noptions ndots:1\n")
    assert found.servers == ("10.0.0.1", "10.0.0.2")
    assert found.domains == ("plant.example",)
    assert parse_name_servers("") == ((), ())
