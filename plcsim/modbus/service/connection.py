"""One connection without its socket: bytes in, bytes out, requests in order.

A frame is a 7-byte header (transaction, protocol 0, length, unit) and a PDU. Frames may come in any
pieces, several at once. Writes of one connection may wait for the scan together; a read waits for
the writes before it, so a master reads what it has written.
"""

from __future__ import annotations

import struct
from collections import deque
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.modbus.service.errors import ExceptionCode, ModbusException
from plcsim.modbus.service.handler import Handler, Waiting
from plcsim.modbus.service.pdu import LONGEST_PDU, WRITE_FUNCTIONS, encode_exception
from plcsim.shared_image import CommandOutcome

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.modbus.service.device import Device, PendingWrite

_HEADER: Final = struct.Struct(">HHHB")
WRITES_IN_FLIGHT: Final = 16
"""Of one connection; more wait in its buffer."""

FULL_BUFFER: Final = 4096
"""Bytes that wait to be executed; above, no more should be read from the socket."""


@dataclass(frozen=True)
class ModbusLimits:
    """Settings of all connections."""

    unit_ids: frozenset[int] = frozenset()
    write_timeout_ns: int = 2_000_000_000


class _Frame(NamedTuple):
    transaction: int
    unit: int
    pdu: bytes


class _Write(NamedTuple):
    """A write that is not answered yet; one that was refused has its answer, and no write."""

    frame: _Frame
    write: PendingWrite | None
    answer: Callable[[], bytes]
    until_ns: int


class ModbusConnection:
    """One connection.

    Args:
        handler: executes requests.
        device: tells when writes are done.
        limits: settings.
        now_ns: the present time.

    Attributes:
        fault: why the connection must be closed, "" while it is well.
        last_request_ns: when the last complete request came.
        requests: how many came.
    """

    def __init__(self, handler: Handler, device: Device, limits: ModbusLimits, now_ns: int) -> None:
        self.fault = ""
        self.last_request_ns = now_ns
        self.requests = 0
        self._handler = handler
        self._device = device
        self._limits = limits
        self._buffer = bytearray()
        self._writes: deque[_Write] = deque()
        self._blocked = False

    @property
    def is_full(self) -> bool:
        """True where no more should be read from the socket for now."""
        return len(self._buffer) > FULL_BUFFER

    @property
    def is_waiting(self) -> bool:
        """True while writes wait for the scan; `step` is to be called when it has answered some."""
        return bool(self._writes)

    @property
    def has_more(self) -> bool:
        """True where a complete request waits only for the next `step`."""
        return not self.fault and not self._blocked and self._peek() is not None

    def receive(self, data: bytes) -> None:
        """Take bytes of the peer."""
        self._buffer += data

    def step(self, now_ns: int, requests: int = 64) -> bytes:
        """Execute requests, as many as given at most; return what is to be sent.

        Args:
            now_ns: the present time, of any clock that does not jump.
            requests: bound of the work, so that one peer cannot hold up the others.
        """
        out = [self._finish_writes(now_ns)]
        self._blocked = False
        for _ in range(requests):
            frame = self._peek()
            if frame is None or not self._may_start(frame):
                break
            del self._buffer[: _HEADER.size + len(frame.pdu)]
            self.last_request_ns = now_ns
            self.requests += 1
            out.append(self._start(frame, now_ns))
        return b"".join(out)

    def _peek(self) -> _Frame | None:
        """Return the next complete frame, None where there is none; a bad one is a fault."""
        buffer = self._buffer
        if self.fault or len(buffer) < _HEADER.size:
            return None
        transaction, protocol, length, unit = _HEADER.unpack_from(buffer)
        if protocol != 0:
            self.fault = f"protocol {protocol} is not Modbus"
            return None
        if not 2 <= length <= LONGEST_PDU + 1:
            self.fault = f"a length of {length} is not possible"
            return None
        end = _HEADER.size - 1 + length
        if len(buffer) < end:
            return None
        return _Frame(transaction, unit, bytes(buffer[_HEADER.size : end]))

    def _may_start(self, frame: _Frame) -> bool:
        """Return False for a request that waits for writes before it."""
        if self._writes and (
            len(self._writes) >= WRITES_IN_FLIGHT or frame.pdu[0] not in WRITE_FUNCTIONS
        ):
            self._blocked = True
        return not self._blocked

    def _start(self, frame: _Frame, now_ns: int) -> bytes:
        result: bytes | Waiting
        if self._limits.unit_ids and frame.unit not in self._limits.unit_ids:
            result = self._handler.refuse(
                frame.pdu, frame.unit, ExceptionCode.GATEWAY_TARGET_FAILED
            )
        else:
            result = self._handler.handle(frame.pdu, frame.unit)
        if isinstance(result, Waiting):
            until_ns = now_ns + self._limits.write_timeout_ns
            self._writes.append(_Write(frame, result.write, result.answer, until_ns))
            return b""
        if not self._writes:
            return _framed(frame, result)
        # a refused write is answered after those before it
        self._writes.append(_Write(frame, None, lambda: result, now_ns))
        return b""

    def _finish_writes(self, now_ns: int) -> bytes:
        """Return the answers of the writes that are done, in order."""
        out = []
        while self._writes:
            one = self._writes[0]
            is_waiting = one.write is not None and one.write.outcome is CommandOutcome.WAITING
            if is_waiting and self._device.is_alive and now_ns < one.until_ns:
                break
            self._writes.popleft()
            out.append(_framed(one.frame, self._answer(one)))
        return b"".join(out)

    def _answer(self, one: _Write) -> bytes:
        """Return the answer of a write; one that was not taken in time may still be applied."""
        outcome = CommandOutcome.APPLIED if one.write is None else one.write.outcome
        code = ExceptionCode.SERVER_DEVICE_FAILURE
        if outcome is CommandOutcome.APPLIED:
            try:
                return one.answer()
            except ModbusException as err:
                code = err.code
        elif outcome is CommandOutcome.WAITING and self._device.is_alive:
            code = ExceptionCode.SERVER_DEVICE_BUSY
        return encode_exception(one.frame.pdu[0], code)


def _framed(frame: _Frame, pdu: bytes) -> bytes:
    return _HEADER.pack(frame.transaction, 0, len(pdu) + 1, frame.unit) + pdu
