"""Frames: told and looked up, by the node's handle."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from crosnode.errors import CrosnodeError, MessageValueError, TransformError
from crosnode.interface.handles import NodeHandle, handles_of
from crosnode.interface.interface import (
    CrosTransform,
    crosERR_FULL,
    crosERR_HANDLE,
    crosERR_NO_TRANSFORM,
    crosERR_REFUSED,
)
from crosnode.interface.nodes import name_at, told
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
    from typing import TypeVar

    from plcsim.core.context import Context

    B = TypeVar("B", TransformBroadcaster, StaticTransformBroadcaster, TransformListener)


def _block(context: Context, handle: int, kind: type[B]) -> B | None:
    """Return what a node has of a class; it is made when first asked for."""
    found = handles_of(context).find(NodeHandle, handle)
    if found is None:
        return None
    made = found.block(kind)
    if made is None:
        made = kind(found.node)
        found.blocks[kind] = made
        if isinstance(made, TransformListener):
            found.steps.append(made.step)
    return made


def _transform_at(context: Context, address: int) -> Transform:
    layout = type_of(CrosTransform)
    value = cast("dict[str, float]", decode(layout, context.memory.read(address, layout.size)))
    x, y, z, *rotation = (float(value[key]) for key in ("x", "y", "z", "qx", "qy", "qz", "qw"))
    qx, qy, qz, qw = rotation
    return Transform((x, y, z), (qx, qy, qz, qw))


@function("cRosTfBroadcast")
def broadcast(context: Context, node: int, parent: int, child: int, transform: int) -> int:
    """Tell with the next message where a frame is."""
    found = _block(context, node, TransformBroadcaster)
    if found is None:
        return crosERR_HANDLE
    names = name_at(context, parent), name_at(context, child)
    found.add(*names, _transform_at(context, transform))
    return ERR_OK


@function("cRosTfSend")
def send(context: Context, node: int) -> int:
    """Send what was told."""
    found = _block(context, node, TransformBroadcaster)
    if found is None:
        return crosERR_HANDLE
    found.send()
    return ERR_OK


@function("cRosTfStatic")
def static(context: Context, node: int, parent: int, child: int, transform: int) -> int:
    """Tell where a frame is for good."""
    found = _block(context, node, StaticTransformBroadcaster)
    if found is None:
        return crosERR_HANDLE
    names = name_at(context, parent), name_at(context, child)
    try:
        found.send(*names, _transform_at(context, transform))
    except MessageValueError:
        return crosERR_FULL
    return ERR_OK


@function("cRosTfListen")
def listen(context: Context, node: int) -> int:
    """Follow the frames of others."""
    try:
        return ERR_OK if _block(context, node, TransformListener) else crosERR_HANDLE
    except CrosnodeError as error:
        told(context, error)
        return crosERR_REFUSED


@function("cRosTfLookup")
def lookup(
    context: Context, node: int, target: int, source: int, time_ns: int, transform: int
) -> int:
    """Write the transform from one frame to another to an address."""
    owner = handles_of(context).find(NodeHandle, node)
    found = owner.block(TransformListener) if owner else None
    if found is None:
        return crosERR_HANDLE
    names = name_at(context, target), name_at(context, source)
    try:
        made = found.lookup(*names, max(0, time_ns))
    except TransformError:
        return crosERR_NO_TRANSFORM
    keys = ("x", "y", "z", "qx", "qy", "qz", "qw")
    value = dict(zip(keys, (*made.translation, *made.rotation), strict=True))
    context.memory.write(transform, encode(type_of(CrosTransform), value))
    return ERR_OK
