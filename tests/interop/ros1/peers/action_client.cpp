// An actionlib client of roscpp: sends three goals of actionlib/Test, cancels the second, says what
// becomes of them.
#include <actionlib/TestAction.h>
#include <actionlib/client/simple_action_client.h>
#include <ros/ros.h>

#include <cstdio>

int main(int argc, char** argv) {
  ros::init(argc, argv, "roscpp_action_client");
  actionlib::SimpleActionClient<actionlib::TestAction> client(argv[1], true);
  std::printf("connected %d\n", client.waitForServer(ros::Duration(100)));
  for (int number : {20, 30000, 10}) {
    actionlib::TestGoal goal;
    goal.goal = number;
    client.sendGoal(goal);
    if (number > 1000) {
      client.waitForResult(ros::Duration(0.3));
      client.cancelGoal();
    }
    client.waitForResult(ros::Duration(100));
    int result = client.getResult() ? client.getResult()->result : -99;
    std::printf("goal %d %s %d\n", number, client.getState().toString().c_str(), result);
  }
  std::fflush(stdout);
  return 0;
}
