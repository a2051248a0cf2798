"""dynamic_reconfigure: values that others may change while a program runs, as a declared table.

The wire is that of dynamic_reconfigure's server: a service ``set_parameters`` and two latched
topics below the node's name, ``parameter_descriptions`` and ``parameter_updates``. As there, the
parameter server has the values: those of a launch file count, and ``rosparam dump`` keeps them.
"""

from __future__ import annotations

from math import inf, isfinite
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

from crosnode.errors import MessageValueError
from crosnode.upkeep.stored_values import StoredValues

if TYPE_CHECKING:
    from collections.abc import Sequence

    from crosnode.messages import Message
    from crosnode.node import CrosNode

Value: TypeAlias = bool | int | float | str

MOST_VALUES: Final = 200
MOST_TEXT: Final = 1_000
"""Characters of a text that others set."""

INT_MIN, INT_MAX = -(2**31), 2**31 - 1

_KINDS: Final[dict[type, tuple[str, str]]] = {
    bool: ("bool", "bools"),
    int: ("int", "ints"),
    float: ("double", "doubles"),
    str: ("str", "strs"),
}
"""Of each type: its name in a description, and its list in a dynamic_reconfigure/Config."""


class Adjustable(NamedTuple):
    """A value that others may change; its type is that of ``value``.

    Attributes:
        name: of the value.
        value: at first.
        minimum: of a number, None for the least there is; what is set beyond is cut, as there.
        maximum: likewise.
        description: for people.
    """

    name: str
    value: Value
    minimum: float | None = None
    maximum: float | None = None
    description: str = ""

    @property
    def bounds(self) -> tuple[Value, Value]:
        """The least and the greatest value."""
        if isinstance(self.value, bool):
            return False, True
        if isinstance(self.value, str):
            return "", ""
        least, most = (INT_MIN, INT_MAX) if isinstance(self.value, int) else (-inf, inf)
        kind = type(self.value)
        return (
            kind(least if self.minimum is None else self.minimum),
            kind(most if self.maximum is None else self.maximum),
        )

    def cut(self, value: Any) -> Value:
        """Return a value of the same type as one within the bounds."""
        if isinstance(value, str):
            return value[:MOST_TEXT]
        least, most = self.bounds
        cut: Value = min(max(value, least), most)
        return cut


class Reconfigure:
    """The server; its ``step`` belongs behind the node's step.

    Args:
        node: whose values they are.
        table: the values.
        name: below which service and topics are, "" for the node's.

    Raises:
        MessageValueError: too many values, two of one name, or one beyond its bounds.

    Attributes:
        values: as they are now, by name; change them by ``set``.
        changes: changes by others so far.
    """

    def __init__(self, node: CrosNode, table: Sequence[Adjustable], name: str = "") -> None:
        self._table = {each.name: each for each in table}
        if len(self._table) != len(table) or len(table) > MOST_VALUES:
            raise MessageValueError(f"at most {MOST_VALUES} values, each with its own name.")
        for each in table:
            if each.cut(each.value) != each.value:
                raise MessageValueError(f"{each.name}: {each.value} is not within its bounds.")
        self.values: dict[str, Value] = {each.name: each.value for each in table}
        self.changes = 0
        below = name or node.name
        self._types = node.types
        self._service = node.register_service_provider(
            f"{below}/set_parameters", "dynamic_reconfigure/Reconfigure"
        )
        self._updates = node.register_publisher(
            f"{below}/parameter_updates", "dynamic_reconfigure/Config", latching=True
        )
        descriptions = node.register_publisher(
            f"{below}/parameter_descriptions",
            "dynamic_reconfigure/ConfigDescription",
            latching=True,
        )
        descriptions.send(self._description())
        self._stored = StoredValues(node, below, self.values, self._table, self._read)
        self._tell()

    def set(self, name: str, value: Value) -> None:
        """Change a value from the program, and tell those who follow it.

        Raises:
            KeyError: there is no such value.
        """
        self._change(name, value)
        self._tell()

    def step(self) -> None:
        """Take what others set, answer with what holds now, and tell it."""
        while (request := self._service.pop()) is not None:
            self._take(request.request.config)
            request.respond(config=self._config(self.values))
            self._tell()
        self._stored.step()

    def _take(self, config: Message) -> None:
        """Take values of their own type; unknown names are passed over, as there."""
        self.changes += 1
        for kind, (_, attribute) in _KINDS.items():
            for sent in getattr(config, attribute):
                known = self._table.get(sent.name)
                is_number = not isinstance(sent.value, float) or isfinite(sent.value)
                if known is not None and type(known.value) is kind and is_number:
                    self._change(sent.name, sent.value)

    def _change(self, name: str, value: Any) -> None:
        cut = self._table[name].cut(value)
        if cut != self.values[name]:
            self.values[name] = cut
            self._stored.changed(name)

    def _read(self, name: str, value: Any) -> None:
        """Take a value from the parameter server, where its type is right or makes a right one."""
        kind = type(self._table[name].value)
        if kind is float and type(value) is int:
            value = float(value)
        if type(value) is kind and value != self.values[name]:
            self.changes += 1
            self._change(name, value)
            self._tell()

    def _tell(self) -> None:
        self._updates.send(self._config(self.values))

    def _config(self, values: dict[str, Value]) -> Message:
        config = self._types.message("dynamic_reconfigure/Config").new()
        for name, value in values.items():
            kind, attribute = _KINDS[type(self._table[name].value)]
            parameter = f"dynamic_reconfigure/{kind.capitalize()}Parameter"
            made = self._types.message(parameter).new(name=name, value=value)
            getattr(config, attribute).append(made)
        group = self._types.message("dynamic_reconfigure/GroupState")
        config.groups = [group.new(name="Default", state=True, id=0, parent=0)]
        return config

    def _description(self) -> Message:
        parameter = self._types.message("dynamic_reconfigure/ParamDescription")
        group = self._types.message("dynamic_reconfigure/Group").new(name="Default", id=0, parent=0)
        group.parameters = [
            parameter.new(
                name=each.name, type=_KINDS[type(each.value)][0], description=each.description
            )
            for each in self._table.values()
        ]
        made = self._types.message("dynamic_reconfigure/ConfigDescription").new(groups=[group])
        bounds = {each.name: each.bounds for each in self._table.values()}
        made.min = self._config({name: least for name, (least, _) in bounds.items()})
        made.max = self._config({name: most for name, (_, most) in bounds.items()})
        made.dflt = self._config({each.name: each.value for each in self._table.values()})
        return made
