"""Commands: what services ask of the scan, as records of a ring.

A record is answered in place: the scan writes its outcome into the head and, where stores were
applied, what the variables held before into the place of the data. So a service can tell what
became of each command, and an audit log what it changed.
"""

from __future__ import annotations

import struct
from enum import Enum
from itertools import groupby
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.control import Action
from st_types.types.layout import align_up

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

HEAD: Final = struct.Struct("<IBBHq")
"""Bytes of the record, itself and padding included; kind, 0 for filling; outcome; number of
operations; when it was applied, nanoseconds since the start on the controller's clock."""

OUTCOME_AT: Final = 5
_TIME = struct.Struct("<q")
_TIME_AT = 8

OPERATION: Final = struct.Struct("<IHH")
MASKS: Final = struct.Struct("<HH")
_FORCE = struct.Struct("<HHH")
_CONTROL = struct.Struct("<qH")
_SAMPLE = struct.Struct("<IIq")
_CANCEL = struct.Struct("<I")
_FOLLOW = struct.Struct("<??")
_SPAN = struct.Struct("<II")
STORE, MASK, SCATTER = 0, 1, 2

MAX_OPERATIONS: Final = 2048
"""Of one command; a Modbus request writes 1,968 coils at most."""


class CommandOutcome(Enum):
    """What has become of a command."""

    WAITING = 0
    APPLIED = 1  # the latest snapshot shows it
    NO_COMMAND = 2
    NO_SUCH_ADDRESS = 3
    NO_SUCH_TAG = 4
    NOT_FORCED = 5
    OVERLAPS = 6
    TOO_MANY = 7
    NOT_HERE = 8
    CONSTANT = 9

    @property
    def is_refused(self) -> bool:
        """True where nothing of the command was applied, and nothing will be."""
        return self not in (CommandOutcome.WAITING, CommandOutcome.APPLIED)

    @property
    def text(self) -> str:
        """The outcome in words."""
        return _TEXTS[self]


_TEXTS: Final = {
    CommandOutcome.WAITING: "it waits",
    CommandOutcome.APPLIED: "it is applied",
    CommandOutcome.NO_COMMAND: "it makes no sense",
    CommandOutcome.NO_SUCH_ADDRESS: "there is no such address",
    CommandOutcome.NO_SUCH_TAG: "there is no such tag",
    CommandOutcome.NOT_FORCED: "it is not forced",
    CommandOutcome.CONSTANT: "it is CONSTANT",
    CommandOutcome.OVERLAPS: "a part of it is forced, or it is a part of a forced tag",
    CommandOutcome.TOO_MANY: "there are too many",
    CommandOutcome.NOT_HERE: "only the virtual clock can do that",
}


_OUTCOMES: Final = tuple(CommandOutcome)


class StoreCommand(NamedTuple):
    """Store ``data`` at a PLC address."""

    address: int
    data: bytes


class Mask(NamedTuple):
    """Set a 16-bit word to ``(word AND and_mask) OR (or_mask AND NOT and_mask)``, in the scan.

    This is Modbus function 22 (MODBUS Application Protocol V1.1b3, 6.16).
    """

    address: int
    and_mask: int
    or_mask: int

    def applied_to(self, word: int) -> int:
        """Return the new value of the word."""
        return (word & self.and_mask) | (self.or_mask & ~self.and_mask & 0xFFFF)


class Scatter(NamedTuple):
    """Store single bytes, each at an address of its own.

    1,968 coils in one request are applied in a tenth of the time that as many stores would take.
    """

    addresses: Sequence[int]
    data: bytes


Operation = StoreCommand | Mask | Scatter


class Write(NamedTuple):
    """Stores that are applied together in one LATCH, or not at all."""

    operations: Sequence[Operation]


class ForceCommand(NamedTuple):
    """Force a tag to the value with these bytes.

    Attributes:
        path: of the tag.
        data: its bytes while it is forced.
        by: who asks, beside the service's name in the logbook and the list of forces.
    """

    path: str
    data: bytes
    by: str = ""


class Release(NamedTuple):
    """Let a forced tag go; "" for all; for ``by`` see `ForceCommand`."""

    path: str
    by: str = ""


class Control(NamedTuple):
    """Ask for an act; see `plcsim.core.control.Request`, for ``by`` `ForceCommand`."""

    action: Action
    argument: int = 0
    by: str = ""


