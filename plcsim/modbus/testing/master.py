"""A Modbus master for tests: the project's map, read and written as an HMI does it.

Requests go to the handler of the Modbus service, over the shared image, without a socket. A read
takes no time. A write runs the controller until the PUBLISH that shows it, as the service answers
no earlier.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

from plcsim.core.suggestion import did_you_mean
from plcsim.core.system import State
from plcsim.modbus.map.load import load_map
from plcsim.modbus.map.point import Area
from plcsim.modbus.map.status_block import ControllerStatus
from plcsim.modbus.service.connection import ModbusConnection, ModbusLimits
from plcsim.modbus.service.device import Device, Identity
from plcsim.modbus.service.errors import ExceptionCode, ModbusException
from plcsim.modbus.service.handler import AccessRights, Handler
from plcsim.modbus.testing.registers import from_registers, to_registers
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.modbus.map.point import Point
    from plcsim.testing.plc import Plc

__tracebackhide__ = True

TABLE = "modbus"
HEADER = struct.Struct(">HHHB")
"""Transaction, protocol, length, unit."""

EXCEPTION = 0x80
"""Added to the function code of an answer that refuses (MODBUS Application Protocol, 7)."""

READ = {
    Area.COILS: 1,
    Area.DISCRETE_INPUTS: 2,
    Area.HOLDING_REGISTERS: 3,
    Area.INPUT_REGISTERS: 4,
}
WRITE_COILS, WRITE_REGISTERS, MASK_WRITE = 15, 16, 22


class Modbus:
    """A master that is connected to the controller under test; what the fixture ``modbus`` is.

    Addresses are offsets of the protocol, from 0. A request that the server refuses raises
    `ModbusException`, whose ``code`` is that of the answer. In SERVICE and after EXIT all are
    answered SERVER_DEVICE_FAILURE, as they are 250 ms after the scan has stopped.

    Args:
        plc: the controller under test; its project has a table [modbus].

    Raises:
        PlcTestError: it has none.
        TagMapError: the map is wrong; file and line are named.
    """

    def __init__(self, plc: Plc) -> None:
        image = plc.image.reader(TABLE)
        settings, folder, _ = plc.settings[TABLE]
        controller = plc.controller
        points = load_map(settings, folder, controller.tags, controller.areas).points
        # a slow project needs longer, as in plcsim.modbus.service.server
        timeout_ns = max(settings.write_timeout_ns, 3 * image.directory.cycle_ns)
        self._plc = plc
        self._image = image
        self._limits = ModbusLimits(frozenset(settings.unit_ids), timeout_ns)
        self._unit = min(settings.unit_ids, default=1)
        self._rights = AccessRights(may_write=not settings.read_only)
        self._device = Device(
            image, points, settings.strict_holes, Identity(project=plc.name), self._status
        )
        self._by_tag: dict[str, list[Point]] = {}
        for point in points:
            self._by_tag.setdefault(point.tag.upper(), []).append(point)

    # By tag

    def read(self, tag: str) -> Any:
        """Return the value of a tag as an HMI shows it: from its registers, scaled.

        A tag that lies at several addresses is read at the first one in the map.

        Raises:
            PlcTestError: the map does not have the tag.
            ModbusException: the read is refused.
        """
        point = self._point(tag, lambda point: point.access != "wo")
        what, area = f"read of {tag}", Area(point.area)
        if not area.has_registers:
            return self._read_bits(area, point.offset, 1, what)[0]
        return from_registers(point, self._read_data(area, point.offset, point.registers, what))

    def write(self, tag: str, value: bool | float | str) -> None:
        """Write a tag as an HMI does: scaled, into its registers, at its first writable address.

        Raises:
            PlcTestError: the map does not have the tag, or its registers cannot hold the value.
            ModbusException: the write is refused.
        """
        point = self._point(tag, lambda point: point.is_writable and Area(point.area).is_writable)
        what = f"write of {tag} = {value!r}"
        if not Area(point.area).has_registers:
            self._write_bits(point.offset, [bool(value)], what)
        elif point.bit >= 0:
            bit = 1 << point.bit
            mask = struct.pack(">HHH", point.offset, 0xFFFF ^ bit, bit if value else 0)
            self._ask(bytes([MASK_WRITE]) + mask, what)
        else:
            self._write_data(point.offset, to_registers(point, value), what)

    def _point(self, tag: str, suits: Callable[[Point], bool]) -> Point:
        points = self._by_tag.get(tag.upper())
        if points is None:
            names = {point.tag: None for each in self._by_tag.values() for point in each}
            near = did_you_mean(tag, names, most=3)
            raise PlcTestError(f"{tag} is not in the map of [modbus]{near}")
        # where none suits, the server says so
        return next(filter(suits, points), points[0])

    # By address

    def read_coils(self, address: int, count: int = 1) -> list[bool]:
        """Read coils; raises ModbusException where that is refused, as all of these."""
        return self._read_bits(Area.COILS, address, count)

    def read_discrete_inputs(self, address: int, count: int = 1) -> list[bool]:
        """Read discrete inputs."""
        return self._read_bits(Area.DISCRETE_INPUTS, address, count)

    def read_holding_registers(self, address: int, count: int = 1) -> list[int]:
        """Read holding registers, as unsigned numbers of 16 bits."""
        return _words(self._read_data(Area.HOLDING_REGISTERS, address, count))

    def read_input_registers(self, address: int, count: int = 1) -> list[int]:
        """Read input registers, as unsigned numbers of 16 bits."""
        return _words(self._read_data(Area.INPUT_REGISTERS, address, count))

    def write_coils(self, address: int, values: Sequence[bool]) -> None:
        """Write coils, all in one cycle."""
        self._write_bits(address, values)

    def write_registers(self, address: int, values: Sequence[int]) -> None:
        """Write holding registers, all in one cycle; numbers are unsigned, of 16 bits."""
        self._write_data(address, struct.pack(f">{len(values)}H", *values))

    def request(self, pdu: bytes, unit: int | None = None) -> bytes:
        """Send any request and return the PDU of the answer, also of one that refuses.

        Args:
            pdu: function code and data, right or wrong.
            unit: asked for; by default one that is answered.

        Raises:
            PlcTestError: the server closes the connection for what it was sent.
            ControllerFault: a program failed before a write was answered.
        """
        plc, device = self._plc, self._device
        device.is_alive = plc.controller.state is State.RUN
        # a connection of its own: an answer that never came cannot be taken for another one
        handler = Handler(device, self._rights)
        connection = ModbusConnection(handler, device, self._limits, plc.clock.now_ns())
        unit = self._unit if unit is None else unit
        connection.receive(HEADER.pack(1, 0, len(pdu) + 1, unit) + pdu)
        answer = bytearray()

        def is_answered() -> bool:
            device.collect()
            answer.extend(connection.step(plc.clock.now_ns()))
            return bool(answer or connection.fault)

        if not is_answered() and not plc.advance(self._limits.write_timeout_ns, is_answered):
            is_answered()
        if connection.fault:
            raise PlcTestError(f"the server closes the connection: {connection.fault}")
        return bytes(answer[HEADER.size :])

    def _read_bits(self, area: Area, address: int, count: int, what: str = "") -> list[bool]:
        data = self._ask(struct.pack(">BHH", READ[area], address, count), what)[2:]
        return [bool(data[index // 8] >> index % 8 & 1) for index in range(count)]

    def _read_data(self, area: Area, address: int, count: int, what: str = "") -> bytes:
        return self._ask(struct.pack(">BHH", READ[area], address, count), what)[2:]

    def _write_bits(self, address: int, values: Sequence[bool], what: str = "") -> None:
        bits = sum(1 << index for index, value in enumerate(values) if value)
        size = -(-len(values) // 8)
        head = struct.pack(">BHHB", WRITE_COILS, address, len(values), size)
        self._ask(head + bits.to_bytes(size, "little"), what)

    def _write_data(self, address: int, data: bytes, what: str = "") -> None:
        head = struct.pack(">BHHB", WRITE_REGISTERS, address, len(data) // 2, len(data))
        self._ask(head + data, what)

    def _ask(self, pdu: bytes, what: str) -> bytes:
        answer = self.request(pdu)
        if not answer[0] & EXCEPTION:
            return answer
        code = ExceptionCode(answer[1])
        what = what or f"function {pdu[0]} at {int.from_bytes(pdu[1:3])}"
        why = "" if self._image.latest else " (no cycle has run yet)"
        raise ModbusException(code, f"{what}: {code.name}{why}")

    def _status(self) -> ControllerStatus:
        """Return what the status block shows; times of execution are not those of any machine."""
        first = self._plc.controller.classes[0]
        state = self._plc.controller.state
        return ControllerStatus(
            state.value,
            first.cycles,
            missed=first.missed,
            layout_hash=self._image.layout_hash,
        )


def _words(data: bytes) -> list[int]:
    return list(struct.unpack(f">{len(data) // 2}H", data))
