// Says numbered words on /chatter, 50 a second.
#include "ros/ros.h"
#include "prova/hello.h"

int main(int argc, char** argv)
{
    ros::init(argc, argv, "talker");
    ros::NodeHandle n;
    ros::Publisher pub = n.advertise<prova::hello>("/chatter", 1000);
    ros::Rate rate(50);
    for (int i = 0; ros::ok(); ++i) {
        prova::hello message;
        message.aWord = "roscpp " + std::to_string(i);
        pub.publish(message);
        ros::spinOnce();
        rate.sleep();
    }
    return 0;
}
