"""The ROS graph: names of resources, URIs and hosts."""
