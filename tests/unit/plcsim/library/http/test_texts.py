"""Conversions of texts in AsHttp."""

import pytest

from plcsim.library.http.statuses import (
    BUFFER_SIZE,
    ILLEGAL_CHARACTERS,
    INVALID_PARAM,
    NOT_FOUND,
)
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE
from st_types import BOOL, UDINT, UINT

INPUTS = {"enable": BOOL} | dict.fromkeys(
    ("pSrc", "srcLen", "pDest", "destSize", "pParam", "pValue", "valueSize", "pMappingTable"), UDINT
)
OUTPUTS = {"status": UINT, "destLen": UDINT, "valueLen": UDINT}


@pytest.fixture
def convert(plc):
    """``convert(name, data, size=32)``: status, length, and what is in the buffer then."""

    def run(name, data, size=32, **more):
        target = plc.bytes(b"\x7f" * 40)
        given = {"pSrc": plc.bytes(data + bytes(2)), "srcLen": len(data), "pDest": target}
        block = plc.model(name, INPUTS, OUTPUTS)
        status = block(enable=True, destSize=size, **{**given, **more})
        return status, block["destLen"], plc.memory.read(target, 40).partition(b"\x7f")[0]

    return run


@pytest.mark.parametrize(
    ("name", "source", "length", "target"),
    [
        ("httpEncodeBase64", b"PLC\0\xff", 8, b"UExDAP8=\0"),
        ("httpDecodeBase64", b"UExDAP8=", 5, b"PLC\0\xff\0"),
        ("httpEncodeUrl", b"a b&c=\xe4-._~", 19, b"a%20b%26c%3D%E4-._~\0"),
        ("httpDecodeUrl", b"a+b%26c%3d", 6, b"a b&c=\0"),
        ("httpUtf8ToString", "20 °C".encode(), 5, b"20 \xb0C\0"),
        ("httpStringToUtf8", b"20 \xb0C", 6, b"20 \xc2\xb0C\0"),
        ("httpUtf8ToWString", "°€".encode(), 2, b"\xb0\0\xac\x20\0\0"),
        ("httpWStringToUtf8", b"\xb0\0\xac\x20", 5, "°€".encode() + b"\0"),
    ],
)
def test_texts(convert, name, source, length, target):
    status, found, data = convert(name, source)
    assert (status, data) == (0, target)
    assert found == length


@pytest.mark.parametrize(
    ("name", "source"),
    [
        ("httpDecodeBase64", b"UEx*"),
        ("httpUtf8ToString", "€".encode()),
        ("httpUtf8ToString", b"\xff"),
        ("httpWStringToUtf8", b"\0\xd8"),
    ],
)
def test_characters_that_cannot_be_converted(convert, name, source):
    assert convert(name, source) == (ILLEGAL_CHARACTERS, 0, b"")


def test_a_text_needs_room_for_its_terminator_and_data_do_not(convert):
    assert convert("httpEncodeBase64", b"PLC", 4) == (BUFFER_SIZE, 0, b"")
    assert convert("httpEncodeBase64", b"PLC", 5) == (0, 4, b"UExD\0")
    assert convert("httpDecodeBase64", b"UExD", 3) == (0, 3, b"PLC")
    assert convert("httpDecodeBase64", b"UExD", 2) == (BUFFER_SIZE, 0, b"")
    assert convert("httpUtf8ToWString", b"PLC", 7) == (BUFFER_SIZE, 0, b"")


def test_addresses_and_enable(plc, convert):
    assert convert("httpEncodeUrl", b"a", pSrc=0)[0] == INVALID_PARAM
    assert convert("httpEncodeUrl", b"a", pDest=0)[0] == INVALID_PARAM
    assert plc.model("httpEncodeUrl", INPUTS, OUTPUTS)(enable=False) == ERR_FUB_ENABLE_FALSE


@pytest.mark.parametrize(
    ("source", "name", "status", "value"),
    [
        ("/a.cgi?cmd=start&n=1+2", "n", 0, "1 2"),
        ("cmd=a%3Db&n=", "cmd", 0, "a=b"),
        ("cmd=a&n=", "n", 0, ""),
        ("/a.cgi?xcmd=start", "cmd", NOT_FOUND, "?"),
        ("/a.cgi", "a.cgi", NOT_FOUND, "?"),
    ],
)
def test_a_parameter_of_a_url(plc, source, name, status, value):
    block = plc.model("httpGetParamUrl", INPUTS, OUTPUTS)
    target = plc.text("?")
    given = {"pSrc": plc.text(source), "pParam": plc.text(name)}
    assert block(enable=True, pValue=target, valueSize=20, **given) == status
    assert plc.string(target) == value
    assert block["valueLen"] == (0 if status else len(value))


def test_parameters_are_added_to_a_url(plc):
    block = plc.model("httpSetParamUrl", INPUTS, OUTPUTS)
    target = plc.text("/a.cgi")
    for name, value in (("x", "1 2"), ("y&", "b")):
        given = {"pParam": plc.text(name), "pValue": plc.text(value)}
        assert block(enable=True, pDest=target, destSize=24, **given) == 0
    assert plc.string(target) == "/a.cgi?x=1%202&y%26=b"
    assert block["destLen"] == 21
    assert block(enable=True) == BUFFER_SIZE
    assert block(pValue=0) == INVALID_PARAM
    form = plc.text("")
    block(pDest=form, pValue=plc.text("b"))
    assert plc.string(form) == "y%26=b"
