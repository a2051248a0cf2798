"""Values of a table on the parameter server, where dynamic_reconfigure's servers keep theirs.

What is there at the start, such as from a launch file, goes before the table's own; then each value
is written, and again when it changes. One call runs at a time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from crosnode.xmlrpc.api_caller import CallState

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from crosnode.node import CrosNode
    from crosnode.xmlrpc import Value
    from crosnode.xmlrpc.api_caller import ApiCall


class StoredValues:
    """Keeps a table and the parameter server alike.

    Args:
        node: calls the master.
        below: name below which the parameters are.
        values: as they are now; read where one is written.
        names: of the values to be read first.
        on_read: called with name and value of a parameter that was there.
    """

    def __init__(
        self,
        node: CrosNode,
        below: str,
        values: Mapping[str, Value],
        names: Iterable[str],
        on_read: Callable[[str, Value], None],
    ) -> None:
        self._node = node
        self._below = below
        self._values = values
        self._on_read = on_read
        self._unread = dict.fromkeys(names)
        self._unwritten: dict[str, None] = {}
        self._running: tuple[str, ApiCall] | None = None

    def changed(self, name: str) -> None:
        """Note that a value is another one: what is stored of it is older."""
        self._unread.pop(name, None)
        self._unwritten[name] = None

    def step(self) -> None:
        """Take the answer to the running call, or make the next."""
        if self._running is not None:
            self._look(*self._running)
        elif (self._unread or self._unwritten) and self._node.core.master.is_calm:
            name = next(iter(self._unread or self._unwritten))
            parameter = f"{self._below}/{name}"
            if name in self._unread:
                call = self._node.get_param(parameter)
            else:
                del self._unwritten[name]
                call = self._node.set_param(parameter, self._values[name])
            self._running = name, call

    def _look(self, name: str, call: ApiCall) -> None:
        if call.state is CallState.WAITING:
            return
        self._running = None
        if name not in self._unread:  # it was written, or changed meanwhile
            if not call.was_answered:
                self._unwritten[name] = None
        elif call.was_answered:
            self.changed(name)
            if call.state is CallState.DONE:
                self._on_read(name, call.value)
