"""Names as ROS 2 gives them to DDS."""

import pytest

from crosnode.errors import MessageTypeError
from crosnode.ros2.names import topic_name, type_name


def test_topics_and_types() -> None:
    assert topic_name("/tank/level") == topic_name("tank/level") == "rt/tank/level"
    assert type_name("std_msgs/String") == "std_msgs::msg::dds_::String_"
    with pytest.raises(MessageTypeError):
        type_name("String")
