"""IP addresses as numbers."""

import pytest

from plcsim.library.aseth import ethERR_PARAMETER
from plcsim.library.runtime import ERR_OK


def test_an_address_and_back(plc):
    number, text = plc.bytes(bytes(4)), plc.text("")
    assert plc.function("ethInetAton")(plc.text("192.168.0.10"), number) == ERR_OK
    assert plc.memory.read(number, 4) == bytes([192, 168, 0, 10])
    value = int.from_bytes(plc.memory.read(number, 4), "little")
    assert plc.function("ethInetNtoa")(value, text) == ERR_OK
    assert plc.string(text) == "192.168.0.10"


@pytest.mark.parametrize("text", ["", "1.2.3", "256.1.1.1", "plc", "1.2.3.4.5", "x" * 40])
def test_no_address(plc, text):
    number = plc.bytes(b"####")
    assert plc.function("ethInetAton")(plc.text(text), number) == ethERR_PARAMETER
    assert plc.memory.read(number, 4) == b"####"


def test_null_pointers(plc):
    assert plc.function("ethInetAton")(0, plc.bytes(bytes(4))) == ethERR_PARAMETER
    assert plc.function("ethInetAton")(plc.text("1.2.3.4"), 0) == ethERR_PARAMETER
    assert plc.function("ethInetNtoa")(1, 0) == ethERR_PARAMETER
