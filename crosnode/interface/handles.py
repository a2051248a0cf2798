"""What handles stand for: numbers in PLC memory for nodes, topics, messages and fields."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, TypeVar

from crosnode.messages.text import to_latin1
from plcsim.library.idents import Idents

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.messages import Message, MessageType, MessageTypes
    from crosnode.messages.definition import Field
    from crosnode.node import CrosNode, Publisher, Subscriber
    from crosnode.node.parameter import ParameterSubscription
    from crosnode.node.service_caller import ServiceCaller
    from crosnode.node.service_provider import ServiceProvider, ServiceRequest
    from plcsim.core.context import Context

    Role = Publisher | Subscriber | ServiceProvider | ServiceCaller | ParameterSubscription

T = TypeVar("T")

MOST: Final = 65_536
"""Handles at once; a program that releases no messages gets 0 then."""

LATIN_1: Final = "latin-1"


@dataclass(eq=False)
class OwnerHandle:
    """What has handles of its own: a node, an action server or client, a goal.

    Attributes:
        parts: theirs, oldest first.
    """

    parts: list[int] = field(default_factory=list, kw_only=True)


@dataclass(eq=False)
class NodeHandle(OwnerHandle):
    """A node; its parts are what was registered with it.

    Attributes:
        node: the node.
        steps: done behind the node's, each cycle.
        blocks: what a node has once, by its class: its adjustable values.
    """

    node: CrosNode
    steps: list[Callable[[], None]] = field(default_factory=list)
    blocks: dict[type, object] = field(default_factory=dict)

    def block(self, kind: type[T]) -> T | None:
        """Return what the node has of a class, None before it was made."""
        found = self.blocks.get(kind)
        return found if isinstance(found, kind) else None


@dataclass(eq=False)
class RoleHandle:
    """What a program registered, and the message that it got last from it."""

    node: CrosNode
    role: Role
    current: int = 0


@dataclass(eq=False)
class MessageHandle:
    """A message.

    Attributes:
        types: know the types of its fields.
        message_type: its type.
        message: the message itself; of a reply that is an error, one of defaults.
        request: to answer it, where it is one.
        error: in place of a response, "" where it is one.
        fields: handles of its fields.
    """

    types: MessageTypes
    message_type: MessageType
    message: Message
    request: ServiceRequest | None = None
    error: str = ""
    fields: list[int] = field(default_factory=list)


@dataclass(eq=False)
class FieldHandle:
    """A field of a message, or of a message inside it.

    Attributes:
        holder: the message that has it.
        attribute: under which it has it.
        field: as defined.
        types: know its type.
    """

    holder: Message
    attribute: str
    field: Field
    types: MessageTypes


class Handles:
    """The handles of one controller; ``context.library(Handles)``."""

    def __init__(self, context: Context) -> None:
        self._idents: Idents[object] = Idents(context, MOST)

    def add(self, made: object) -> int:
        """Return a new handle, 0 where all are in use."""
        return 0 if self._idents.full else self._idents.add(made)

    def add_part(self, owner: OwnerHandle, made: object) -> int:
        """Return a new handle that is released with its owner, 0 where all are in use."""
        handle = self.add(made)
        if handle:
            owner.parts.append(handle)
        return handle

    def find(self, kind: type[T], handle: int) -> T | None:
        """Return what a handle stands for, None where it is none or of another kind."""
        found = self._idents.find(handle)
        return found if isinstance(found, kind) else None

    def release(self, handle: int) -> None:
        """Forget a handle, and those of what it stands for."""
        found = self._idents.remove(handle)
        if isinstance(found, MessageHandle):
            for each in found.fields:
                self._idents.remove(each)
        elif isinstance(found, RoleHandle):
            self.release(found.current)
        elif isinstance(found, OwnerHandle):
            for each in found.parts:
                self.release(each)


def handles_of(context: Context) -> Handles:
    """Return the handles of a controller."""
    return context.library(Handles)


def text_at(context: Context, address: int, length: int) -> str:
    """Return the STRING at an address."""
    return context.memory.string(address, length).decode(LATIN_1)


def put_text(context: Context, address: int, size: int, text: str) -> bool:
    """Write a text into the STRING at an address, cut to it; return whether it was."""
    if not address or not size:
        return bool(text)
    data = to_latin1(text).encode(LATIN_1)
    context.memory.write(address, data[: size - 1] + b"\0")
    return len(data) >= size
