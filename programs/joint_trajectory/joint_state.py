"""Types of JointState.typ, written by plcsim types python."""

from __future__ import annotations

from typing import Final

from st_types import ARRAY, LREAL, STRING, UDINT, Struct, var

std_msgs_Header_frame_id_LENGTH: Final = 80
sensor_msgs_JointState_name_LENGTH: Final = 80
sensor_msgs_JointState_name_MAX: Final = 15
sensor_msgs_JointState_position_MAX: Final = 15
sensor_msgs_JointState_velocity_MAX: Final = 15
sensor_msgs_JointState_effort_MAX: Final = 15


class ros_time(Struct):
    """STRUCT ros_time."""

    sec = var(UDINT)
    nsec = var(UDINT)


class std_msgs_Header(Struct):
    """STRUCT std_msgs_Header."""

    seq = var(UDINT)
    stamp = var(ros_time)
    frame_id = var(STRING(80))


class sensor_msgs_JointState(Struct):
    """STRUCT sensor_msgs_JointState."""

    header = var(std_msgs_Header)
    name = var(ARRAY(STRING(80), (0, 15)))
    name_length = var(UDINT)
    position = var(ARRAY(LREAL, (0, 15)))
    position_length = var(UDINT)
    velocity = var(ARRAY(LREAL, (0, 15)))
    velocity_length = var(UDINT)
    effort = var(ARRAY(LREAL, (0, 15)))
    effort_length = var(UDINT)
