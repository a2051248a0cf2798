// A roscpp listener of the cell: counts what comes, and what is missing by the numbers of headers.
// Prints a line on SIGINT: messages, lost, connections seen to begin, transforms of the arm.
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>
#include <csignal>
#include <cstdio>

static unsigned long heard, lost, turns, frames;
static unsigned int next_number;

void joints(const ros::MessageEvent<sensor_msgs::JointState const>& event)
{
    const unsigned int number = event.getConstMessage()->header.seq;
    if (heard && number < next_number)
        turns++;  // the publisher began anew
    else if (heard)
        lost += number - next_number;
    next_number = number + 1;
    heard++;
}

void transforms(const tf2_msgs::TFMessage::ConstPtr& message)
{
    frames += message->transforms.size();
}

void end(int) { ros::requestShutdown(); }

int main(int argc, char** argv)
{
    ros::init(argc, argv, argc > 1 ? argv[1] : "listener", ros::init_options::NoSigintHandler);
    ros::NodeHandle node;
    std::signal(SIGINT, end);
    ros::TransportHints hints;
    ros::Subscriber a = node.subscribe("/joint_states", 5000, joints, hints.tcpNoDelay());
    ros::Subscriber b = node.subscribe("/tf", 5000, transforms);
    ros::spin();
    std::printf("%lu %lu %lu %lu\n", heard, lost, turns, frames);
    return 0;
}
