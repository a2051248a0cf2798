"""The controller as Modbus sees it: areas that are read and written, and whether it is alive."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, Protocol

from plcsim.core.system import State
from plcsim.modbus.map.errors import IllegalAddress, IllegalValue
from plcsim.modbus.map.reading import Reads
from plcsim.modbus.map.status_block import ControllerStatus
from plcsim.modbus.map.writing import Writes
from plcsim.modbus.service.errors import Code, ModbusException
from plcsim.shared_image import CommandRefused, ImageError, ImageNotReady, ScanWatch

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.modbus.map.point import Area, Point
    from plcsim.shared_image import Command, Directory

STANDS_STILL: Final = "the scan stands still"


class Image(Protocol):
    """The shared image (`plcsim.shared_image.ImageReader`)."""

    directory: Directory

    @property
    def latest(self) -> int:
        """Number of the latest snapshot."""

    def copy(self, start: int, end: int) -> tuple[int, bytes]:
        """Return a snapshot's number and some of its bytes."""

    def send(self, command: Command) -> int:
        """Queue a command, return its ticket."""

    def is_acknowledged(self, ticket: int) -> bool:
        """Return True once the latest snapshot shows the command."""


def no_status() -> ControllerStatus:
    """Return the status of a controller without a status page."""
    return ControllerStatus()


@dataclass(frozen=True)
class Identity:
    """What functions 17 and 43/14 answer."""

    product: str = "plcsim"
    revision: str = "0"
    project: str = ""

    @property
    def server_id(self) -> bytes:
        """The identifier of function 17."""
        return _short(f"{self.product} {self.project}".strip())

    @property
    def objects(self) -> dict[int, bytes]:
        """The objects of function 43/14, by id."""
        values = (
            "plcsim",
            self.product,
            self.revision,
            "",
            self.product,
            self.project,
            self.project,
        )
        return {number: _short(value) for number, value in enumerate(values)}


def _short(text: str) -> bytes:
    """Return at most 32 bytes, so that all objects fit into one answer."""
    return text.encode("ascii", "replace")[:32]


@dataclass
class Device:
    """One controller and its map.

    Args:
        image: where values come from and commands go.
        points: the map.
        strict_holes: see `plcsim.modbus.map.reading.Reads`.
        identity: answers functions 17 and 43/14.
        status: what the status block shows.

    Attributes:
        is_alive: the scan has published lately; kept up to date by `tick`.
    """

    image: Image
    points: Sequence[Point]
    strict_holes: bool = False
    identity: Identity = field(default_factory=Identity)
    status: Callable[[], ControllerStatus] = no_status
    is_alive: bool = True

    def __post_init__(self) -> None:
        directory = self.image.directory
        self.reads = Reads(self.points, directory.place_of, strict_holes=self.strict_holes)
        self.writes = Writes(self.points)
        self._watch = ScanWatch(directory.cycle_ns)

    def tick(self, now_ns: int) -> None:
        """Look whether the scan still publishes; to be called several times a second."""
        self.is_alive = self._watch.is_alive(self.image.latest, now_ns)

    def read(self, area: Area, address: int, count: int) -> bytes:
        """Return registers as on the wire, or packed bits; in SERVICE those of the last cycle.

        Raises:
            ModbusException: with the code for what is wrong.
        """
        if not self.is_alive and self.status().state != State.SERVICE.value:
            raise ModbusException(Code.SERVER_DEVICE_FAILURE, STANDS_STILL)
        try:
            return self.reads.read(area, address, count, self.image, self.status)
        except IllegalAddress as err:
            raise ModbusException(Code.ILLEGAL_DATA_ADDRESS, str(err)) from None
        except ImageNotReady as err:
            raise ModbusException(Code.SERVER_DEVICE_BUSY, str(err)) from None
        except ImageError as err:
            raise ModbusException(Code.SERVER_DEVICE_FAILURE, str(err)) from None

    def check_read(self, area: Area, address: int, count: int) -> None:
        """Raise ModbusException unless the range can be read."""
        try:
            self.reads.check(area, address, count)
        except IllegalAddress as err:
            raise ModbusException(Code.ILLEGAL_DATA_ADDRESS, str(err)) from None

    def write(self, make: Callable[[Writes], Command]) -> int:
        """Queue a write, whole; return its ticket.

        Args:
            make: turns the request into a command by the map.

        Raises:
            ModbusException: with the code for what is wrong; nothing is written.
        """
        if not self.is_alive:
            raise ModbusException(Code.SERVER_DEVICE_FAILURE, STANDS_STILL)
        try:
            return self.image.send(make(self.writes))
        except IllegalAddress as err:
            raise ModbusException(Code.ILLEGAL_DATA_ADDRESS, str(err)) from None
        except IllegalValue as err:
            raise ModbusException(Code.ILLEGAL_DATA_VALUE, str(err)) from None
        except CommandRefused as err:
            raise ModbusException(Code.SERVER_DEVICE_BUSY, str(err)) from None
        except ImageError as err:
            raise ModbusException(Code.SERVER_DEVICE_FAILURE, str(err)) from None

    def is_written(self, ticket: int) -> bool:
        """Return True once the program has the write and the latest snapshot shows it."""
        return self.image.is_acknowledged(ticket)
