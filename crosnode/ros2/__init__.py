"""The bridge to ROS 2: tags to topics and topics to tags, by a process beside the scan."""
