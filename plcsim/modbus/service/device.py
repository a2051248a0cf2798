"""The controller as Modbus sees it: areas that are read and written, and whether it is alive."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, NamedTuple, Protocol

from plcsim.core.system import State
from plcsim.modbus.map.changes import changes
from plcsim.modbus.map.errors import IllegalAddress, IllegalValue
from plcsim.modbus.map.reading import Reads
from plcsim.modbus.map.status_block import ControllerStatus
from plcsim.modbus.map.writing import Writes
from plcsim.modbus.service.errors import ExceptionCode, ModbusException
from plcsim.shared_image import (
    CommandOutcome,
    CommandRefused,
    ImageError,
    ImageNotReady,
    ScanWatch,
    Write,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.modbus.map.changes import TagChange
    from plcsim.modbus.map.point import Area, Point
    from plcsim.modbus.map.writing import MapWrite
    from plcsim.shared_image import Answer, Command, Directory

STANDS_STILL: Final = "the scan stands still"


class Origin(NamedTuple):
    """Where a request came from.

    Attributes:
        peer: address and port.
        role: of its certificate, "" for none.
        unit: asked for.
        function: the code of the request.
    """

    peer: str
    role: str
    unit: int
    function: int


@dataclass
class PendingWrite:
    """A write on its way through the scan.

    Attributes:
        ticket: of the shared image.
        origin: where it came from.
        write: what is stored where.
        outcome: what has become of it, as far as `Device.collect` knows.
    """

    ticket: int
    origin: Origin
    write: MapWrite
    outcome: CommandOutcome = CommandOutcome.WAITING


class Audit(Protocol):
    """Who is told of every write (`plcsim.modbus.service.audit`)."""

    def applied(self, origin: Origin, changed: Sequence[TagChange]) -> None:
        """Note a write that the scan has applied."""

    def refused(self, origin: Origin, pdu: bytes, exception: int) -> None:
        """Note a write that was refused; nothing of it was or will be applied."""


class _NoAudit:
    """Keeps no log."""

    def applied(self, origin: Origin, changed: Sequence[TagChange]) -> None:
        pass

    def refused(self, origin: Origin, pdu: bytes, exception: int) -> None:
        pass


class DeviceImage(Protocol):
    """The shared image (`plcsim.shared_image.ImageReader`)."""

    directory: Directory

    @property
    def latest(self) -> int:
        """Number of the latest snapshot."""

    def copy(self, start: int, end: int) -> tuple[int, bytes]:
        """Return a snapshot's number and some of its bytes."""

    def send(self, command: Command) -> int:
        """Queue a command, return its ticket."""

    def take_answer(self, ticket: int) -> Answer | None:
        """Return the answer of the command, once; None while it waits."""


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

    image: DeviceImage
    points: Sequence[Point]
    strict_holes: bool = False
    identity: Identity = field(default_factory=Identity)
    status: Callable[[], ControllerStatus] = no_status
    audit: Audit = field(default_factory=_NoAudit)
    is_alive: bool = True

    def __post_init__(self) -> None:
        self._pending: deque[PendingWrite] = deque()
        directory = self.image.directory
        self.reads = Reads(self.points, directory.offset_of, strict_holes=self.strict_holes)
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
            raise ModbusException(ExceptionCode.SERVER_DEVICE_FAILURE, STANDS_STILL)
        try:
            return self.reads.read(area, address, count, self.image, self.status)
        except IllegalAddress as err:
            raise ModbusException(ExceptionCode.ILLEGAL_DATA_ADDRESS, str(err)) from None
        except ImageNotReady as err:
            raise ModbusException(ExceptionCode.SERVER_DEVICE_BUSY, str(err)) from None
        except ImageError as err:
            raise ModbusException(ExceptionCode.SERVER_DEVICE_FAILURE, str(err)) from None

    def check_read(self, area: Area, address: int, count: int) -> None:
        """Raise ModbusException unless the range can be read."""
        try:
            self.reads.check(area, address, count)
        except IllegalAddress as err:
            raise ModbusException(ExceptionCode.ILLEGAL_DATA_ADDRESS, str(err)) from None

    def write(self, make: Callable[[Writes], MapWrite], origin: Origin) -> PendingWrite:
        """Queue a write, whole.

        Args:
            make: turns the request into stores by the map.
            origin: where the request came from.

        Raises:
            ModbusException: with the code for what is wrong; nothing is written.
        """
        if not self.is_alive:
            raise ModbusException(ExceptionCode.SERVER_DEVICE_FAILURE, STANDS_STILL)
        try:
            write = make(self.writes)
            ticket = self.image.send(Write(write.operations))
        except IllegalAddress as err:
            raise ModbusException(ExceptionCode.ILLEGAL_DATA_ADDRESS, str(err)) from None
        except IllegalValue as err:
            raise ModbusException(ExceptionCode.ILLEGAL_DATA_VALUE, str(err)) from None
        except CommandRefused as err:
            raise ModbusException(ExceptionCode.SERVER_DEVICE_BUSY, str(err)) from None
        except ImageError as err:
            raise ModbusException(ExceptionCode.SERVER_DEVICE_FAILURE, str(err)) from None
        pending = PendingWrite(ticket, origin, write)
        self._pending.append(pending)
        return pending

    def collect(self) -> None:
        """Look which writes the scan has answered, and log those that it has applied.

        Whether their peer is still there makes no difference. To be called when the scan says that
        it has answered some, and now and then.
        """
        waiting: deque[PendingWrite] = deque()
        for pending in self._pending:
            answer = self.image.take_answer(pending.ticket)
            if answer is None:
                waiting.append(pending)
                continue
            pending.outcome = answer.outcome
            write = pending.write
            if answer.outcome is CommandOutcome.APPLIED and isinstance(answer.before, Write):
                changed = changes(write.points, write.operations, answer.before.operations)
                self.audit.applied(pending.origin, changed)
        self._pending = waiting
