"""What other commands than writes do to the controller: force, release, control."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core.control import Action, Request
from plcsim.core.errors import TagError
from plcsim.core.logbook import Severity
from plcsim.shared_image.command import CommandOutcome, Control, ForceCommand, Release
from plcsim.shared_image.force_list import encode_forces
from plcsim.shared_image.layout import FORCES_SIZE
from plcsim.shared_image.stores import Stores
from st_types.types.values import decode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag
    from plcsim.shared_image.command import Command

LONGEST_TEXT = 80
"""Characters of a value in the logbook."""


class Hands:
    """What inboxes work with.

    Args:
        controller: whose variables are written.

    Attributes:
        stores: carries out writes.
        time_ns: of the present LATCH, since the start on the controller's clock.
    """

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._owners = controller.owners
        self.stores = Stores(controller.memory, controller.owners, controller.image.followers)
        self.time_ns = 0

    def owner_of_tag(self, path: str) -> int:
        """Return the owner of a tag as a bit, 0 where there is no such tag."""
        tag = self._controller.tags.get(path)
        return 0 if tag is None else self._owners.of(tag.address)

    def carry_out(self, command: Command, source: str) -> CommandOutcome:
        """Do what a command asks for, and say so in the logbook."""
        match command:
            case ForceCommand(path, data, by):
                return self._force(path, data, _who(source, by))
            case Release(path, by):
                return self._release(path, _who(source, by))
            case Control(action, argument, by):
                return self._request(Request(action, argument, _who(source, by)))
        return CommandOutcome.NO_COMMAND

    def _force(self, path: str, data: bytes, source: str) -> CommandOutcome:
        forces, tag = self._controller.forces, self._controller.tags.get(path)
        if tag is None:
            return CommandOutcome.NO_SUCH_TAG
        if tag.is_constant:
            return CommandOutcome.CONSTANT
        if len(data) != tag.data_type.size:
            return CommandOutcome.NO_COMMAND
        before = next((f for f in forces if f.tag[1:] == tag[1:]), None)
        try:
            forces.force(tag, data, source)
        except TagError:
            return CommandOutcome.OVERLAPS
        if len(encode_forces(forces)) > FORCES_SIZE:
            if before is None:
                forces.release(tag)
            else:
                forces.force(*before)
            return CommandOutcome.TOO_MANY
        self._log(source, f"{tag.path} is forced to {_text(tag, data)}")
        return CommandOutcome.APPLIED

    def _release(self, path: str, source: str) -> CommandOutcome:
        forces = self._controller.forces
        if not path:
            count = forces.clear()
            self._log(source, f"{count} forced tags are released")
            return CommandOutcome.APPLIED
        tag = self._controller.tags.get(path)
        if tag is None:
            return CommandOutcome.NO_SUCH_TAG
        if not forces.release(tag):
            return CommandOutcome.NOT_FORCED
        self._log(source, f"{tag.path} is released")
        return CommandOutcome.APPLIED

    def _request(self, request: Request) -> CommandOutcome:
        if request.action is Action.SPEED and not self._controller.clock.is_virtual:
            return CommandOutcome.NOT_HERE
        self._controller.request(request)
        return CommandOutcome.APPLIED

    def _log(self, source: str, text: str) -> None:
        self._controller.log(Severity.INFORMATION, source, text)


def _who(service: str, by: str) -> str:
    """Return who asks, as the logbook says it: the service, and the person where it knows one."""
    return f"{service}: {by}" if by else service


def _text(tag: Tag, data: bytes) -> str:
    text = value_text(tag.data_type, decode(tag.data_type, data))
    return text if len(text) <= LONGEST_TEXT else f"{text[: LONGEST_TEXT - 3]}..."
