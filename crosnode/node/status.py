"""What a node tells its program beside messages: the status queue of the thesis (figure 1.7)."""

from __future__ import annotations

from enum import Enum, auto
from typing import NamedTuple


class StatusKind(Enum):
    """What happened."""

    REGISTERED = auto()
    UNREGISTERED = auto()
    REGISTRATION_REFUSED = auto()
    CONNECTED = auto()
    DISCONNECTED = auto()
    PEER_REFUSED = auto()
    """A peer answered our header with ``error``, or we answered one so; or what it called the slave
    API with was beyond our limits."""
    BAD_MESSAGE = auto()
    """A peer sent bytes that are not a message of the type; its connection ended."""
    MASTER_FOUND = auto()
    MASTER_LOST = auto()
    PARAM_SUBSCRIBED = auto()
    PARAM_UPDATE = auto()
    NAME_TAKEN = auto()
    """The master knows another node under this name."""
    SHUTDOWN = auto()
    """Another node, the master or ``rosnode kill`` asked this node to end."""
    NO_IDENT = auto()
    """AsTCP had no ident free for a connection; told once in ten seconds at most."""
    BEHIND = auto()
    """Nine in ten steps of the last second left work for the next; told when it begins."""


class Status(NamedTuple):
    """Something that happened to a node.

    Attributes:
        kind: what.
        name: topic, service, parameter or node it happened to.
        text: more of it, for people.
    """

    kind: StatusKind
    name: str
    text: str = ""
