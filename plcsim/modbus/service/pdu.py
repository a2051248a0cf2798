"""Requests out of PDUs and answers into PDUs, by pymodbus; nothing else here knows pymodbus.

pymodbus decodes leniently, so what the specification asks of a request (its exact length, quantity
and values) is checked here, in the order of the state diagrams of the MODBUS Application Protocol
V1.1b3, chapter 6: function code, then quantity and length; addresses are checked by the map.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final, NamedTuple

from pymodbus.pdu import (
    ExceptionResponse,
    ModbusPDU,
    bit_message,
    mei_message,
    other_message,
    register_message,
)

from plcsim.modbus.map.point import Area
from plcsim.modbus.service.errors import ExceptionCode, ModbusException

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

LONGEST_PDU: Final = 253
"""Bytes (MODBUS Application Protocol V1.1b3, 4.1)."""

_READ_AREAS: Final = {
    1: Area.COILS,
    2: Area.DISCRETE_INPUTS,
    3: Area.HOLDING_REGISTERS,
    4: Area.INPUT_REGISTERS,
}
WRITE_FUNCTIONS: Final = frozenset((5, 6, 15, 16, 22, 23))
_MEI_IDENTIFICATION: Final = 0x0E


class Read(NamedTuple):
    """Functions 1 to 4."""

    function: int
    area: Area
    address: int
    quantity: int


class WriteCoils(NamedTuple):
    """Functions 5 and 15."""

    function: int
    address: int
    bits: Sequence[bool]


class WriteRegisters(NamedTuple):
    """Functions 6 and 16; ``data`` as on the wire."""

    function: int
    address: int
    data: bytes


class MaskWrite(NamedTuple):
    """Function 22."""

    function: int
    address: int
    and_mask: int
    or_mask: int


class ReadWrite(NamedTuple):
    """Function 23: the write comes first."""

    function: int
    read_address: int
    read_quantity: int
    address: int
    data: bytes


class ReturnQueryData(NamedTuple):
    """Function 8, sub-function 0: the answer is the request."""

    function: int


class ReportServerId(NamedTuple):
    """Function 17."""

    function: int


class Identify(NamedTuple):
    """Function 43, MEI type 14."""

    function: int
    read_code: int
    object_id: int


Request = (
    Read
    | WriteCoils
    | WriteRegisters
    | MaskWrite
    | ReadWrite
    | ReturnQueryData
    | ReportServerId
    | Identify
)


def decode_request(pdu: bytes) -> Request:
    """Return the request in a PDU.

    Args:
        pdu: function code and data, at least one byte.

    Raises:
        ModbusException: the function is not there, or length, quantity or value are wrong.
    """
    decode = _DECODERS.get(pdu[0])
    if decode is None:
        raise ModbusException(ExceptionCode.ILLEGAL_FUNCTION)
    try:
        return decode(pdu[0], pdu[1:])
    except (ValueError, struct.error):  # pymodbus: a quantity, or too few bytes
        raise ModbusException(ExceptionCode.ILLEGAL_DATA_VALUE) from None


def _require(condition: bool) -> None:
    if not condition:
        raise ModbusException(ExceptionCode.ILLEGAL_DATA_VALUE)


_READ_REQUESTS: Final = {
    1: bit_message.ReadCoilsRequest,
    2: bit_message.ReadDiscreteInputsRequest,
    3: register_message.ReadHoldingRegistersRequest,
    4: register_message.ReadInputRegistersRequest,
}


def _read(function: int, data: bytes) -> Request:
    _require(len(data) == 4)
    request = _READ_REQUESTS[function]()
    request.decode(data)
    return Read(function, _READ_AREAS[function], request.address, request.count)


def _write_coil(function: int, data: bytes) -> Request:
    _require(len(data) == 4 and data[2:] in (b"\xff\0", b"\0\0"))
    request = bit_message.WriteSingleCoilRequest()
    request.decode(data)
    return WriteCoils(function, request.address, request.bits)


def _write_register(function: int, data: bytes) -> Request:
    _require(len(data) == 4)
    request = register_message.WriteSingleRegisterRequest()
    request.decode(data)
    return WriteRegisters(function, request.address, data[2:])


def _write_coils(function: int, data: bytes) -> Request:
    request = bit_message.WriteMultipleCoilsRequest()
    request.decode(data)
    size = -(-request.count // 8)
    _require(request.count <= 0x7B0 and request.byte_count == size == len(data) - 5)
    return WriteCoils(function, request.address, request.bits)


def _write_registers(function: int, data: bytes) -> Request:
    request = register_message.WriteMultipleRegistersRequest()
    request.decode(data)
    size = 2 * request.count
    _require(1 <= request.count <= 0x7B and request.byte_count == size == len(data) - 5)
    return WriteRegisters(function, request.address, data[5:])


def _mask_write(function: int, data: bytes) -> Request:
    _require(len(data) == 6)
    request = register_message.MaskWriteRegisterRequest()
    request.decode(data)
    return MaskWrite(function, request.address, request.and_mask, request.or_mask)


def _read_write(function: int, data: bytes) -> Request:
    request = register_message.ReadWriteMultipleRegistersRequest()
    request.decode(data)
    size = 2 * request.write_count
    _require(1 <= request.write_count <= 0x79)
    _require(request.write_byte_count == size == len(data) - 9)
    return ReadWrite(
        function, request.read_address, request.read_count, request.write_address, data[9:]
    )


def _diagnostics(function: int, data: bytes) -> Request:
    _require(len(data) >= 2)
    if data[:2] != b"\0\0":
        raise ModbusException(ExceptionCode.ILLEGAL_FUNCTION)
    return ReturnQueryData(function)


def _report_server_id(function: int, data: bytes) -> Request:
    _require(not data)
    return ReportServerId(function)


def _identify(function: int, data: bytes) -> Request:
    _require(len(data) >= 1)
    if data[0] != _MEI_IDENTIFICATION:
        raise ModbusException(ExceptionCode.ILLEGAL_FUNCTION)
    _require(len(data) == 3 and 1 <= data[1] <= 4)
    request = mei_message.ReadDeviceInformationRequest()
    request.decode(data)
    return Identify(function, data[1], request.object_id)


_DECODERS: Final[Mapping[int, Callable[[int, bytes], Request]]] = {
    **dict.fromkeys(_READ_REQUESTS, _read),
    5: _write_coil,
    6: _write_register,
    8: _diagnostics,
    15: _write_coils,
    16: _write_registers,
    17: _report_server_id,
    22: _mask_write,
    23: _read_write,
    43: _identify,
}


def encode_exception(function: int, code: ExceptionCode) -> bytes:
    """Return an exception response; its function code is the request's with the high bit set."""
    response = ExceptionResponse(function & 0x7F, code)
    return bytes([response.function_code]) + response.encode()


