"""What looks after our node with ROS' own libraries: tf2_ros and dynamic_reconfigure."""

import sys

import rospy


def tf() -> None:
    """Look up a frame that ours tells, and tell one."""
    import geometry_msgs.msg
    import tf2_ros

    rospy.init_node("tf_peer")
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    found = buffer.lookup_transform("world", "hand", rospy.Time(0), rospy.Duration(20))
    t = found.transform.translation
    print(f"hand {t.x:.3f} {t.y:.3f} {t.z:.3f}", flush=True)
    static = tf2_ros.StaticTransformBroadcaster()
    mounted = geometry_msgs.msg.TransformStamped()
    mounted.header.frame_id, mounted.child_frame_id = "hand", "camera"
    mounted.transform.translation.x, mounted.transform.rotation.w = 0.25, 1.0
    static.sendTransform(mounted)
    moving = tf2_ros.TransformBroadcaster()
    rate = rospy.Rate(50)
    while not rospy.is_shutdown():
        moved = geometry_msgs.msg.TransformStamped()
        moved.header.frame_id, moved.child_frame_id = "world", "cart"
        moved.header.stamp = rospy.Time.now()
        moved.transform.translation.y, moved.transform.rotation.z = 7.0, 1.0
        moving.sendTransform(moved)
        rate.sleep()
    del listener


def reconfigure() -> None:
    """Change values of ours with the client of dynamic_reconfigure."""
    import dynamic_reconfigure.client

    rospy.init_node("reconfigure_peer")
    client = dynamic_reconfigure.client.Client("/cell", timeout=100)
    described = client.get_parameter_descriptions(timeout=100)
    for each in described:
        print(each["name"], each["type"], each["min"], each["max"], each["default"], flush=True)
    answer = client.update_configuration({"speed": 99.0, "tool": "welder"})
    print("now", answer["speed"], answer["tool"], answer["careful"], flush=True)


if __name__ == "__main__":
    {"tf": tf, "reconfigure": reconfigure}[sys.argv[1]]()
