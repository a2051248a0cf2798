// A roscpp publisher or subscriber, flat out, for ros_throughput.py:
//     ros_roscpp talk|listen String|UInt8MultiArray SIZE SECONDS
// roscpp drops what does not fit into a queue without a word, and slows down much while it does. So
// the publisher keeps as many messages on their way as a window holds: it lost nothing, and is faster.
#include <deque>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <std_msgs/UInt8MultiArray.h>

typedef boost::shared_array<uint8_t> Bytes;
static std::deque<Bytes> on_their_way;

// roscpp's own way to turn a message into bytes, and a note of the bytes: when their last other
// owner, the connection's queue, lets go, they are written.
template <typename M> ros::SerializedMessage serialized_and_noted(const M &message)
{
    namespace ser = ros::serialization;
    ros::SerializedMessage out;
    uint32_t length = ser::serializationLength(message);
    out.num_bytes = length + 4;
    out.buf.reset(new uint8_t[out.num_bytes]);
    ser::OStream stream(out.buf.get(), out.num_bytes);
    ser::serialize(stream, length);
    out.message_start = stream.getData();
    ser::serialize(stream, message);
    on_their_way.push_back(out.buf);
    return out;
}

namespace ros { namespace serialization {
template <> SerializedMessage serializeMessage(const std_msgs::String &message)
{
    return serialized_and_noted(message);
}
template <> SerializedMessage serializeMessage(const std_msgs::UInt8MultiArray &message)
{
    return serialized_and_noted(message);
}
}}

static void fill(std_msgs::String &message, size_t size) { message.data.assign(size, 'x'); }
static void fill(std_msgs::UInt8MultiArray &message, size_t size) { message.data.resize(size); }

static size_t queue_size(size_t size) { return size < 65536 ? 10000 : 100; }

template <typename M> void talk(ros::NodeHandle &node, size_t size)
{
    size_t window = queue_size(size) / 10;
    ros::Publisher publisher = node.advertise<M>("/in", queue_size(size));
    M message;
    fill(message, size);
    while (ros::ok() && publisher.getNumSubscribers() == 0)
        ros::WallDuration(0.01).sleep();
    while (ros::ok()) {
        while (!on_their_way.empty() && on_their_way.front().use_count() == 1)
            on_their_way.pop_front();
        if (on_their_way.size() < window)
            publisher.publish(message);
        else
            ros::WallDuration(0.00005).sleep();
    }
}

static long heard;

template <typename M> void hear(const boost::shared_ptr<M const> &) { ++heard; }

static void spin(double seconds)
{
    ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
    while (ros::ok() && ros::WallTime::now() < end)
        ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
}

template <typename M> void listen(ros::NodeHandle &node, size_t size, double seconds)
{
    ros::Subscriber subscriber = node.subscribe<M>(
        "/in", queue_size(size), &hear<M>, ros::TransportHints().tcpNoDelay());
    while (ros::ok() && heard == 0)
        spin(0.01);
    spin(0.5);
    long before = heard;
    ros::WallTime start = ros::WallTime::now();
    spin(seconds);
    printf("RATE %f\n", (heard - before) / (ros::WallTime::now() - start).toSec());
}

template <typename M> void run(const std::string &act, size_t size, double seconds)
{
    ros::NodeHandle node;
    if (act == "talk")
        talk<M>(node, size);
    else
        listen<M>(node, size, seconds);
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    std::string act = argv[1], kind = argv[2];
    size_t size = std::stoul(argv[3]);
    double seconds = std::stod(argv[4]);
    ros::init(argc, argv, "roscpp_" + act, ros::init_options::NoSigintHandler);
    if (kind == "String")
        run<std_msgs::String>(act, size, seconds);
    else
        run<std_msgs::UInt8MultiArray>(act, size, seconds);
    return 0;
}
