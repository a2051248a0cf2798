"""Parameters and services of the bridge: a tag that follows a parameter, services by tags."""

from __future__ import annotations

from collections import Counter
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Final

from crosnode.plc.bridge_topics import StatusTag
from crosnode.plc.conversion import Conversion, ConversionContext, tag_conversion
from plcsim.core.errors import ConfigurationError, TagError
from st_types.types.derived import resolve_alias
from st_types.types.elementary import BOOL

if TYPE_CHECKING:
    from crosnode.messages import MessageType
    from crosnode.node import CrosNode
    from crosnode.node.service_caller import ServiceReply
    from crosnode.node.service_provider import ServiceRequest
    from crosnode.plc.settings import CallEntry, ParameterEntry, ServiceEntry
    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag

SET: Final = True
RESET: Final = False
NO_ANSWER: Final = "the program did not answer in time"
NO_RESPONSE: Final = "no response in time"


class CallStatus(IntEnum):
    """What a tag is told of a call: that of a service that a program calls by tags."""

    NONE = 0
    """Not called yet."""
    DONE = 1
    """The response is in its tag."""
    FAILED = 2
    """There is no provider, or it gave no response that the tag could take."""
    RUNNING = 3


def _bool_tag(controller: Controller, path: str) -> Tag:
    """Return the tag of a call.

    Raises:
        ConfigurationError: it is no BOOL.
        TagError: there is no such tag.
    """
    tag = controller.tags.find(path)
    if resolve_alias(tag.data_type) is not BOOL:
        raise ConfigurationError(f"call: tag {path} is {tag.data_type}, not BOOL")
    return tag


def _side(
    controller: Controller, node: CrosNode, message_type: MessageType, path: str | None
) -> tuple[Tag, Conversion] | None:
    """Return the tag of a request or a response and how it fits, None where nobody wants it."""
    if path is None:
        return None
    tag = controller.tags.find(path)
    surroundings = ConversionContext(node.types, Counter())
    return tag, tag_conversion(surroundings, message_type, tag.data_type, path)


class FollowedParameter:
    """A tag that takes the value of a parameter whenever it is set.

    Args:
        controller: whose tag it is.
        node: subscribes to the parameter.
        name: of the parameter, resolved by the node.
        entry: of [ros.parameters].
    """

    def __init__(
        self, controller: Controller, node: CrosNode, name: str, entry: ParameterEntry
    ) -> None:
        self.name = name
        self._tags = controller.tags
        self._tag = controller.tags.find(entry.tag)
        self._param = node.subscribe_param(name, queue_size=1)

    def take(self) -> None:
        """Write a new value into the tag; one that is deleted leaves the tag as it is.

        Raises:
            TagError: the tag cannot take it.
        """
        if self._param.pop() is None or self._param.value == {}:
            return
        value: Any = self._param.value
        if isinstance(value, dict):
            before: Any = self._tags.read(self._tag)
            value = before | value if isinstance(before, dict) else value
        self._tags.write(self._tag, value)


