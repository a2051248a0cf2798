// Says one latched word on /cpp_latched, hears /plc_latched, sets /cpp_gain and follows /plc_gain.
#include "ros/ros.h"
#include "std_msgs/String.h"

void hear(const std_msgs::String::ConstPtr& message)
{
    printf("heard %s\n", message->data.c_str());
    fflush(stdout);
}

int main(int argc, char** argv)
{
    ros::init(argc, argv, "cpp_latched");
    ros::NodeHandle n;
    ros::Publisher publisher = n.advertise<std_msgs::String>("/cpp_latched", 1, true);
    std_msgs::String word;
    word.data = "kept by roscpp";
    publisher.publish(word);
    ros::Subscriber subscriber = n.subscribe("/plc_latched", 10, hear);
    n.setParam("/cpp_gain", 2.5);
    double last = 0, gain = 0;
    for (ros::WallRate rate(50); ros::ok(); rate.sleep()) {
        ros::spinOnce();
        // the first call subscribes to the parameter, later ones ask nobody
        if (n.getParamCached("/plc_gain", gain) && gain != last) {
            printf("gain %g\n", gain);
            fflush(stdout);
            last = gain;
        }
    }
    return 0;
}
