"""A ROS 1 node that does one bounded step per scan cycle."""
