"""Bags: the files that hold a recording, as ROS and its tools read them."""
