"""An actionlib client of rospy that drives the cell until SIGINT, goal after goal.

    ros_cell_client.py FULL_TEXT_FILE

Prints a JSON line at the end: goals sent, and how many ended in each state. Runs with Debian's
python3; the types are made of their full text, for Debian has no control_msgs.
"""

import json
import signal
import sys
from collections import Counter
from pathlib import Path

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from genpy.dynamic import generate_dynamic

STATES = {value: name for name, value in vars(GoalStatus).items() if name.isupper()}
JOINTS = [f"joint_{number}" for number in range(1, 7)]
WAIT_S = 20.0


def main():
    text = Path(sys.argv[1]).read_text()
    kinds = generate_dynamic("control_msgs/FollowJointTrajectoryAction", text)
    rospy.init_node("planner", disable_signals=True)
    ended = []
    signal.signal(signal.SIGINT, lambda *_: ended.append(True))
    action = kinds["control_msgs/FollowJointTrajectoryAction"]
    client = actionlib.SimpleActionClient("/follow_joint_trajectory", action)
    print("connected", client.wait_for_server(rospy.Duration(60)), flush=True)
    found, sent, target = Counter(), 0, 0.5
    while not ended:
        goal = kinds["control_msgs/FollowJointTrajectoryGoal"]()
        goal.trajectory.joint_names = JOINTS
        goal.trajectory.points = [
            kinds["trajectory_msgs/JointTrajectoryPoint"](
                positions=[target * part / 10] * 6, time_from_start=rospy.Duration(0.1 * part)
            )
            for part in range(1, 11)
        ]
        # from where the arm is: the last goal ended at the other side
        for part, point in enumerate(goal.trajectory.points, 1):
            point.positions = [target * (2 * part / 10 - 1) if sent else target * part / 10] * 6
        client.send_goal(goal)
        sent += 1
        is_over = client.wait_for_result(rospy.Duration(WAIT_S))
        found[STATES[client.get_state()] if is_over else "NO RESULT"] += 1
        target = -target
    print(json.dumps({"sent": sent, "ended": found}), flush=True)


if __name__ == "__main__":
    main()
