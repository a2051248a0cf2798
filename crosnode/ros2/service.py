"""The bridge process; `plcsim.process.service_main` calls `serve`.

Tags are read from snapshots of the shared image and written by commands, so neither DDS nor its
threads come near the scan. A value that no snapshot shows, for it stood less than a turn of this
process, is not published.
"""

from __future__ import annotations

import time
from collections import Counter
from typing import TYPE_CHECKING, Any, Final

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from crosnode.errors import CrosnodeError
from crosnode.messages import MessageTypes, Time
from crosnode.messages.definition import HEADER
from crosnode.plc.bridge_topics import BridgeStatus
from crosnode.plc.conversion import ConversionContext, tag_conversion
from crosnode.ros2.names import topic_name
from crosnode.ros2.structures import Structures
from plcsim.core.errors import ConfigurationError
from plcsim.shared_image import CommandRefused, ImageError, Write
from plcsim.shared_image.command import StoreCommand
from st_types.errors import ValueRangeError
from st_types.types.values import decode, encode

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.process.service_main import Service
    from plcsim.shared_image import ImageReader
    from st_types.types.elementary import DataType

TURN_S: Final = 0.001
DEPTH: Final = 10
"""Samples that wait at each side: the history of ROS 2's default quality of service."""

AGE_NS: Final = 50_000_000
"""Nanoseconds between two writes of an age."""

NS_PER_MS: Final = 1_000_000
LONGEST_MS: Final = 2**31 - 1


def serve(service: Service) -> None:
    """Bridge until asked to stop.

    Raises:
        ConfigurationError: an entry cannot work.
    """
    bridge = Ros2Bridge(service.image, service.given)
    service.serving(bridge.text)
    while not service.is_stopping:
        bridge.turn(time.monotonic_ns(), time.time_ns())
        if bridge.trouble:
            service.failing(bridge.trouble)
            bridge.trouble = ""
        time.sleep(TURN_S)


class ImageTag:
    """A tag of the shared image.

    Args:
        image: that holds it.
        path: of the tag.
    """

    def __init__(self, image: ImageReader, path: str) -> None:
        found = image.directory.find(path)
        self.path = path
        self.data_type: DataType[Any] = found.data_type
        self._image = image
        self._address = found.address
        self._offset = image.directory.offset_of(found.address, found.data_type.size)

    def read(self) -> Any:
        """Return the value of the latest snapshot."""
        _, data = self._image.copy(self._offset, self._offset + self.data_type.size)
        return decode(self.data_type, data)

    def write(self, value: Any) -> None:
        """Have the scan store a value in a LATCH to come.

        Raises:
            ValueRangeError: it does not fit.
            CommandRefused: too many commands wait.
        """
        data = encode(self.data_type, value)
        self._image.send(Write([StoreCommand(self._address, data)]))


class BridgeStatusTag:
    """Tells a tag how an entry does, where one is named."""

    def __init__(self, image: ImageReader, path: str | None) -> None:
        self._tag = ImageTag(image, path) if path else None
        self._told: BridgeStatus | None = None

    def tell(self, status: BridgeStatus) -> None:
        """Write a status that is another one."""
        if self._tag and status is not self._told:
            self._tag.write(int(status))
        self._told = status


class Ros2Bridge:
    """All entries of one project.

    Args:
        image: the shared image.
        given: what the extension handed over.

    Raises:
        ConfigurationError: an entry cannot work.

    Attributes:
        text: what it does, in a line.
        trouble: what went wrong in a turn, "" for nothing.
    """

    def __init__(self, image: ImageReader, given: dict[str, Any]) -> None:
        packages: list[Path] = given["packages"]
        self.types = MessageTypes(packages)
        self.structures = Structures(self.types)
        self.image = image
        self.trouble = ""
        self.participant = DomainParticipant(given["domain"])
        try:
            self._out = [OutgoingTopic(self, entry) for entry in given["publish"]]
            self._in = [IncomingTopic(self, entry) for entry in given["subscribe"]]
        except CrosnodeError as error:
            raise ConfigurationError(f"ros2: {error}") from None
        self.text = (
            f"ROS 2, domain {given['domain']}: {len(self._out)} topics out, {len(self._in)} in"
        )

    def turn(self, now_ns: int, unix_ns: int) -> None:
        """Send what is due, and take what has come.

        Args:
            now_ns: monotonic.
            unix_ns: nanoseconds since 1970, for stamps.
        """
        entries: list[IncomingTopic | OutgoingTopic] = [*self._in, *self._out]
        for each in entries:
            try:
                each.turn(now_ns, unix_ns)
            except (ValueRangeError, CommandRefused, ImageError, ValueError) as error:
                self.trouble = f"ros2: {each.topic}: {error}"


