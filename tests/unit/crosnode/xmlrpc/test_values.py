"""XML-RPC values: what the standard library and roscpp write, and what attackers do."""

import datetime as dt
import xmlrpc.client

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import LimitError, MessageValueError, XmlRpcError
from crosnode.xmlrpc.values import (
    MAX_TOKEN,
    MethodCall,
    MethodFault,
    MethodResponse,
    ValueLimits,
    ValueParser,
)
from crosnode.xmlrpc.writer import (
    ResponseWriter,
    check_value,
    dump_call,
    dump_fault,
)

LIMITS = ValueLimits()


def dump_response(value: object) -> bytes:
    """Return a reply that is written in one part."""
    document = ResponseWriter(value).write(10**9)
    assert document is not None
    return document


def parse(document: bytes, size: int = 10**9, limits: ValueLimits = LIMITS) -> object:
    parser = ValueParser(limits)
    for start in range(0, len(document), size):
        parser.feed(document[start : start + size])
    return parser.close()


def reply(value: str) -> bytes:
    return f"<methodResponse><params><param>{value}</param></params></methodResponse>".encode()


TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=("Cc", "Cs", "Cn")) | st.just("\r"))
SCALARS = (
    st.booleans()
    | st.integers(-(2**31), 2**31 - 1)
    | st.floats(allow_nan=False)
    | TEXTS
    | st.binary()
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(TEXTS, inner, max_size=4),
    max_leaves=12,
)


@given(VALUES)
def test_any_value_comes_back(value: object) -> None:
    assert parse(dump_response(value)) == MethodResponse(value)
    assert parse(dump_call("m", [value, value])) == MethodCall("m", [value, value])


@given(VALUES, st.integers(1, 7))
def test_any_split_gives_the_same_value(value: object, size: int) -> None:
    assert parse(dump_response(value), size) == MethodResponse(value)


@given(VALUES)
def test_the_standard_library_reads_ours(value: object) -> None:
    assert xmlrpc.client.loads(dump_response(value), use_builtin_types=True)[0] == (value,)


STRUCT = (
    "<value><struct><member><name>a</name><value><array><data><value>b</value><value>"
    "<struct></struct></value></data></array></value></member></struct></value>"
)


@pytest.mark.parametrize(
    ("xml", "value"),
    [
        ("<value>untyped &lt;y &amp; z&gt;</value>", "untyped <y & z>"),
        ("<value/>", ""),
        ("<value></value>", ""),
        ("<value><string/></value>", ""),
        ("<value><string>a<!-- c -->b<![CDATA[<c>]]></string></value>", "ab<c>"),
        ("<value><string>&#233;&#x4e16;</string></value>", "é世"),
        ("<value>\n <i4> -5 </i4>\n</value>", -5),
        ("<value><int>+7</int></value>", 7),
        ("<value><i8>9007199254740993</i8></value>", 9007199254740993),
        ("<value><boolean>1</boolean></value>", True),
        ("<value><double>1e-09</double></value>", 1e-09),
        ("<value><double>-1.5</double></value>", -1.5),
        ("<value><base64>\nAP8=\n</base64></value>", b"\x00\xff"),
        (
            "<value><dateTime.iso8601>20240102T03:04:05</dateTime.iso8601></value>",
            dt.datetime(2024, 1, 2, 3, 4, 5),  # noqa: DTZ001  # XML-RPC has no zones
        ),
        ("<value><array><data></data></array></value>", []),
        ("<value><array><data/></array></value>", []),
        ("<value><struct/></value>", {}),
        (STRUCT, {"a": ["b", {}]}),
    ],
)
def test_values(xml: str, value: object) -> None:
    assert parse(reply(xml)) == MethodResponse(value)
    assert parse(reply(xml), 1) == MethodResponse(value)


def test_calls() -> None:
    assert parse(b"<?xml version='1.0'?><methodCall><methodName>m</methodName></methodCall>") == (
        MethodCall("m", [])
    )
    assert parse(dump_call("getPid", ["/n"])) == MethodCall("getPid", ["/n"])


def test_fault() -> None:
    assert parse(dump_fault(MethodFault(3, "bad < worse\x00\ud800"))) == MethodFault(
        3, "bad < worse??"
    )


def nested(depth: int) -> bytes:
    inner = "<array><data><value>" * depth + "x" + "</value></data></array>" * depth
    return reply(f"<value>{inner}</value>")


