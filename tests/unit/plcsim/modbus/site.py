"""A controller in virtual time with a Modbus map, and frames to talk to it."""

import os
import struct
from collections.abc import Sequence
from pathlib import Path

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.core.system import State
from plcsim.modbus.map.changes import TagChange
from plcsim.modbus.map.csv_file import read_rows
from plcsim.modbus.map.resolve import resolve
from plcsim.modbus.service.connection import ModbusConnection, ModbusLimits
from plcsim.modbus.service.device import Audit, Device, Origin
from plcsim.modbus.service.handler import AccessRights, Handler
from plcsim.network import VirtualNetwork
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.shared_image import ImageReader, ImageWriter
from plcsim.shared_image.layout import make_file
from st_types import ARRAY, BOOL, INT, REAL, UDINT, UINT, var
from st_types.types.derived import SubrangeType

FILE = Path("tags.csv")
MS = 1_000_000
MAP = """tag,area,offset,bit,type,min,max,access
p.coils[0],co,0,,,,,
p.coils[1],co,1,,,,,
p.coils[2],co,2,,,,,
p.locked,co,3,,,,,ro
p.coils[3],di,0,,,,,
p.cycles,ir,0,,,,,
p.words[1],hr,0,,,,,
p.words[2],hr,1,,,,,
p.real,hr,2,,,,,
p.percent,hr,4,,,,,
p.fixed,hr,5,,,,,ro
p.coils[4],hr,6,3,,,,
p.echo,hr,7,,,,,
p.words[3],hr,10,,,,,
"""


class Site(Program):
    coils = var(ARRAY(BOOL, (0, 7)))
    locked = var(BOOL)
    cycles = var(UDINT)
    words = var(ARRAY(UINT, (1, 200)))
    real = var(REAL)
    percent = var(SubrangeType("Percent", INT, 0, 100))
    fixed = var(UINT, 7)
    echo = var(UINT)

    def cyclic(self) -> None:
        self.cycles += 1
        if self.echo:
            self.echo = 999  # the program makes something else of it


class Log:
    """An audit log that remembers."""

    def __init__(self) -> None:
        self.applied_tags: list[TagChange] = []
        self.refused_codes: list[tuple[str, int]] = []

    def applied(self, origin: Origin, changed: Sequence[TagChange]) -> None:
        self.applied_tags += changed

    def refused(self, origin: Origin, pdu: bytes, exception: int) -> None:
        self.refused_codes.append((pdu.hex(), exception))


class World:
    def __init__(
        self,
        *,
        strict_holes: bool = False,
        limits: ModbusLimits | None = None,
        audit: Audit | None = None,
    ) -> None:
        self.clock = VirtualClock()
        network = VirtualNetwork(self.clock.now_ns).host("192.168.0.10")
        setup = Setup([TaskClassSetup(1, MS, [ProgramSetup("p", PythonCode(Site))])])
        self.plc = make_controller(setup, network=network, clock=self.clock)
        more = "".join(f"p.words[{i}],hr,{i + 100},,,,,\n" for i in range(4, 150))
        points = resolve(read_rows(MAP + more, FILE), self.plc.tags.find, FILE, "ABCD")
        self._limits = limits or ModbusLimits()
        fd = make_file()
        ImageWriter(fd, self.plc, project="virtual", services={"modbus": None})
        self.device = Device(ImageReader(fd, "modbus"), points, strict_holes, audit=audit or Log())
        os.close(fd)
        self.plc.boot()
        self.plc.run(cycles=1)

    def run_a_cycle(self) -> None:
        """Let the scan do a cycle, and look what it has answered."""
        self.plc.run(cycles=1)
        self.device.collect()

    def connect(self, rights: AccessRights | None = None) -> ModbusConnection:
        handler = Handler(self.device, rights or AccessRights())
        return ModbusConnection(handler, self.device, self._limits, self.clock.now_ns())

    def exchange(self, connection: ModbusConnection, data: bytes) -> bytes:
        """Hand requests over and return the answers; the scan runs while writes wait for it."""
        connection.receive(data)
        answers = [connection.step(self.clock.now_ns())]
        while connection.is_waiting or connection.has_more:
            if connection.is_waiting and self.plc.run(cycles=1) is not State.RUN:
                self.device.is_alive = False
            self.device.collect()
            answers.append(connection.step(self.clock.now_ns()))
        return b"".join(answers)

    def ask(
        self, pdu: str | bytes, connection: ModbusConnection | None = None, unit: int = 1
    ) -> str:
        """Return the PDU of the answer as hexadecimal."""
        data = bytes.fromhex(pdu) if isinstance(pdu, str) else pdu
        answer = self.exchange(connection or self.connect(), frame(data, 7, unit))
        ((transaction, answered, body),) = frames(answer)
        assert (transaction, answered) == (7, unit)
        return body.hex()

    def tag(self, path: str) -> object:
        return self.plc.tags.read(self.plc.tags.find(path))


def frame(pdu: bytes, transaction: int = 1, unit: int = 1) -> bytes:
    return struct.pack(">HHHB", transaction, 0, len(pdu) + 1, unit) + pdu


def frames(data: bytes) -> list[tuple[int, int, bytes]]:
    """Return (transaction, unit, PDU) of each frame; the bytes must be whole frames."""
    found = []
    while data:
        transaction, protocol, length, unit = struct.unpack_from(">HHHB", data)
        assert protocol == 0
        assert len(data) >= 6 + length
        found.append((transaction, unit, data[7 : 6 + length]))
        data = data[6 + length :]
    return found