class BridgedTopic:
    """What both directions share.

    Args:
        bridge: whose entry it is.
        entry: as the extension hands it over.
        latched: whether a late subscriber gets the last sample.
    """

    def __init__(self, bridge: Ros2Bridge, entry: dict[str, Any], *, latched: bool) -> None:
        self.topic: str = entry["topic"]
        self.type_name: str = entry["type"]
        self.cuts: Counter[str] = Counter()
        self.tag = ImageTag(bridge.image, entry["tag"])
        self.status = BridgeStatusTag(bridge.image, entry["status"])
        self.structures = bridge.structures
        message_type = bridge.types.message(self.type_name)
        context = ConversionContext(bridge.types, self.cuts)
        self.conversion = tag_conversion(context, message_type, self.tag.data_type, self.tag.path)
        first = message_type.fields[:1]
        self.has_header = bool(first and (first[0].name, first[0].base) == ("header", HEADER))
        structure = bridge.structures.structure(self.type_name)
        self.dds_topic = Topic(bridge.participant, topic_name(self.topic), structure)
        durability = Policy.Durability.TransientLocal if latched else Policy.Durability.Volatile
        self.qos = Qos(
            Policy.Reliability.Reliable(duration(milliseconds=100)),
            Policy.History.KeepLast(DEPTH),
            durability,
        )


class OutgoingTopic(BridgedTopic):
    """A tag that is published."""

    def __init__(self, bridge: Ros2Bridge, entry: dict[str, Any]) -> None:
        super().__init__(bridge, entry, latched=entry["on_change"])
        self._writer = DataWriter(bridge.participant, self.dds_topic, qos=self.qos)
        self._image = bridge.image
        self._every_ns: int = entry["every_ns"]
        self._on_change: bool = entry["on_change"]
        self._next_ns = 0
        self._snapshot = 0
        self._last: Any = None

    def turn(self, now_ns: int, unix_ns: int) -> None:
        """Send the tag where it is time, and there is another snapshot."""
        listened = bool(self._writer.get_matched_subscriptions())
        self.status.tell(BridgeStatus.GOOD if listened else BridgeStatus.NONE)
        snapshot = self._image.latest
        if snapshot in (0, self._snapshot) or now_ns < self._next_ns:
            return
        self._snapshot = snapshot
        self._next_ns = max(self._next_ns + self._every_ns, now_ns - self._every_ns)
        value = self.tag.read()
        if self._on_change and value == self._last:
            return
        self._last = value
        message = self.conversion.to_field(value)
        if self.has_header and not message.header.stamp.to_ns():
            message.header.stamp = Time.from_ns(unix_ns)
        self._writer.write(self.structures.to_structure(self.type_name, message))


class IncomingTopic(BridgedTopic):
    """A tag that takes the newest sample of a topic."""

    def __init__(self, bridge: Ros2Bridge, entry: dict[str, Any]) -> None:
        super().__init__(bridge, entry, latched=False)
        self._reader = DataReader(bridge.participant, self.dds_topic, qos=self.qos)
        self._timeout_ns: int = entry["timeout_ns"]
        self._age = ImageTag(bridge.image, entry["age"]) if entry["age"] else None
        self._since_ns: int | None = None
        self._age_ns = 0
        self._received = BridgeStatus.NONE

    def turn(self, now_ns: int, _unix_ns: int) -> None:
        """Write the newest sample into the tag, and tell how good the value is."""
        if self._since_ns is None:
            self._since_ns = now_ns
        samples = [each for each in self._reader.take(N=DEPTH) if each.sample_info.valid_data]
        if samples:
            cuts = self.cuts.total()
            message = self.structures.to_message(self.type_name, samples[-1])
            self.tag.write(self.conversion.to_tag(message, self.tag.read()))
            self._since_ns = now_ns
            self._received = BridgeStatus.CUT if self.cuts.total() > cuts else BridgeStatus.GOOD
        self._tell(now_ns, now_ns - self._since_ns)

    def _tell(self, now_ns: int, age_ns: int) -> None:
        if self._age and now_ns >= self._age_ns:
            self._age_ns = now_ns + AGE_NS
            self._age.write(min(age_ns // NS_PER_MS, LONGEST_MS))
        status = self._received
        if status is not BridgeStatus.NONE:
            is_old = age_ns > self._timeout_ns if self._timeout_ns else not self._is_connected
            status = BridgeStatus.STALE if is_old else status
        self.status.tell(status)

    @property
    def _is_connected(self) -> bool:
        return bool(self._reader.get_matched_publications())