class SampleCommand(NamedTuple):
    """Sample variables from now on into the stream beside the ring.

    Attributes:
        number: above 0, given by the service, which finds its samples by it; a second request of
            a number replaces the first.
        task_class: sampled in PUBLISH of this class, 0 for every class.
        period_ns: at most so often; 0 for every cycle.
        spans: (PLC address, bytes) of the variables, which lie one after another in a sample.
    """

    number: int
    task_class: int
    period_ns: int
    spans: Sequence[tuple[int, int]]


class Cancel(NamedTuple):
    """End a `SampleCommand`; 0 for all of the service, and what it follows."""

    number: int


class Follow(NamedTuple):
    """Have figures of the scan in the stream beside the ring; what is not asked for again ends.

    Attributes:
        cycles: when each program of each cycle ran (`plcsim.shared_image.figures.ClassCycle`).
        histograms: of all task classes and programs, now and then while the scan is idle.
    """

    cycles: bool = False
    histograms: bool = False


class Answer(NamedTuple):
    """What has become of a command.

    Attributes:
        outcome: of the command.
        applied_ns: when, since the start on the controller's clock; 0 where it was not.
        before: the command with what the variables held before in the place of the data; a `Mask`
            has the word in the place of its AND mask.
    """

    outcome: CommandOutcome
    applied_ns: int
    before: Command


Command = Write | ForceCommand | Release | Control | SampleCommand | Cancel | Follow
_KINDS: Final[dict[type, int]] = {
    Write: 1,
    ForceCommand: 2,
    Release: 3,
    Control: 4,
    SampleCommand: 5,
    Cancel: 6,
    Follow: 7,
}
WRITE, _FORCED, _RELEASED, _CONTROLLED, _SAMPLED, _CANCELLED, _FOLLOWED = _KINDS.values()


def outcome_of(record: memoryview) -> CommandOutcome:
    """Return what has become of a record of the ring."""
    return _OUTCOMES[record[OUTCOME_AT]]


def note_time(record: memoryview, time_ns: int) -> None:
    """Note in a record of the ring when it was applied."""
    _TIME.pack_into(record, _TIME_AT, time_ns)


def answer_of(record: bytes) -> Answer:
    """Return the answer in a record.

    Raises:
        ValueError: the record makes no sense.
    """
    (applied_ns,) = _TIME.unpack_from(record, _TIME_AT)
    return Answer(_OUTCOMES[record[OUTCOME_AT]], applied_ns, decode_command(record))


def merged(stores: Iterable[Operation]) -> tuple[Operation, ...]:
    """Return the same operations with those that can be done together made one."""
    return _scattered(_joined(stores))


def _scattered(operations: list[Operation]) -> tuple[Operation, ...]:
    """Make one of stores of single bytes that follow each other."""
    result: list[Operation] = []
    for is_byte, run in groupby(
        operations, lambda o: isinstance(o, StoreCommand) and len(o.data) == 1
    ):
        group = list(run)
        if is_byte and len(group) > 1:
            bytes_ = [o for o in group if isinstance(o, StoreCommand)]
            data = b"".join(o.data for o in bytes_)
            result.append(Scatter(tuple(o.address for o in bytes_), data))
        else:
            result += group
    return tuple(result)


def _joined(stores: Iterable[Operation]) -> list[Operation]:
    """Make one of stores at adjoining addresses."""
    result: list[Operation] = []
    for operation in stores:
        last = result[-1] if result else None
        if (
            isinstance(operation, StoreCommand)
            and isinstance(last, StoreCommand)
            and last.address + len(last.data) == operation.address
        ):
            result[-1] = StoreCommand(last.address, last.data + operation.data)
        else:
            result.append(operation)
    return result


def encode_command(command: Command) -> bytes:
    """Return the record of a command, a multiple of 8 bytes long."""
    match command:
        case Write(operations):
            return _record(WRITE, _operations(operations), len(operations))
        case ForceCommand(path, data, by):
            return _record(_FORCED, _forcing(path, data, by))
        case Release(path, by):
            return _record(_RELEASED, _forcing(path, b"", by))
        case Control(action, argument, by):
            name = by.encode()
            return _record(_CONTROLLED, _CONTROL.pack(argument, len(name)) + name, action.value)
        case SampleCommand(number, task_class, period_ns, spans):
            head = _SAMPLE.pack(number, task_class, period_ns)
            body = head + b"".join(_SPAN.pack(*span) for span in spans)
            return _record(_SAMPLED, body, len(spans))
        case Cancel(number):
            return _record(_CANCELLED, _CANCEL.pack(number))
        case Follow(cycles, histograms):
            return _record(_FOLLOWED, _FOLLOW.pack(cycles, histograms))


