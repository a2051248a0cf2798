"""Parameter subscriptions: the value of a parameter or a namespace, kept up to date."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import MessageValueError
from crosnode.graph.names import SEPARATOR, canonical
from crosnode.node.queues import DropOldestQueue
from crosnode.node.registration import RegistrationState
from crosnode.xmlrpc import check_value

if TYPE_CHECKING:
    from collections.abc import Mapping

    from crosnode.node.registration import Registration
    from crosnode.xmlrpc import Value

MAX_EARLY: Final = 100
"""Changes kept that came before the answer to the registration."""

UNSET: Final[dict[str, object]] = {}
"""What a master tells of a parameter that is not there (any more)."""


def check_parameters(parameters: Mapping[str, Value]) -> None:
    """Check that XML-RPC can carry the values of parameters.

    Raises:
        MessageValueError: it cannot; the parameter is named.
    """
    for name, value in parameters.items():
        try:
            check_value(value)
        except MessageValueError as error:
            raise MessageValueError(f"parameter {name}: {error}") from None


class ParameterUpdate(NamedTuple):
    """A change: the parameter that changed, the subscribed one or one below it, and its value."""

    name: str
    value: Value


class ParameterSubscription:
    """A subscribed parameter; made by ``CrosNode.subscribe_param``.

    Attributes:
        name: resolved name.
        value: what it holds, all levels below it included; {} where it is not set.
        updates: changes that wait for the program; the oldest is dropped.
        registration: with the master.
    """

    def __init__(self, name: str, registration: Registration, *, queue_size: int) -> None:
        self.name = name
        self.value: Value = dict(UNSET)
        self.updates: DropOldestQueue[ParameterUpdate] = DropOldestQueue(queue_size)
        self.registration = registration
        self._early: DropOldestQueue[ParameterUpdate] = DropOldestQueue(MAX_EARLY)

    def pop(self) -> ParameterUpdate | None:
        """Return the oldest change, None where there is none."""
        return self.updates.pop()

    def set_all(self, value: Value) -> None:
        """Take the value of the parameter itself."""
        self.value = value
        self.updates.push(ParameterUpdate(self.name, value))

    def registered(self, value: Value) -> None:
        """Take the value from the answer to the registration.

        Changes that came before the answer are newer than it: they are made again.
        """
        early = []
        while (update := self._early.pop()) is not None:
            early.append(update)
        self.set_all(value)
        for name, changed in early:
            self.update(name, changed)

    def param_update(self, name: str, value: Value) -> None:
        """Take a change from the master's call."""
        if self.registration.state is RegistrationState.CALLING:
            self._early.push(ParameterUpdate(name, value))
        self.update(name, value)

    def own_change(self, name: str, value: Value) -> None:
        """Take what the own node has set at this parameter or below it.

        A master tells this to the other nodes only; of what lies below the name it tells all.
        """
        if self.covers(name):
            self.param_update(name, value)

    def covers(self, name: str) -> bool:
        """Whether ``name`` is this parameter or lies below it."""
        below = self.name.rstrip(SEPARATOR) + SEPARATOR
        return name == self.name or name.startswith(below)

    def update(self, name: str, value: Value) -> None:
        """Take the value of ``name``, which is this parameter or one below it."""
        name = canonical(name)
        if name == self.name:
            self.set_all(value)
            return
        if value == UNSET and not isinstance(self.value, dict):
            return  # there is nothing below it
        *path, last = name[len(self.name) :].strip(SEPARATOR).split(SEPARATOR)
        branch = self.value = dict(self.value) if isinstance(self.value, dict) else {}
        for step in path:
            inner = branch.get(step)
            branch[step] = dict(inner) if isinstance(inner, dict) else {}
            branch = branch[step]
        if value == UNSET:
            branch.pop(last, None)
        else:
            branch[last] = value
        self.updates.push(ParameterUpdate(name, value))
