#!/usr/bin/env bash
# Installs ROS 1 from Debian's own packages: master, rospy, roscpp, the command-line tools and the
# common messages. No third-party source.
set -euo pipefail
. "$(dirname "$0")/../downloads.sh"
export DEBIAN_FRONTEND=noninteractive

tools=(rosout topic-tools python3-{roslaunch,rosmaster,rospy,rostopic,rosservice,rosnode,rosparam}
  python3-{rosmsg,rosbag,topic-tools,roswtf,message-filters,gencpp})
common=(geometry sensor nav diagnostic trajectory visualization actionlib tf2 stereo shape)
messages=(python3-std-msgs python3-std-srvs ros-std-msgs ros-std-srvs ros-roscpp-msg
  python3-actionlib libactionlib-dev python3-tf2-ros python3-dynamic-reconfigure
  ros-robot-state-publisher ros-rosgraph-msgs ros-topic-tools-srvs libroscpp-dev
  libstd-msgs-dev libstd-srvs-dev libgeometry-msgs-dev libsensor-msgs-dev)
for name in "${common[@]}"; do messages+=("python3-$name-msgs" "ros-$name-msgs"); done

apt_install g++ pkg-config "${tools[@]}" "${messages[@]}"
