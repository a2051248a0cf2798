import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymodbus.pdu import DecodePDU, ModbusPDU

from plcsim.modbus.map import Area
from plcsim.modbus.service.errors import ExceptionCode, ModbusException
from plcsim.modbus.service.pdu import (
    Identify,
    MaskWrite,
    Read,
    ReadWrite,
    ReportServerId,
    ReturnQueryData,
    WriteCoils,
    WriteRegisters,
    decode_request,
    encode_exception,
    encode_identification,
    encode_read,
    encode_server_id,
    encode_write,
)


def request(text: str) -> object:
    return decode_request(bytes.fromhex(text))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("01 0013 0013", Read(1, Area.COILS, 0x13, 0x13)),
        ("02 00c4 07d0", Read(2, Area.DISCRETE_INPUTS, 0xC4, 2000)),
        ("03 ffff 0001", Read(3, Area.HOLDING_REGISTERS, 0xFFFF, 1)),
        ("04 0008 007d", Read(4, Area.INPUT_REGISTERS, 8, 125)),
        ("05 00ac ff00", WriteCoils(5, 0xAC, [True])),
        ("05 00ac 0000", WriteCoils(5, 0xAC, [False])),
        ("06 0001 8003", WriteRegisters(6, 1, b"\x80\x03")),
        ("08 0000 a537", ReturnQueryData(8)),
        ("0f 0013 000a 02 cd01",
         WriteCoils(15, 0x13, [True, False, True, True, False, False, True, True, True, False])),
        ("10 0001 0002 04 000a0102", WriteRegisters(16, 1, bytes.fromhex("000a0102"))),
        ("11", ReportServerId(17)),
        ("16 0004 00f2 0025", MaskWrite(22, 4, 0xF2, 0x25)),
        ("17 0003 0006 000e 0001 02 00ff", ReadWrite(23, 3, 6, 14, b"\0\xff")),
        ("2b 0e 01 00", Identify(43, 1, 0)),
    ],
)  # fmt: skip
def test_requests_of_the_specification(text: str, expected: object) -> None:
    assert request(text) == expected


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("00", 1), ("07", 1), ("0b", 1), ("14 00", 1), ("18 0000", 1), ("63", 1), ("83", 1),
        ("01 0000 0000", 3), ("01 0000 07d1", 3), ("01 0000", 3), ("01", 3), ("01 0000 0001 00", 3),
        ("03 0000 0000", 3), ("03 0000 007e", 3), ("03 0000 07d1", 3), ("04 0000 ffff", 3),
        ("03 0000 00", 3), ("03 0000 0001 00", 3),
        ("05 0000 1234", 3), ("05 0000 ff01", 3), ("05 0000", 3), ("05 0000 ff00 00", 3),
        ("06 0000", 3), ("06 0000 0001 00", 3),
        ("08 0001 0000", 1), ("08 000a 0000", 1), ("08", 3), ("08 00", 3),
        ("0f 0000 0000 00", 3), ("0f 0000 07b1 f7" + "00" * 247, 3), ("0f 0000 0008 02 0000", 3),
        ("0f 0000 0009 02 00", 3), ("0f 0000 0008 01 0000", 3), ("0f 0000 0008", 3),
        ("10 0000 0000 00", 3), ("10 0000 007c f8" + "00" * 248, 3), ("10 0000 0001 02 00", 3),
        ("10 0000 0001 02 000000", 3), ("10 0000 0001 04 0000", 3), ("10 0000", 3),
        ("11 00", 3),
        ("16 0000 0000", 3), ("16 0000 0000 0000 00", 3),
        ("17 0000 0000 0000 0001 02 0000", 3), ("17 0000 007e 0000 0001 02 0000", 3),
        ("17 0000 0001 0000 0000 00", 3), ("17 0000 0001 0000 007a f4" + "00" * 244, 3),
        ("17 0000 0001 0000 0001 02 00", 3), ("17 0000 0001 0000 0001 04 0000", 3),
        ("2b", 3), ("2b 0d 00 00", 1), ("2b 0e 00 00", 3), ("2b 0e 05 00", 3), ("2b 0e 01", 3),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_request_gives_its_exact_code(text: str, code: int) -> None:
    with pytest.raises(ModbusException) as caught:
        request(text)
    assert caught.value.code == code


