"""The node, and what a program registers with it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import CrosnodeError
from crosnode.interface.handles import NodeHandle, RoleHandle, handles_of, text_at
from crosnode.interface.interface import (
    CROS_NAME_LENGTH,
    CROS_TEXT_LENGTH,
    CrosNodeNews,
    CrosTime,
    crosERR_HANDLE,
    crosERR_VALUE,
)
from crosnode.node import Publisher, Subscriber
from crosnode.node.rosout import LogLevel
from crosnode.plc.project import create_node
from plcsim.core.controller import Controller
from plcsim.core.logbook import Severity
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK
from st_types.types.values import encode
from st_types.types.views import type_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.interface.handles import Role
    from crosnode.node import CrosNode
    from plcsim.core.context import Context

NS_PER_MS: Final = 1_000_000


def name_at(context: Context, address: int) -> str:
    """Return the name at an address."""
    return text_at(context, address, CROS_NAME_LENGTH)


def told(context: Context, error: CrosnodeError) -> int:
    """Tell people what a handle cannot: why there is none."""
    controller = Controller.of(context)
    if controller is not None:
        controller.log(Severity.ERROR, "ros", str(error))
    return 0


@function("cRosNodeCreate")
def create(context: Context, node_name: int) -> int:
    """Make a node; a name such as ``/cell/talker`` brings its namespace."""
    namespace, _, base = name_at(context, node_name).rpartition("/")
    try:
        node = create_node(context, base, namespace=namespace)
    except CrosnodeError as error:
        return told(context, error)
    return handles_of(context).add(NodeHandle(node))


def _node(context: Context, handle: int) -> CrosNode | None:
    found = handles_of(context).find(NodeHandle, handle)
    return found.node if found else None


@function("cRosNodeDoEventsLoop")
def do_events_loop(context: Context, node: int) -> int:
    """Do the step of this cycle."""
    found = handles_of(context).find(NodeHandle, node)
    if found is None:
        return crosERR_HANDLE
    found.node.do_events_loop()
    for step in found.steps:
        step()
    return ERR_OK


@function("cRosNodeDestroy")
def destroy(context: Context, node: int) -> int:
    """Take all back and forget all handles of the node."""
    found = _node(context, node)
    if found is None:
        return crosERR_HANDLE
    found.destroy()
    handles_of(context).release(node)
    return ERR_OK


@function("cRosNodeIsRegistered")
def is_registered(context: Context, node: int) -> bool:
    """Whether the master knows all."""
    found = _node(context, node)
    return found is not None and found.is_registered


@function("cRosNodePopStatus")
def pop_status(context: Context, node: int, news: int) -> bool:
    """Write the oldest news to an address."""
    found = _node(context, node)
    status = found.pop_status() if found else None
    if status is None:
        return False
    value = {"kind": status.kind.value, "name": status.name, "text": status.text}
    context.memory.write(news, encode(type_of(CrosNodeNews), value))
    return True


@function("cRosNodeTime")
def time(context: Context, node: int, address: int) -> bool:
    """Write ROS time to an address."""
    found = _node(context, node)
    now_ns = found.now_ns if found else 0
    sec, nsec = divmod(now_ns, 1_000_000_000)
    context.memory.write(address, encode(type_of(CrosTime), {"sec": sec, "nsec": nsec}))
    return now_ns > 0


@function("cRosLog")
def log(context: Context, node: int, level: int, msg: int) -> int:
    """Publish a line on /rosout."""
    found = _node(context, node)
    if found is None:
        return crosERR_HANDLE
    try:
        known = LogLevel(level)
    except ValueError:
        return crosERR_VALUE
    found.log(known, text_at(context, msg, CROS_TEXT_LENGTH))
    return ERR_OK


class Registered(NamedTuple):
    """What a program has registered with a node.

    Attributes:
        handle: what its handle stands for.
        step: its part in each cycle, None for none.
    """

    handle: object
    step: Callable[[], None] | None = None


def register(context: Context, node: int, make: Callable[[CrosNode], Registered]) -> int:
    """Register something with a node; return its handle, 0 where it is refused."""
    handles = handles_of(context)
    owner = handles.find(NodeHandle, node)
    if owner is None:
        return 0
    try:
        made = make(owner.node)
    except CrosnodeError as error:
        return told(context, error)
    if made.step is not None:
        owner.steps.append(made.step)
    return handles.add_part(owner, made.handle)


def _register(context: Context, node: int, make: Callable[[CrosNode], Role]) -> int:
    """Register one of the node's own roles."""
    return register(context, node, lambda found: Registered(RoleHandle(found, make(found))))


@function("cRosApiRegisterPublisher")
def register_publisher(
    context: Context, node: int, topic: int, type_name: int, loop_period: int, latching: bool
) -> int:
    """Publish a topic."""
    return _register(
        context,
        node,
        lambda found: found.register_publisher(
            name_at(context, topic),
            name_at(context, type_name),
            latching=latching,
            loop_period_ns=max(0, loop_period) * NS_PER_MS,
        ),
    )


@function("cRosApiRegisterSubscriber")
def register_subscriber(
    context: Context, node: int, topic: int, type_name: int, queue_size: int
) -> int:
    """Subscribe to a topic."""
    return _register(
        context,
        node,
        lambda found: found.register_subscriber(
            name_at(context, topic), name_at(context, type_name), queue_size=max(1, queue_size)
        ),
    )


@function("cRosApiRegisterServiceProvider")
def register_provider(context: Context, node: int, service: int, type_name: int) -> int:
    """Provide a service."""
    return _register(
        context,
        node,
        lambda found: found.register_service_provider(
            name_at(context, service), name_at(context, type_name)
        ),
    )


@function("cRosApiRegisterServiceCaller")
def register_caller(
    context: Context, node: int, service: int, type_name: int, persistent: bool
) -> int:
    """Make ready to call a service."""
    return _register(
        context,
        node,
        lambda found: found.register_service_caller(
            name_at(context, service), name_at(context, type_name), persistent=persistent
        ),
    )


@function("cRosApiSubscribeParam")
def subscribe_param(context: Context, node: int, key: int) -> int:
    """Follow a parameter."""
    return _register(context, node, lambda found: found.subscribe_param(name_at(context, key)))


@function("cRosApiUnregister")
def unregister(context: Context, handle: int) -> int:
    """Take a registration back."""
    handles = handles_of(context)
    found = handles.find(RoleHandle, handle)
    if found is None:
        return crosERR_HANDLE
    found.node.unregister(found.role)
    handles.release(handle)
    return ERR_OK


@function("cRosQueueDropped")
def dropped(context: Context, handle: int) -> int:
    """Return how many messages were dropped."""
    found = handles_of(context).find(RoleHandle, handle)
    role = found.role if found else None
    if isinstance(role, Publisher):
        return role.dropped
    return role.dropped if isinstance(role, Subscriber) else 0


@function("cRosPeers")
def peers(context: Context, handle: int) -> int:
    """Return how many peers are connected."""
    found = handles_of(context).find(RoleHandle, handle)
    role = found.role if found else None
    if isinstance(role, Publisher):
        return role.subscribers
    return role.publishers if isinstance(role, Subscriber) else 0
