"""The message types of a recording, and tags as messages of std_msgs."""

from __future__ import annotations

import struct
from functools import cache
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.tag import leaves
from plcsim.recorder.errors import RecordingError
from st_types.types.derived import EnumerationType, StringType, SubrangeType, WStringType
from st_types.types.elementary import ElementaryType, Kind
from st_types.types.values import decode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosbags.typesys.store import Typestore

    from plcsim.core.logbook import Entry
    from plcsim.core.tag import Tag
    from st_types.types.elementary import DataType

CYCLES: Final = "/plcsim/cycles"
HEAD: Final = "/plcsim/recording"
LOGBOOK: Final = "/plcsim/logbook"
DIAGNOSTICS: Final = "/plcsim/diagnostics"
"""Not ``/diagnostics``, which nodes of the project may publish themselves."""

CYCLE_TYPE: Final = "plcsim_msgs/msg/Cycle"
TEXT_TYPE: Final = "std_msgs/msg/String"
LOG_TYPE: Final = "rosgraph_msgs/msg/Log"
LOG_TYPE_2: Final = "rcl_interfaces/msg/Log"
DIAGNOSTIC_TYPE: Final = "diagnostic_msgs/msg/DiagnosticArray"

CYCLE_DEFINITION: Final = """\
# One cycle of a task class, or one step of the controller between cycles.
uint8 CYCLE=0
uint8 BOOT=1
uint8 START=2
uint8 RESUME=3
uint8 SHUTDOWN=4
uint8 CLOSE=5
uint8 RUN=6
uint8 step
uint8 task_class
uint64 number        # of the record, without gaps unless some are lost
uint64 cycle
int64 time_ns        # release, on the controller's clock
int64[] clock        # what clock, network and writers outside gave
uint8[] network
uint8[] writes
bool whole           # variables are all, not only what has changed
uint8[] variables
"""

_CYCLE: Final = struct.Struct("<BBQQq")
_U32: Final = struct.Struct("<I")
_LEVELS: Final = {"information": 2, "warning": 4, "error": 8}
_NAMES: Final = {"?": "Bool", "f": "Float32", "d": "Float64"}


