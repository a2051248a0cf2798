"""A second process on the ROS 2 network: Cyclone DDS by itself, with types written by hand.

    ros2_peer.py DOMAIN

Prints what it hears on /tank/level and /tank/stamped, and sends setpoints.
"""

import sys
import time

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import make_idl_struct
from cyclonedds.idl.types import float32, float64, int32, uint32
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

QOS = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepLast(10))
FLOAT64 = make_idl_struct("A", "std_msgs::msg::dds_::Float64_", {"data": float64})
FLOAT32 = make_idl_struct("B", "std_msgs::msg::dds_::Float32_", {"data": float32})
STAMP = make_idl_struct("C", "builtin_interfaces::msg::dds_::Time_",
                        {"sec": int32, "nanosec": uint32})  # fmt: skip
HEADER = make_idl_struct("D", "std_msgs::msg::dds_::Header_", {"stamp": STAMP, "frame_id": str})
POINT = make_idl_struct("E", "geometry_msgs::msg::dds_::Point_",
                        {"x": float64, "y": float64, "z": float64})  # fmt: skip
STAMPED = make_idl_struct("F", "geometry_msgs::msg::dds_::PointStamped_",
                          {"header": HEADER, "point": POINT})  # fmt: skip


def main() -> None:
    participant = DomainParticipant(int(sys.argv[1]))
    levels = DataReader(participant, Topic(participant, "rt/tank/level", FLOAT64), qos=QOS)
    stamped = DataReader(participant, Topic(participant, "rt/tank/stamped", STAMPED), qos=QOS)
    setpoints = DataWriter(participant, Topic(participant, "rt/tank/setpoint", FLOAT32), qos=QOS)
    while True:
        for sample in levels.take(N=10):
            print("level", sample.data, flush=True)
        for sample in stamped.take(N=10):
            age_s = time.time() - sample.header.stamp.sec
            print("stamped", sample.point.x, abs(age_s) < 60, flush=True)
        setpoints.write(FLOAT32(3.25))
        time.sleep(0.05)


if __name__ == "__main__":
    main()
