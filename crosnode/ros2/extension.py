"""The extension of the table [ros2]: checks the entries, hands them to the service."""

from __future__ import annotations

from collections import Counter
from importlib.util import find_spec
from typing import TYPE_CHECKING, Final

from crosnode.errors import CrosnodeError
from crosnode.messages import MessageTypes
from crosnode.plc.bridge_topics import BridgeStatus, StatusTag, age_tag
from crosnode.plc.conversion import ConversionContext, tag_conversion
from crosnode.ros2.settings import Ros2Settings, read_settings
from plcsim.core.errors import ConfigurationError, Findings, TagError
from plcsim.project.extension import Attachment, Extension

if TYPE_CHECKING:
    from crosnode.ros2.shapes import Shapes
    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag
    from plcsim.settings.table import Table

NEEDED: Final = ("cyclonedds", "rosbags")
HINT: Final = "python3 -m pip install 'plcsim[ros2]'"


class Ros2Extension(Extension):
    """Tags to and from topics of ROS 2."""

    def read(self, table: Table) -> Ros2Settings:
        """Return the settings."""
        return read_settings(table)

    def service(self, _settings: Ros2Settings) -> str:
        """Return the module that bridges."""
        return "crosnode.ros2.service"

    def endpoint(self, settings: Ros2Settings) -> str:
        """Return what others need to find it."""
        return f"ROS 2, domain {settings.domain}"

    def attach(self, settings: Ros2Settings, controller: Controller) -> Attachment:
        """Return what the service needs, and the tags that it reads."""
        tags = _checked_tags(settings, controller)
        keys = settings.table
        out = [
            {"topic": topic, "tag": each.tag, "type": each.type_name, "every_ns": each.every_ns,
             "on_change": each.on_change, "status": each.status}
            for topic, each in keys.publish.items()
        ]  # fmt: skip
        incoming = [
            {"topic": topic, "tag": each.tag, "type": each.type_name,
             "timeout_ns": each.timeout_ns, "status": each.status, "age": each.age}
            for topic, each in keys.subscribe.items()
        ]  # fmt: skip
        given: dict[str, object] = {
            "domain": settings.domain,
            "packages": [str(path) for path in keys.packages],
            "publish": out,
            "subscribe": incoming,
            "cycle_ns": min(each.cycle_ns for each in controller.classes),
        }
        return Attachment(given, tags)

    def check(self, settings: Ros2Settings, controller: Controller) -> list[str]:
        """Check the entries against the tags, and types against those of ROS 2."""
        _checked_tags(settings, controller)
        missing = [name for name in NEEDED if find_spec(name) is None]
        if missing:
            return [f"ros2: needs {', '.join(missing)}; {HINT}"]
        return []


def _checked_tags(settings: Ros2Settings, controller: Controller) -> list[Tag]:
    """Return all tags that entries name.

    Raises:
        ConfigurationError: entries that cannot work.
    """
    types, findings, found = MessageTypes(settings.table.packages), Findings(), []
    shapes = _shapes(types)
    entries = (("publish", settings.table.publish), ("subscribe", settings.table.subscribe))
    for key, topics in entries:
        for topic, entry in topics.items():
            try:
                tag = controller.tags.find(entry.tag)
                message_type = types.message(entry.type_name)
                context = ConversionContext(types, Counter())
                tag_conversion(context, message_type, tag.data_type, tag.path)
                StatusTag(controller.tags, entry.status, BridgeStatus.NONE)
                if shapes is not None:
                    shapes.fields(message_type.name)
                age = age_tag(controller.tags, getattr(entry, "age", None))
                status = controller.tags.find(entry.status) if entry.status else None
                found += [each for each in (tag, status, age) if each is not None]
            except (ConfigurationError, CrosnodeError, TagError) as error:
                findings.add(ConfigurationError(f"{settings.file}: ros2.{key}.{topic}: {error}"))
    findings.check()
    return found


def _shapes(types: MessageTypes) -> Shapes | None:
    """Return what knows the types of ROS 2, None where rosbags is not installed."""
    if find_spec("rosbags") is None:
        return None
    # not at the top: the extra need not be installed
    from crosnode.ros2.shapes import Shapes  # noqa: PLC0415

    return Shapes(types)


EXTENSION = Ros2Extension()