BOMB = (
    b'<?xml version="1.0"?><!DOCTYPE l [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]>'
    b"<methodResponse><params><param><value>&b;</value></param></params></methodResponse>"
)


@pytest.mark.parametrize(
    "document",
    [
        b"",
        b"hello",
        b"<html></html>",
        b"<methodCall>",
        b"<methodCall></methodCall>",
        b"<methodResponse></methodResponse>",
        b"<methodResponse><params></params></methodResponse>",
        b"<methodResponse><fault><value>x</value></fault></methodResponse>",
        b"<methodResponse><fault><value><struct/></value></fault></methodResponse>",
        b"<methodCall><params/><methodName>m</methodName></methodCall>",
        reply("<value>&undefined;</value>"),
        reply("<value>a</value><value>b</value>"),
        reply("<value><int>1</int><int>2</int></value>"),
        reply("<value><int/></value>"),
        reply("<value><int>1.5</int></value>"),
        reply(f"<value><int>{'9' * 5000}</int></value>"),
        reply("<value><boolean>true</boolean></value>"),
        reply("<value><double>one</double></value>"),
        reply("<value><nil/></value>"),
        reply("<value><bigdecimal>1</bigdecimal></value>"),
        reply("<value><base64>A</base64></value>"),
        reply("<value><dateTime.iso8601>noon</dateTime.iso8601></value>"),
        reply("<value><struct><member><value>b</value></member></struct></value>"),
        reply("<value><struct><member><name>b</name></member></struct></value>"),
        reply("<value><struct><value>b</value></struct></value>"),
        reply("<value><array><value>b</value></array></value>"),
        reply("<value>\x00</value>"),
        reply("<value>\u00e9</value>").decode().encode("latin-1"),
        reply("<value>a</value>") + b"<methodResponse/>",
        nested(50),
        BOMB,
    ],
)  # fmt: skip
def test_refused(document: bytes) -> None:
    for size in (1, 10**9):
        with pytest.raises(XmlRpcError):
            parse(document, size)


def test_bomb_is_refused_at_its_first_line() -> None:
    with pytest.raises(XmlRpcError, match="document type"):
        ValueParser(LIMITS).feed(BOMB[:60])


@pytest.mark.parametrize(
    ("limits", "document", "reason"),
    [
        (ValueLimits(max_size=100), reply("<value>x</value>") * 2, "more than 100 bytes"),
        (ValueLimits(max_depth=10), nested(3), "more than 10 elements within"),
        (
            ValueLimits(max_elements=10),
            reply("<value><array><data>" + "<value/>" * 10 + "</data></array></value>"),
            "more than 10 elements",
        ),
        (LIMITS, b"<" + b"a" * 2 * MAX_TOKEN, "tag or comment"),
        (LIMITS, b"<!--" + b"a" * 2 * MAX_TOKEN, "tag or comment"),
    ],
)
def test_limits(limits: ValueLimits, document: bytes, reason: str) -> None:
    with pytest.raises(LimitError, match=reason):
        parse(document, 1000, limits)


def test_long_text_is_no_long_token() -> None:
    text = "x" * 5 * MAX_TOKEN
    assert parse(reply(f"<value>{text}</value>"), 1000) == MethodResponse(text)


@given(st.binary(max_size=100))
def test_any_bytes(document: bytes) -> None:
    with pytest.raises(XmlRpcError):
        parse(document)


PIECES = ["<value>", "</value>", "<array><data>", "</data></array>", "<struct>", "</struct>",
          "<member>", "</member>", "<name>", "</name>", "<int>", "</int>", "1", "x"]  # fmt: skip


@given(st.lists(st.sampled_from(PIECES), max_size=12).map("".join))
def test_any_markup(xml: str) -> None:
    try:
        result = parse(reply(xml))
    except XmlRpcError:
        return
    assert isinstance(result, MethodResponse)
    check_value(result.value)


@pytest.mark.parametrize(
    "value", [None, 2**31, object(), {1: "a"}, "nul\x00", "\ud800", "\ufffe", [None]]
)
def test_values_that_cannot_be_carried(value: object) -> None:
    with pytest.raises(MessageValueError, match="XML-RPC cannot carry"):
        check_value(value)


def test_value_that_holds_itself() -> None:
    value: list[object] = []
    value.append(value)
    with pytest.raises(MessageValueError):
        check_value(value)
