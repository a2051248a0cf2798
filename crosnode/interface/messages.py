"""Messages: the next one, a new one, sent, answered, released, and whole as a STRUCT."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

from crosnode.errors import MessageValueError
from crosnode.interface.handles import (
    MessageHandle,
    RoleHandle,
    handles_of,
    put_text,
    text_at,
)
from crosnode.interface.interface import (
    CROS_TEXT_LENGTH,
    crosERR_CUT,
    crosERR_GONE,
    crosERR_HANDLE,
    crosERR_REFUSED,
    crosERR_STRUCT,
    crosERR_VALUE,
)
from crosnode.node import Publisher, Subscriber
from crosnode.node.service_caller import ServiceCaller
from crosnode.node.service_provider import ServiceProvider
from crosnode.plc.conversion import ConversionContext, tag_conversion
from plcsim.core.controller import Controller
from plcsim.core.errors import ConfigurationError
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK
from st_types.types.derived import ArrayType, StructType, resolve_alias
from st_types.types.values import decode, encode

if TYPE_CHECKING:
    from crosnode.plc.conversion import Conversion
    from plcsim.core.context import Context
    from st_types.types.elementary import DataType


@function("cRosNextMsg")
def next_message(context: Context, handle: int) -> int:
    """Return the next message; the received one before it is released."""
    handles = handles_of(context)
    owner = handles.find(RoleHandle, handle)
    if owner is None:
        return 0
    if isinstance(owner.role, (Subscriber, ServiceCaller)):
        handles.release(owner.current)
        owner.current = 0
    made = _next(owner)
    if made is None:
        return 0
    owner.current = handles.add(made)
    return owner.current


def _next(owner: RoleHandle) -> MessageHandle | None:
    role, types = owner.role, owner.node.types
    if isinstance(role, (Publisher, Subscriber)):
        message = role.pop()
        return MessageHandle(types, role.message_type, message) if message is not None else None
    if isinstance(role, ServiceProvider):
        request = role.pop()
        if request is None:
            return None
        return MessageHandle(types, role.service_type.request, request.request, request)
    if isinstance(role, ServiceCaller) and (reply := role.pop()) is not None:
        response_type = role.service_type.response
        response = reply.response if reply.response is not None else response_type.new()
        error = "" if reply.response is not None else reply.error or "the call failed"
        return MessageHandle(types, response_type, response, error=error)
    return None


@function("cRosNewMsg")
def new_message(context: Context, handle: int) -> int:
    """Return a message with defaults."""
    handles = handles_of(context)
    request = handles.find(MessageHandle, handle)
    if request is not None and request.request is not None:
        found = request.request.response_type
        return handles.add(MessageHandle(request.types, found, found.new()))
    owner = handles.find(RoleHandle, handle)
    role = owner.role if owner else None
    if owner is None or not isinstance(role, (Publisher, ServiceCaller)):
        return 0
    found = role.message_type if isinstance(role, Publisher) else role.service_type.request
    return handles.add(MessageHandle(owner.node.types, found, found.new()))


@function("cRosSendMsg")
def send(context: Context, handle: int, msg: int) -> int:
    """Send a message, call with a request, or answer one; the message is released."""
    handles = handles_of(context)
    found = handles.find(MessageHandle, msg)
    owner = handles.find(RoleHandle, handle)
    request = handles.find(MessageHandle, handle)
    if found is None or (owner is None and (request is None or request.request is None)):
        return crosERR_HANDLE
    try:
        status = _send(owner, found) if owner is not None else _answer(request, found)
    except MessageValueError:
        return crosERR_VALUE
    handles.release(msg)
    if request is not None:
        handles.release(handle)
    return status


def _send(owner: RoleHandle, found: MessageHandle) -> int:
    role = owner.role
    if isinstance(role, Publisher):
        role.send(found.message)
    elif isinstance(role, ServiceCaller):
        role.call(found.message)
    else:
        return crosERR_HANDLE
    return ERR_OK


def _answer(request: MessageHandle | None, found: MessageHandle) -> int:
    assert request is not None
    assert request.request is not None
    is_open = request.request.is_open
    request.request.respond_with(found.message)
    return ERR_OK if is_open else crosERR_GONE


@function("cRosServiceFail")
def fail(context: Context, msg: int, reason: int) -> int:
    """Answer a request with an error; it is released."""
    handles = handles_of(context)
    found = handles.find(MessageHandle, msg)
    if found is None or found.request is None:
        return crosERR_HANDLE
    found.request.fail(text_at(context, reason, CROS_TEXT_LENGTH))
    handles.release(msg)
    return ERR_OK


@function("cRosMsgError")
def error_of(context: Context, msg: int, address: int, size: int) -> int:
    """Return whether a reply is an error, which is written to an address."""
    found = handles_of(context).find(MessageHandle, msg)
    if found is None:
        return crosERR_HANDLE
    if address:
        put_text(context, address, size, found.error)
    return crosERR_REFUSED if found.error else ERR_OK


@function("cRosMessageFree")
def free(context: Context, msg: int) -> int:
    """Release a message."""
    handles = handles_of(context)
    if handles.find(MessageHandle, msg) is None:
        return crosERR_HANDLE
    handles.release(msg)
    return ERR_OK


class StructConversions:
    """How STRUCTs of one controller go with messages; ``context.library(StructConversions)``."""

    def __init__(self, context: Context) -> None:
        self.cuts: Counter[str] = Counter()
        self._context = context
        self._found: dict[tuple[str, int, int], tuple[StructType[Any], Conversion] | None] = {}

    def find(
        self, msg: MessageHandle, address: int, size: int
    ) -> tuple[StructType[Any], Conversion] | None:
        """Return the type of the STRUCT at an address, and how it goes with a message's type.

        None where no variable of this size lies there, or it can never fit.
        """
        key = (msg.message_type.name, address, size)
        if key not in self._found:
            self._found[key] = self._made(msg, address, size)
        return self._found[key]

    def _made(
        self, msg: MessageHandle, address: int, size: int
    ) -> tuple[StructType[Any], Conversion] | None:
        controller = Controller.of(self._context)
        areas = controller.areas if controller else ()
        for area in areas:
            struct = struct_at(area.data_type, address - area.address, size)
            if struct is not None:
                surroundings = ConversionContext(msg.types, self.cuts)
                try:
                    made = tag_conversion(surroundings, msg.message_type, struct, struct.name)
                except ConfigurationError:
                    return None
                return struct, made
        return None


def struct_at(data_type: DataType[Any], offset: int, size: int) -> StructType[Any] | None:
    """Return the STRUCT of ``size`` bytes at an offset in a type, the outermost; None for none."""
    data_type = resolve_alias(data_type)
    if not 0 <= offset < data_type.size:
        return None
    if isinstance(data_type, StructType):
        if offset == 0 and data_type.size == size:
            return data_type
        for member, start in zip(data_type.members, data_type.offsets, strict=True):
            if start <= offset < start + member.data_type.size:
                return struct_at(member.data_type, offset - start, size)
    elif isinstance(data_type, ArrayType):
        return struct_at(data_type.element, offset % resolve_alias(data_type.element).size, size)
    return None


@function("cRosMessageToStruct")
def to_struct(context: Context, msg: int, address: int, size: int) -> int:
    """Fill the STRUCT at an address from a message."""
    found = handles_of(context).find(MessageHandle, msg)
    if found is None:
        return crosERR_HANDLE
    conversions = context.library(StructConversions)
    both = conversions.find(found, address, size)
    if both is None:
        return crosERR_STRUCT
    struct, conversion = both
    cuts = conversions.cuts.total()
    before = decode(struct, context.memory.read(address, size))
    try:
        data = encode(struct, conversion.to_tag(found.message, before))
    except ValueError:
        return crosERR_VALUE
    context.memory.write(address, data)
    return ERR_OK if conversions.cuts.total() == cuts else crosERR_CUT


@function("cRosMessageFromStruct")
def from_struct(context: Context, msg: int, address: int, size: int) -> int:
    """Fill a message from the STRUCT at an address."""
    found = handles_of(context).find(MessageHandle, msg)
    if found is None:
        return crosERR_HANDLE
    both = context.library(StructConversions).find(found, address, size)
    if both is None:
        return crosERR_STRUCT
    struct, conversion = both
    found.message = conversion.to_field(decode(struct, context.memory.read(address, size)))
    return ERR_OK
