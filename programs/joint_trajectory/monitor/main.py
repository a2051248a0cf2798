"""Listens to /arm/joint_states and keeps the last message as a STRUCT of the controller.

The STRUCT is the message's own: JointState.typ was written by ``plcsim types from-ros
sensor_msgs/JointState``, and the views in joint_state.py by ``plcsim types python JointState.typ``.
"""

from crosnode.messages import Message, to_latin1
from crosnode.node import CrosNode, Subscriber
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import UDINT, var

from ..joint_state import (  # noqa: TID252  # the project is a package without a name
    sensor_msgs_JointState,
    sensor_msgs_JointState_position_MAX,
)

JOINTS = sensor_msgs_JointState_position_MAX + 1


class Monitor(Program):
    """Sees where the joints are."""

    __slots__ = ("node", "states")

    node: CrosNode
    states: Subscriber

    state = var(sensor_msgs_JointState)
    heard = var(UDINT)

    def init(self) -> None:
        """Make the node."""
        self.node = create_node(self.context, "monitor")
        self.states = self.node.register_subscriber(
            "/arm/joint_states", "sensor_msgs/JointState", queue_size=1
        )

    def cyclic(self) -> None:
        """Do one step of the node, then keep the last message."""
        self.node.do_events_loop()
        message = self.states.pop()
        if message is not None:
            self.keep(message)

    def keep(self, message: Message) -> None:
        """Copy a message into the STRUCT; of more joints than it holds, the first ones."""
        state = self.state
        state.header.seq = message.header.seq
        state.header.stamp.sec = message.header.stamp.secs
        state.header.stamp.nsec = message.header.stamp.nsecs
        names = [to_latin1(name) for name in message.name[:JOINTS]]
        state.name.assign(names)
        state.name_length = len(names)
        state.position.assign([float(value) for value in message.position[:JOINTS]])
        state.position_length = min(len(message.position), JOINTS)
        self.heard += 1

    def exit(self) -> None:
        """Take the registration back."""
        self.node.destroy()
