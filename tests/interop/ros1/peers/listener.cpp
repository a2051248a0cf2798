// The listener of the thesis (figure 1.18), and a count so that a test can end it.
#include "ros/ros.h"
#include "prova/hello.h"

void chatterCallback(const prova::hello::ConstPtr& msg)
{
    ROS_INFO("I heard: [%s]", msg->aWord.c_str());
}

int main(int argc, char** argv)
{
    ros::init(argc, argv, "listener");
    ros::NodeHandle n;
    ros::Subscriber sub = n.subscribe("/chatter", 1000, chatterCallback);
    ros::spin();
    return 0;
}
