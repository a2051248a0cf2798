"""An actionlib client of rospy: sends goals of FollowJointTrajectory, says what becomes of them.

    action_peer.py client FULL_TEXT_FILE NAME [JOINTS [TARGETS]] | server NAME

A target with ! behind it has much time, and is cancelled once feedback has come.

The types are made of their full text, for Debian has no control_msgs.
"""

import sys
from pathlib import Path

import actionlib
import rospy
from actionlib.msg import TestAction, TestFeedback, TestResult
from actionlib_msgs.msg import GoalStatus
from genpy.dynamic import generate_dynamic

NAMES = {value: name for name, value in vars(GoalStatus).items() if name.isupper()}


def client(text_file, name, joints="a,b", targets="0.5,50.0!,1.0"):
    names = joints.split(",")
    kinds = generate_dynamic(
        "control_msgs/FollowJointTrajectoryAction", Path(text_file).read_text()
    )
    action = kinds["control_msgs/FollowJointTrajectoryAction"]
    goal_type = kinds["control_msgs/FollowJointTrajectoryGoal"]
    point_type = kinds["trajectory_msgs/JointTrajectoryPoint"]
    made = actionlib.SimpleActionClient(name, action)
    print("connected", made.wait_for_server(rospy.Duration(100)), flush=True)
    for word in targets.split(","):
        target, stop = float(word.rstrip("!")), word.endswith("!")
        goal = goal_type()
        goal.trajectory.joint_names = names
        time_s = 100 if stop else 1
        goal.trajectory.points = [
            point_type(positions=[target] * len(names), time_from_start=rospy.Duration(time_s))
        ]
        heard = []
        made.send_goal(goal, feedback_cb=heard.append)
        if stop:
            while not heard:
                rospy.sleep(0.01)
            made.cancel_goal()
        made.wait_for_result(rospy.Duration(60))
        result = made.get_result()
        print("goal", target, NAMES[made.get_state()], result and result.error_code,
              "feedback" if heard else "none", flush=True)  # fmt: skip


def server(name):
    def execute(goal):
        for number in range(goal.goal):
            made.publish_feedback(TestFeedback(number))
            rospy.sleep(0.02)
            if made.is_preempt_requested():
                made.set_preempted(TestResult(-1))
                return
        made.set_succeeded(TestResult(goal.goal * 2), "twice")

    made = actionlib.SimpleActionServer(name, TestAction, execute, auto_start=False)
    made.start()
    print("serving", flush=True)
    rospy.spin()


rospy.init_node("action_peer", anonymous=True)
{"client": client, "server": server}[sys.argv[1]](*sys.argv[2:])