@given(st.binary(min_size=1, max_size=253))
def test_any_pdu_is_a_request_or_one_of_two_codes(pdu: bytes) -> None:
    try:
        decoded = decode_request(pdu)
    except ModbusException as refused:
        code = refused.code
    else:
        assert decoded.function == pdu[0]
        return
    assert code in (ExceptionCode.ILLEGAL_FUNCTION, ExceptionCode.ILLEGAL_DATA_VALUE)


def decoded(pdu: bytes) -> ModbusPDU:
    """Return what pymodbus' client makes of an answer."""
    answer = DecodePDU(False).decode(pdu)
    assert answer is not None
    return answer


@given(st.lists(st.integers(0, 0xFFFF), min_size=1, max_size=125), st.sampled_from([3, 4, 23]))
def test_registers_are_what_pymodbus_reads(values: list[int], function: int) -> None:
    data = b"".join(value.to_bytes(2, "big") for value in values)
    answer = decoded(encode_read(function, data))
    assert answer.function_code == function
    assert answer.registers == values


@given(st.binary(min_size=1, max_size=250), st.sampled_from([1, 2]))
def test_bits_are_what_pymodbus_reads(data: bytes, function: int) -> None:
    bits = decoded(encode_read(function, data)).bits
    assert bits == [bool(byte >> bit & 1) for byte in data for bit in range(8)]


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        ("05 00ac ff00", "0500acff00"),
        ("05 00ac 0000", "0500ac0000"),
        ("06 0001 8003", "0600018003"),
        ("0f 0013 000a 02 cd01", "0f0013000a"),
        ("10 0001 0002 04 000a0102", "1000010002"),
        ("16 0004 00f2 0025", "16000400f20025"),
    ],
)
def test_a_write_is_answered_by_what_was_asked_for(text: str, answer: str) -> None:
    asked = request(text)
    assert isinstance(asked, WriteCoils | WriteRegisters | MaskWrite)
    assert encode_write(asked).hex() == answer


@pytest.mark.parametrize(("function", "answer"), [(3, "8302"), (0x63, "e302"), (0x83, "8302")])
def test_an_exception_has_the_function_of_its_request(function: int, answer: str) -> None:
    assert encode_exception(function, ExceptionCode.ILLEGAL_DATA_ADDRESS).hex() == answer


def test_the_server_id_ends_with_the_run_indicator() -> None:
    assert encode_server_id(b"plc", running=True) == b"\x11\x04plc\xff"
    assert encode_server_id(b"plc", running=False) == b"\x11\x04plc\x00"


OBJECTS = {0: b"v", 1: b"p", 2: b"r", 3: b"", 5: b"m"}


@pytest.mark.parametrize(
    ("code", "first", "answer"),
    [
        (1, 0, "2b0e0182000003 000176 010170 020172"),
        (1, 1, "2b0e0182000002 010170 020172"),
        (2, 0, "2b0e0282000005 000176 010170 020172 0300 05016d"),
        (3, 9, "2b0e0382000005 000176 010170 020172 0300 05016d"),
        (4, 5, "2b0e0482000001 05016d"),
    ],
)
def test_identification_by_stream_and_by_object(code: int, first: int, answer: str) -> None:
    encoded = encode_identification(Identify(43, code, first), OBJECTS)
    assert encoded == bytes.fromhex(answer)


def test_an_object_that_is_not_there_is_an_illegal_address() -> None:
    with pytest.raises(ModbusException) as caught:
        encode_identification(Identify(43, 4, 9), OBJECTS)
    assert caught.value.code == ExceptionCode.ILLEGAL_DATA_ADDRESS
