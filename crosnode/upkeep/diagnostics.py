"""Diagnostics: how components are, on ``/diagnostics``, as diagnostic_updater tells it."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Final

from crosnode.errors import MessageValueError
from crosnode.messages import Time

if TYPE_CHECKING:
    from collections.abc import Mapping

    from crosnode.messages import Message
    from crosnode.node import CrosNode

TOPIC: Final = "/diagnostics"
TYPE: Final = "diagnostic_msgs/DiagnosticArray"
PERIOD_NS: Final = 1_000_000_000
MOST_COMPONENTS: Final = 200
MOST_VALUES: Final = 100
"""Of each component."""


class Level(IntEnum):
    """How a component is; the numbers of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


class Diagnostics:
    """Tells once a period, and at once when a level is another one, how all components are.

    Args:
        node: publishes.
        hardware_id: of what the components belong to.
        period_ns: nanoseconds between two messages.
    """

    def __init__(self, node: CrosNode, hardware_id: str, period_ns: int = PERIOD_NS) -> None:
        self._node = node
        self._hardware_id = hardware_id
        self._period_ns = period_ns
        self._publisher = node.publishers.get(TOPIC) or node.register_publisher(TOPIC, TYPE)
        self._status = node.types.message("diagnostic_msgs/DiagnosticStatus")
        self._value = node.types.message("diagnostic_msgs/KeyValue")
        self._components: dict[str, Message] = {}
        self._has_news = False
        self._told_ns: int | None = None

    def set(
        self,
        component: str,
        level: Level,
        text: str = "",
        values: Mapping[str, object] | None = None,
    ) -> None:
        """Say how a component is.

        Args:
            component: name; the node's is put before it.
            level: how it is.
            text: for people.
            values: measured, by name.

        Raises:
            MessageValueError: there are too many components or values.
        """
        values = values or {}
        before = self._components.get(component)
        is_too_many = before is None and len(self._components) >= MOST_COMPONENTS
        if is_too_many or len(values) > MOST_VALUES:
            raise MessageValueError(
                f"{component[:100]}: at most {MOST_COMPONENTS} components, {MOST_VALUES} values."
            )
        self._has_news |= before is None or before.level != level
        self._components[component] = self._status.new(
            level=int(level),
            name=f"{self._node.name.lstrip('/')}: {component}",
            message=text,
            hardware_id=self._hardware_id,
            values=[self._value.new(key=key, value=str(value)) for key, value in values.items()],
        )

    def step(self) -> None:
        """Tell what is due; call it once a cycle."""
        now_ns, told_ns = self._node.now_ns, self._told_ns
        is_due = told_ns is None or not 0 <= now_ns - told_ns < self._period_ns
        if not self._components or not (is_due or self._has_news):
            return
        self._told_ns, self._has_news = now_ns, False
        message = self._publisher.new(status=list(self._components.values()))
        message.header.stamp = Time.from_ns(now_ns)
        self._publisher.send(message)