class TagService:
    """A service that a program answers by tags.

    A request goes into its tag, and ``call`` is set; the program resets ``call`` when the tag of
    the response holds the answer.

    Args:
        controller: whose tags they are.
        node: provides the service.
        name: of the service, resolved by the node.
        entry: of [ros.services].

    Raises:
        ConfigurationError: a tag cannot be what it shall be.
        TagError: there is no such tag.
    """

    def __init__(
        self, controller: Controller, node: CrosNode, name: str, entry: ServiceEntry
    ) -> None:
        self.name = name
        self._controller = controller
        self._tags = controller.tags
        self._call = _bool_tag(controller, entry.call)
        self._provider = node.register_service_provider(name, entry.type_name)
        service_type = self._provider.service_type
        self._request = _side(controller, node, service_type.request, entry.request)
        self._response = _side(controller, node, service_type.response, entry.response)
        self._timeout_ns = entry.timeout_ns
        self._running: ServiceRequest | None = None
        self._since_ns = 0

    def take(self) -> None:
        """Hand the next request to the program, where none is under way.

        Raises:
            TagError: the tag cannot take the request, which is refused.
        """
        if self._running is not None:
            return
        request = self._provider.pop()
        if request is None:
            return
        if self._request:
            tag, conversion = self._request
            value = conversion.to_tag(request.request, self._tags.read(tag))
            try:
                self._tags.write(tag, value)
            except ValueError as error:
                request.fail(str(error))
                raise
        self._tags.write(self._call, SET)
        self._running, self._since_ns = request, self._controller.context.release_ns

    def answer(self) -> None:
        """Send the response when the program has it, or an error when it takes too long.

        Raises:
            MessageValueError: the response cannot hold the tag's value; the caller is told.
        """
        request = self._running
        if request is None:
            return
        if not self._tags.read(self._call):
            self._running = None
            self._respond(request)
        elif self._controller.context.release_ns - self._since_ns > self._timeout_ns:
            self._running = None
            self._tags.write(self._call, RESET)
            request.fail(NO_ANSWER)

    def _respond(self, request: ServiceRequest) -> None:
        if self._response is None:
            request.respond()
            return
        tag, conversion = self._response
        try:
            request.respond_with(conversion.to_field(self._tags.read(tag)))
        except ValueError as error:
            request.fail(str(error))
            raise


class CalledService:
    """A service of others that a program calls by tags.

    The program fills the tag of the request and sets ``call``; the response goes into its tag,
    ``status`` is told what came of it (`CallStatus`), and ``call`` is reset.

    Args:
        controller: whose tags they are.
        node: calls the service.
        name: of the service, resolved by the node.
        entry: of [ros.calls].

    Raises:
        ConfigurationError: a tag cannot be what it shall be.
        TagError: there is no such tag.
    """

    def __init__(self, controller: Controller, node: CrosNode, name: str, entry: CallEntry) -> None:
        self.name = name
        self._controller = controller
        self._tags = controller.tags
        self._call = _bool_tag(controller, entry.call)
        self._caller = node.register_service_caller(name, entry.type_name, queue_size=1)
        service_type = self._caller.service_type
        self._request = _side(controller, node, service_type.request, entry.request)
        self._response = _side(controller, node, service_type.response, entry.response)
        self._status = StatusTag(controller.tags, entry.status, CallStatus.NONE)
        self._timeout_ns = entry.timeout_ns
        self._since_ns: int | None = None

    def take(self) -> None:
        """Give the program what came of its call.

        Raises:
            TagError: the tag cannot take the response.
        """
        since_ns = self._since_ns
        if since_ns is None:
            return
        reply = self._caller.pop()
        if reply is not None:
            self._finish(reply)
        elif self._controller.context.release_ns - since_ns > self._timeout_ns:
            self._caller.close()
            self._end(CallStatus.FAILED)
            raise TagError(NO_RESPONSE)

    def _finish(self, reply: ServiceReply) -> None:
        self._end(CallStatus.FAILED)
        if reply.response is None:
            raise TagError(reply.error)
        if self._response:
            tag, conversion = self._response
            self._tags.write(tag, conversion.to_tag(reply.response, self._tags.read(tag)))
        self._status.tell(CallStatus.DONE)

    def call(self) -> None:
        """Call where the program has set ``call``.

        Raises:
            MessageValueError: the request cannot hold the tag's value; nothing is called.
        """
        if self._since_ns is not None or not self._tags.read(self._call):
            return
        self._since_ns = self._controller.context.release_ns
        request = self._caller.new()
        try:
            if self._request:
                tag, conversion = self._request
                request = conversion.to_field(self._tags.read(tag))
            self._caller.call(request)
        except ValueError:
            self._end(CallStatus.FAILED)
            raise
        self._status.tell(CallStatus.RUNNING)

    def _end(self, status: CallStatus) -> None:
        self._since_ns = None
        self._tags.write(self._call, RESET)
        self._status.tell(status)
