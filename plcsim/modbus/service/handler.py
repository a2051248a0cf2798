"""One request executed: the answer, or a write that waits for the scan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from plcsim.modbus.map.point import Area
from plcsim.modbus.service import pdu as codec
from plcsim.modbus.service.device import Origin
from plcsim.modbus.service.errors import ExceptionCode, ModbusException

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.modbus.map.writing import MapWrite, Writes
    from plcsim.modbus.service.device import Device, PendingWrite


@dataclass(frozen=True)
class Waiting:
    """A write that is queued; ``answer`` gives its response once the scan has shown it.

    ``answer`` may raise ModbusException: the read of function 23 comes after its write.
    """

    write: PendingWrite
    answer: Callable[[], bytes]


@dataclass(frozen=True)
class AccessRights:
    """What a peer may do; a function it may not use is answered as one that is not there."""

    may_read: bool = True
    may_write: bool = True

    def allow(self, function: int) -> bool:
        """Return True where the peer may use a function."""
        return self.may_write if function in codec.WRITE_FUNCTIONS else self.may_read


class Handler:
    """Executes the requests of one peer on a device.

    Args:
        device: that is read and written.
        rights: of the peer.
        peer: address and port, for the audit log.
        role: likewise.
    """

    def __init__(
        self, device: Device, rights: AccessRights, peer: str = "", role: str = ""
    ) -> None:
        self._device = device
        self._rights = rights
        self._peer = peer
        self._role = role

    def handle(self, pdu: bytes, unit: int) -> bytes | Waiting:
        """Return the answer to a request, an exception response where it is refused."""
        if not self._rights.allow(pdu[0]):
            return self.refuse(pdu, unit, ExceptionCode.ILLEGAL_FUNCTION)
        try:
            return self._execute(codec.decode_request(pdu), pdu, unit)
        except ModbusException as err:
            return self.refuse(pdu, unit, err.code)

    def refuse(self, pdu: bytes, unit: int, code: ExceptionCode) -> bytes:
        """Return an exception response; a write that is refused is noted."""
        if pdu[0] in codec.WRITE_FUNCTIONS:
            self._device.audit.refused(self._origin(pdu[0], unit), pdu, code)
        return codec.encode_exception(pdu[0], code)

    def _origin(self, function: int, unit: int) -> Origin:
        return Origin(self._peer, self._role, unit, function)

    def _execute(self, request: codec.Request, pdu: bytes, unit: int) -> bytes | Waiting:
        match request:
            case codec.Read(function, area, address, quantity):
                return codec.encode_read(function, self._device.read(area, address, quantity))
            case codec.WriteCoils(_, address, bits):
                return self._write(request, unit, lambda writes: writes.coils(address, bits))
            case codec.WriteRegisters(_, address, data):
                return self._write(request, unit, lambda writes: writes.registers(address, data))
            case codec.MaskWrite(_, address, and_mask, or_mask):
                return self._write(
                    request, unit, lambda writes: writes.mask(address, and_mask, or_mask)
                )
            case codec.ReadWrite():
                return self._read_write(request, unit)
            case codec.ReturnQueryData():
                return pdu
            case codec.ReportServerId():
                running = self._device.is_alive
                return codec.encode_server_id(self._device.identity.server_id, running=running)
        return codec.encode_identification(request, self._device.identity.objects)

    def _write(
        self,
        request: codec.WriteCoils | codec.WriteRegisters | codec.MaskWrite,
        unit: int,
        make: Callable[[Writes], MapWrite],
    ) -> Waiting:
        write = self._device.write(make, self._origin(request.function, unit))
        return Waiting(write, lambda: codec.encode_write(request))

    def _read_write(self, request: codec.ReadWrite, unit: int) -> Waiting:
        """Refuse before writing what could not be read afterwards."""
        device, area = self._device, Area.HOLDING_REGISTERS
        device.check_read(area, request.read_address, request.read_quantity)
        write = device.write(
            lambda writes: writes.registers(request.address, request.data),
            self._origin(request.function, unit),
        )

        def answer() -> bytes:
            data = device.read(area, request.read_address, request.read_quantity)
            return codec.encode_read(request.function, data)

        return Waiting(write, answer)
