"""Parameters and services of the bridge: a tag that follows a parameter, a service by tags."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, Final

from crosnode.plc.conversion import Conversion, ConversionContext, tag_conversion
from plcsim.core.errors import ConfigurationError
from st_types.types.derived import resolve_alias
from st_types.types.elementary import BOOL

if TYPE_CHECKING:
    from crosnode.messages import MessageType
    from crosnode.node import CrosNode
    from crosnode.node.service_provider import ServiceRequest
    from crosnode.plc.settings import ParameterEntry, ServiceEntry
    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag

SET: Final = True
RESET: Final = False
NO_ANSWER: Final = "the program did not answer in time"


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
        self._call = self._tags.find(entry.call)
        if resolve_alias(self._call.data_type) is not BOOL:
            raise ConfigurationError(f"call: tag {entry.call} is {self._call.data_type}, not BOOL")
        self._provider = node.register_service_provider(name, entry.type_name)
        service_type = self._provider.service_type
        self._request = self._side(node, service_type.request, entry.request)
        self._response = self._side(node, service_type.response, entry.response)
        self._timeout_ns = entry.timeout_ns
        self._running: ServiceRequest | None = None
        self._since_ns = 0

    def _side(
        self, node: CrosNode, message_type: MessageType, path: str | None
    ) -> tuple[Tag, Conversion] | None:
        if path is None:
            return None
        tag = self._tags.find(path)
        surroundings = ConversionContext(node.types, Counter())
        return tag, tag_conversion(surroundings, message_type, tag.data_type, path)

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
