"""ROS 1 message and service types: definitions, md5 sums, codec, JSON."""

from crosnode.messages.json_values import from_json, to_json
from crosnode.messages.message import Message
from crosnode.messages.registry import ActionType, MessageType, MessageTypes, ServiceType
from crosnode.messages.text import to_latin1
from crosnode.messages.values import Duration, Time

__all__ = [
    "ActionType",
    "Duration",
    "Message",
    "MessageType",
    "MessageTypes",
    "ServiceType",
    "Time",
    "from_json",
    "to_json",
    "to_latin1",
]
