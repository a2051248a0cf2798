"""Frames: told and looked up, by handles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from crosnode.errors import MessageValueError, TransformError
from crosnode.interface.handles import handles_of
from crosnode.interface.interface import (
    CrosTransform,
    crosERR_FULL,
    crosERR_HANDLE,
    crosERR_NO_TRANSFORM,
)
from crosnode.interface.nodes import Registered, name_at, register
from crosnode.tf.node_frames import (
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformListener,
)
from crosnode.tf.transform import Transform
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK
from st_types.types.values import decode, encode
from st_types.types.views import type_of

if TYPE_CHECKING:
    from crosnode.node import CrosNode
    from plcsim.core.context import Context


@dataclass(eq=False)
class BroadcasterHandle:
    """What tells the frames of a node; static ones once it has any."""

    node: CrosNode
    moving: TransformBroadcaster
    static: StaticTransformBroadcaster | None = None


@dataclass(eq=False)
class ListenerHandle:
    """What follows the frames of others."""

    listener: TransformListener


@function("cRosTfBroadcaster")
def broadcaster(context: Context, node: int) -> int:
    """Make ready to tell frames."""

    def make(found: CrosNode) -> Registered:
        return Registered(BroadcasterHandle(found, TransformBroadcaster(found)))

    return register(context, node, make)


@function("cRosTfListener")
def listener(context: Context, node: int) -> int:
    """Follow the frames of others."""

    def make(found: CrosNode) -> Registered:
        made = TransformListener(found)
        return Registered(ListenerHandle(made), made.step)

    return register(context, node, make)


def _transform_at(context: Context, address: int) -> Transform:
    layout = type_of(CrosTransform)
    value = cast("dict[str, float]", decode(layout, context.memory.read(address, layout.size)))
    x, y, z, *rotation = (float(value[key]) for key in ("x", "y", "z", "qx", "qy", "qz", "qw"))
    qx, qy, qz, qw = rotation
    return Transform((x, y, z), (qx, qy, qz, qw))


@function("cRosTfBroadcast")
def broadcast(context: Context, broadcaster: int, parent: int, child: int, transform: int) -> int:
    """Tell with the next message where a frame is."""
    found = handles_of(context).find(BroadcasterHandle, broadcaster)
    if found is None:
        return crosERR_HANDLE
    names = name_at(context, parent), name_at(context, child)
    found.moving.add(*names, _transform_at(context, transform))
    return ERR_OK


@function("cRosTfSend")
def send(context: Context, broadcaster: int) -> int:
    """Send what was told."""
    found = handles_of(context).find(BroadcasterHandle, broadcaster)
    if found is None:
        return crosERR_HANDLE
    found.moving.send()
    return ERR_OK


@function("cRosTfStatic")
def static(context: Context, broadcaster: int, parent: int, child: int, transform: int) -> int:
    """Tell where a frame is for good."""
    found = handles_of(context).find(BroadcasterHandle, broadcaster)
    if found is None:
        return crosERR_HANDLE
    if found.static is None:
        found.static = StaticTransformBroadcaster(found.node)
    names = name_at(context, parent), name_at(context, child)
    try:
        found.static.send(*names, _transform_at(context, transform))
    except MessageValueError:
        return crosERR_FULL
    return ERR_OK


@function("cRosTfLookup")
def lookup(
    context: Context, listener: int, target: int, source: int, time_ns: int, transform: int
) -> int:
    """Write the transform from one frame to another to an address."""
    found = handles_of(context).find(ListenerHandle, listener)
    if found is None:
        return crosERR_HANDLE
    names = name_at(context, target), name_at(context, source)
    try:
        made = found.listener.lookup(*names, max(0, time_ns))
    except TransformError:
        return crosERR_NO_TRANSFORM
    keys = ("x", "y", "z", "qx", "qy", "qz", "qw")
    value = dict(zip(keys, (*made.translation, *made.rotation), strict=True))
    context.memory.write(transform, encode(type_of(CrosTransform), value))
    return ERR_OK