def _record(kind: int, body: bytes, count: int = 0) -> bytes:
    size = align_up(HEAD.size + len(body), 8)
    head = HEAD.pack(size, kind, CommandOutcome.WAITING.value, count, 0)
    return head + body.ljust(size - HEAD.size, b"\0")


def _forcing(path: str, data: bytes, by: str) -> bytes:
    name, who = path.encode(), by.encode()
    return _FORCE.pack(len(name), len(data), len(who)) + name + data + who


def _operations(operations: Iterable[Operation]) -> bytes:
    parts: list[bytes] = []
    for operation in operations:
        match operation:
            case StoreCommand(address, data):
                parts += OPERATION.pack(address, len(data), STORE), data
            case Mask(address, and_mask, or_mask):
                masks = MASKS.pack(and_mask, or_mask)
                parts += OPERATION.pack(address, len(masks), MASK), masks
            case Scatter(addresses, data):
                offsets = struct.pack(f"<{len(addresses)}I", *addresses)
                size = len(offsets) + len(data)
                parts += OPERATION.pack(0, size, SCATTER), offsets, data
    return b"".join(parts)


def decode_command(record: bytes) -> Command:
    """Return the command of a record.

    Raises:
        ValueError: the record makes no sense.
    """
    size, kind, _, count, _ = HEAD.unpack_from(record)
    if size != len(record) or count > MAX_OPERATIONS:
        raise ValueError(f"record of {size} bytes with {count} operations")
    try:
        return _decode(kind, count, record)
    except (struct.error, UnicodeDecodeError) as err:
        raise ValueError(f"record of kind {kind}: {err}") from None


def _decode(kind: int, count: int, record: bytes) -> Command:
    if kind == WRITE:
        return Write(_decode_operations(record, count))
    if kind in (_FORCED, _RELEASED):
        lengths = _FORCE.unpack_from(record, HEAD.size)
        path, data, by = _cut(record, HEAD.size + _FORCE.size, lengths)
        if kind == _FORCED:
            return ForceCommand(path.decode(), data, by.decode())
        return Release(path.decode(), by.decode())
    if kind == _CONTROLLED:
        argument, length = _CONTROL.unpack_from(record, HEAD.size)
        (by,) = _cut(record, HEAD.size + _CONTROL.size, (length,))
        return Control(Action(count), argument, by.decode())
    if kind == _SAMPLED:
        number, task_class, period_ns = _SAMPLE.unpack_from(record, HEAD.size)
        if not number or period_ns < 0:
            raise ValueError(f"samples with number {number} every {period_ns} ns")
        at = HEAD.size + _SAMPLE.size
        spans = tuple(_SPAN.unpack_from(record, at + i * _SPAN.size) for i in range(count))
        return SampleCommand(number, task_class, period_ns, spans)
    if kind == _CANCELLED:
        return Cancel(*_CANCEL.unpack_from(record, HEAD.size))
    if kind == _FOLLOWED:
        return Follow(*_FOLLOW.unpack_from(record, HEAD.size))
    raise ValueError(f"record of kind {kind}")


def _cut(record: bytes, at: int, lengths: Iterable[int]) -> list[bytes]:
    """Return parts of a record that follow each other."""
    parts = []
    for length in lengths:
        parts.append(record[at : at + length])
        at += length
    if at > len(record):
        raise ValueError("record ends inside a name or its data")
    return parts


def _decode_operations(record: bytes, count: int) -> tuple[Operation, ...]:
    at = HEAD.size
    operations: list[Operation] = []
    for _ in range(count):
        address, length, kind = OPERATION.unpack_from(record, at)
        at += OPERATION.size
        data = record[at : at + length]
        if len(data) != length:
            raise ValueError("record ends inside its data")
        operations.append(_operation(address, kind, data))
        at += length
    return tuple(operations)


def _operation(address: int, kind: int, data: bytes) -> Operation:
    if kind == STORE:
        return StoreCommand(address, data)
    if kind == MASK and len(data) == MASKS.size:
        return Mask(address, *MASKS.unpack(data))
    if kind == SCATTER and len(data) % 5 == 0:
        count = len(data) // 5
        return Scatter(struct.unpack_from(f"<{count}I", data), data[4 * count :])
    raise ValueError(f"operation of kind {kind} with {len(data)} bytes")