class CycleMessage(NamedTuple):
    """`CYCLE_DEFINITION` as a value; lists as their bytes."""

    step: int
    task_class: int
    number: int
    cycle: int
    time_ns: int
    clock: bytes
    network: bytes
    writes: bytes
    whole: bool
    variables: bytes

    def to_bytes(self) -> bytes:
        """Return the message as ROS 1 writes it."""
        return b"".join(
            (
                _CYCLE.pack(self.step, self.task_class, self.number, self.cycle, self.time_ns),
                _U32.pack(len(self.clock) // 8),
                self.clock,
                _U32.pack(len(self.network)),
                self.network,
                _U32.pack(len(self.writes)),
                self.writes,
                b"\1" if self.whole else b"\0",
                _U32.pack(len(self.variables)),
                self.variables,
            )
        )


def cycle_from(data: bytes) -> CycleMessage:
    """Return the message of `CycleMessage.to_bytes`.

    Raises:
        RecordingError: it is none.
    """
    try:
        step, task_class, number, cycle, time_ns = _CYCLE.unpack_from(data)
        at = _CYCLE.size
        lists = []
        for unit in (8, 1, 1):
            behind = at + 4 + unit * _U32.unpack_from(data, at)[0]
            lists.append(bytes(data[at + 4 : behind]))
            at = behind
        whole = bool(data[at])
        size = _U32.unpack_from(data, at + 1)[0]
    except (struct.error, IndexError):
        raise RecordingError("a message of a cycle is not complete") from None
    at += 5
    if at + size != len(data):
        raise RecordingError("a message of a cycle is not complete")
    clock, network, writes = lists
    return CycleMessage(
        step, task_class, number, cycle, time_ns, clock, network, writes, whole, bytes(data[at:])
    )


def text_message(text: str) -> bytes:
    """Return a std_msgs/String."""
    data = text.encode("utf-8", "replace")
    return _U32.pack(len(data)) + data


def log_message(number: int, bag_ns: int, entry: Entry) -> bytes:
    """Return an entry of the logbook as rosgraph_msgs/Log."""
    stamp = struct.pack("<III", number & 0xFFFF_FFFF, *divmod(bag_ns, 1_000_000_000))
    parts = [text_message(text) for text in ("", entry.source, entry.text, "", "")]
    frame, *rest = parts
    level = struct.pack("<b", _LEVELS[entry.severity.value])
    return b"".join((stamp, frame, level, *rest, b"\0" * 8))


def log_message_2(data: bytes) -> bytes:
    """Return what rcl_interfaces/Log is of a rosgraph_msgs/Log: no seq, frame and topics."""
    level = data[16] * 10 if data[16] < 4 else 30 if data[16] == 4 else 40
    return data[4:12] + bytes([level]) + data[17:-4]


@cache
def typestore(*, ros2: bool = False) -> Typestore:
    """Return the types of ROS 1, or of ROS 2, and of this house.

    Raises:
        RecordingError: rosbags is not installed.
    """
    try:
        from rosbags.typesys import Stores, get_types_from_msg, get_typestore  # noqa: PLC0415
    except ImportError:
        raise RecordingError(
            "bags need the package rosbags: pip install 'plcsim[record]'"
        ) from None
    store = get_typestore(Stores.ROS2_HUMBLE if ros2 else Stores.ROS1_NOETIC)
    store.register(get_types_from_msg(CYCLE_DEFINITION, CYCLE_TYPE))
    return store


def stored_name(name: str) -> str:
    """Return ``std_msgs/msg/String`` for ``std_msgs/String``, as rosbags calls types."""
    package, _, rest = name.partition("/")
    return name if "/" in rest else f"{package}/msg/{rest}"


def register(name: str, definition: str) -> None:
    """Make a type known to ROS 2, with all that it contains.

    Args:
        name: as rosbags calls it.
        definition: text of ROS 1 with that of all its parts.

    Raises:
        RecordingError: rosbags does not understand the text.
    """
    from rosbags.typesys import TypesysError, get_types_from_msg  # noqa: PLC0415

    store = typestore(ros2=True)
    try:
        found = get_types_from_msg(definition, name)
        store.register({key: value for key, value in found.items() if key not in store.types})
    except TypesysError as err:
        raise RecordingError(f"type {name}: {err}") from None


class TagMessages(NamedTuple):
    """How a tag becomes messages.

    Attributes:
        topic: such as ``/tank/level``.
        type_name: such as ``std_msgs/msg/Float32``.
        start: place of its first byte among the recorded variables.
        size: its bytes.
        encode: makes the message of them; None where they are the message.
    """

    topic: str
    type_name: str
    start: int
    size: int
    encode: Callable[[bytes], bytes] | None

    def message(self, data: bytes) -> bytes:
        """Return the message of its bytes."""
        return data if self.encode is None else self.encode(data)


def messages_of(tag: Tag, start: int) -> Iterator[TagMessages]:
    """Return how a tag becomes messages; of a STRUCT or ARRAY each leaf.

    Args:
        tag: of any type.
        start: place of its first byte among the recorded variables.
    """
    for leaf in leaves(tag):
        kind = leaf.data_type
        place = start + leaf.address - tag.address
        name, encode = _std_msgs(kind)
        yield TagMessages(_topic(leaf.path), f"std_msgs/msg/{name}", place, kind.size, encode)


def _topic(path: str) -> str:
    for old, new in ((".", "/"), ("[", "_"), ("]", ""), (",", "_"), (" ", ""), ("-", "m")):
        path = path.replace(old, new)
    return f"/{path}"


def _std_msgs(kind: DataType[Any]) -> tuple[str, Callable[[bytes], bytes] | None]:
    """Return the name of a type of std_msgs, and what makes its message of a value's bytes.

    Both store numbers alike, the least byte first.
    """
    if isinstance(kind, StringType | WStringType):
        return "String", lambda data: text_message(str(decode(kind, data)))
    if isinstance(kind, ElementaryType):
        if kind.kind is Kind.BOOL:
            return "Bool", None
        if kind.kind is Kind.REAL:
            return _NAMES[kind.code], None
    base = kind.base if isinstance(kind, SubrangeType | EnumerationType) else kind
    is_signed = isinstance(base, ElementaryType) and base.code.islower()
    return f"{'' if is_signed else 'U'}Int{8 * kind.size}", None
