"""A ROS 1 master without input and output, and the process that serves it."""
