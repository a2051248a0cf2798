"""Names of topics and types as ROS 2 gives them to DDS.

Source: design.ros2.org, "Topic and Service name mapping to DDS"; types as rosidl's DDS generators
name them.
"""

from __future__ import annotations

from crosnode.messages.definition import split_type_name


def topic_name(topic: str) -> str:
    """Return the DDS topic of a ROS topic: ``rt/chatter`` for ``/chatter``."""
    return f"rt/{topic.lstrip('/')}"


def type_name(name: str) -> str:
    """Return the DDS type of a message: ``pkg::msg::dds_::Type_`` for ``pkg/Type``."""
    package, base = split_type_name(name)
    return f"{package}::msg::dds_::{base}_"
