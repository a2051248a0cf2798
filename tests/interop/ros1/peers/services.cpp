// Provides /cpp_set and calls /plc_set: once a connection each, then over a persistent one.
#include "ros/ros.h"
#include "std_srvs/SetBool.h"

bool set(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response)
{
    response.success = request.data;
    response.message = "roscpp";
    return true;
}

int main(int argc, char** argv)
{
    ros::init(argc, argv, "cpp_services");
    ros::NodeHandle n;
    ros::ServiceServer server = n.advertiseService("/cpp_set", set);
    ros::AsyncSpinner spinner(1);
    spinner.start();
    if (!ros::service::waitForService("/plc_set", ros::Duration(100)))
        return 1;
    for (bool persistent : {false, true}) {
        ros::ServiceClient client = n.serviceClient<std_srvs::SetBool>("/plc_set", persistent);
        for (int i = 0; i < 3; ++i) {
            std_srvs::SetBool call;
            call.request.data = true;
            bool ok = client.call(call);
            printf("%d %d %s\n", int(persistent), int(ok), call.response.message.c_str());
            fflush(stdout);
        }
    }
    ros::waitForShutdown();
    return 0;
}
