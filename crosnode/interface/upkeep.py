"""Diagnostics, and values that others may change, by handles."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from crosnode.errors import MessageValueError
from crosnode.interface.handles import NodeHandle, handles_of, text_at
from crosnode.interface.interface import (
    CROS_TEXT_LENGTH,
    CrosAdjustableKind,
    crosERR_FULL,
    crosERR_HANDLE,
    crosERR_VALUE,
)
from crosnode.interface.nodes import Registered, name_at, register
from crosnode.upkeep.diagnostics import MOST_COMPONENTS, MOST_VALUES, Diagnostics, Level
from crosnode.upkeep.reconfigure import Adjustable, Reconfigure
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.node import CrosNode
    from crosnode.upkeep.reconfigure import Value
    from plcsim.core.context import Context


@dataclass(eq=False)
class DiagnosticsHandle:
    """A node's diagnostics, and the values of each component."""

    diagnostics: Diagnostics
    values: dict[str, dict[str, object]] = field(default_factory=dict)


@function("cRosDiagnostics")
def diagnostics(context: Context, node: int, hardware_id: int) -> int:
    """Tell how components of a node are."""

    def make(found: CrosNode) -> Registered:
        made = Diagnostics(found, name_at(context, hardware_id))
        return Registered(DiagnosticsHandle(made), made.step)

    return register(context, node, make)


@function("cRosDiagnosticsValue")
def value(context: Context, diagnostics: int, component: int, key: int, value: int) -> int:
    """Note a value of a component."""
    found = handles_of(context).find(DiagnosticsHandle, diagnostics)
    if found is None:
        return crosERR_HANDLE
    name = name_at(context, component)
    if name not in found.values and len(found.values) >= MOST_COMPONENTS:
        return crosERR_FULL
    values = found.values.setdefault(name, {})
    name = name_at(context, key)
    if name not in values and len(values) >= MOST_VALUES:
        return crosERR_FULL
    values[name] = text_at(context, value, CROS_TEXT_LENGTH)
    return ERR_OK


@function("cRosDiagnosticsSet")
def set_component(context: Context, diagnostics: int, component: int, level: int, text: int) -> int:
    """Say how a component is."""
    found = handles_of(context).find(DiagnosticsHandle, diagnostics)
    if found is None:
        return crosERR_HANDLE
    name = name_at(context, component)
    try:
        known = Level(level)
    except ValueError:
        return crosERR_VALUE
    try:
        said = text_at(context, text, CROS_TEXT_LENGTH)
        found.diagnostics.set(name, known, said, found.values.get(name))
    except MessageValueError:
        return crosERR_FULL
    return ERR_OK


class AdjustableTable:
    """The values of a node: declared in INIT, served from its first step on.

    Raises:
        InvalidNameError: in that step, where the program has a topic or service of its name.
    """

    def __init__(self, node: CrosNode) -> None:
        node.types.service("dynamic_reconfigure/Reconfigure").warm()
        node.types.message("dynamic_reconfigure/ConfigDescription").warm()
        self._node = node
        self._declared: dict[str, Adjustable] = {}
        self._server: Reconfigure | None = None

    def declare(self, declared: Adjustable) -> bool:
        """Take a value; False where it is late, beyond its bounds, or its name is taken."""
        fits = declared.cut(declared.value) == declared.value
        if self._server is not None or declared.name in self._declared or not fits:
            return False
        self._declared[declared.name] = declared
        return True

    def step(self) -> None:
        """Take what others set."""
        if self._server is None:
            self._server = Reconfigure(self._node, [*self._declared.values()])
        self._server.step()

    def read(self, name: str) -> Value:
        """Return a value as it is now."""
        return self._server.values[name] if self._server else self._declared[name].value

    def set(self, name: str, value: Value) -> None:
        """Change a value."""
        if self._server:
            self._server.set(name, value)
        else:
            declared = self._declared[name]
            self._declared[name] = declared._replace(value=declared.cut(value))


@dataclass(eq=False)
class AdjustableHandle:
    """A value of a node."""

    table: AdjustableTable
    name: str
    kind: Callable[[float], Value]


_KINDS: Final[dict[int, Callable[[float], Value]]] = {
    CrosAdjustableKind.CROS_ADJUSTABLE_BOOL: bool,
    CrosAdjustableKind.CROS_ADJUSTABLE_INT: int,
    CrosAdjustableKind.CROS_ADJUSTABLE_REAL: float,
}


@function("cRosAdjustable")
def adjustable(
    context: Context,
    node: int,
    name: int,
    kind: int,
    value: float,
    minimum: float,
    maximum: float,
    description: int,
) -> int:
    """Declare a value that others may change."""
    handles = handles_of(context)
    owner, convert = handles.find(NodeHandle, node), _KINDS.get(kind)
    if owner is None or convert is None:
        return 0
    table = owner.block(AdjustableTable)
    if table is None:
        table = owner.blocks[AdjustableTable] = AdjustableTable(owner.node)
        owner.steps.append(table.step)
    declared = name_at(context, name)
    said = text_at(context, description, CROS_TEXT_LENGTH)
    try:
        made = Adjustable(declared, convert(value), minimum, maximum, said)
        if not table.declare(made):
            return 0
    except (ValueError, OverflowError):  # a REAL that is no number for an INT
        return 0
    return handles.add_part(owner, AdjustableHandle(table, declared, convert))


@function("cRosAdjustableValue")
def adjustable_value(context: Context, adjustable: int) -> float:
    """Return a value as it is now."""
    found = handles_of(context).find(AdjustableHandle, adjustable)
    return float(found.table.read(found.name)) if found else 0.0


@function("cRosAdjustableSet")
def set_adjustable(context: Context, adjustable: int, value: float) -> int:
    """Change a value from the program."""
    found = handles_of(context).find(AdjustableHandle, adjustable)
    if found is None:
        return crosERR_HANDLE
    try:
        found.table.set(found.name, found.kind(value))
    except (ValueError, OverflowError):
        return crosERR_VALUE
    return ERR_OK