def encode_read(function: int, data: bytes) -> bytes:
    """Return the answer to functions 1 to 4 and 23.

    pymodbus would take the bytes apart into numbers and put them together again one by one; here
    they are already as on the wire. A test decodes such answers by pymodbus.
    """
    return bytes((function, len(data))) + data


def encode_write(request: WriteCoils | WriteRegisters | MaskWrite) -> bytes:
    """Return the answer to a write: what was asked for, never what the program made of it."""
    response: ModbusPDU
    if isinstance(request, MaskWrite):
        response = register_message.MaskWriteRegisterResponse(*request[1:])
    elif request.function == 5 and isinstance(request, WriteCoils):
        response = bit_message.WriteSingleCoilResponse(address=request.address, bits=request.bits)
    elif isinstance(request, WriteCoils):
        count = len(request.bits)
        response = bit_message.WriteMultipleCoilsResponse(address=request.address, count=count)
    elif request.function == 6:
        response = register_message.WriteSingleRegisterResponse(
            address=request.address, registers=[int.from_bytes(request.data, "big")]
        )
    else:
        response = register_message.WriteMultipleRegistersResponse(
            address=request.address, count=len(request.data) // 2
        )
    return bytes([request.function]) + response.encode()


def encode_server_id(identifier: bytes, *, running: bool) -> bytes:
    """Return the answer to function 17."""
    response = other_message.ReportDeviceIdResponse(identifier=identifier, status=running)
    return bytes([response.function_code]) + response.encode()


def encode_identification(request: Identify, objects: Mapping[int, bytes]) -> bytes:
    """Return the answer to function 43/14.

    Args:
        request: with read code 1 to 3 for a stream of objects, 4 for one of them.
        objects: by object id; 0 to 2 are the basic ones, up to 6 the regular ones.

    Raises:
        ModbusException: the one object is not there.
    """
    if request.read_code == 4:
        if request.object_id not in objects:
            raise ModbusException(ExceptionCode.ILLEGAL_DATA_ADDRESS)
        chosen = {request.object_id: objects[request.object_id]}
    else:
        last = 2 if request.read_code == 1 else 0xFF
        # an unknown first object starts the stream again (chapter 6.21)
        first = request.object_id if request.object_id in objects else 0
        chosen = {number: value for number, value in objects.items() if first <= number <= last}
    response = mei_message.ReadDeviceInformationResponse(request.read_code, chosen)
    response.conformity = 0x82  # regular identification, stream and individual access
    return bytes([response.function_code]) + response.encode()
