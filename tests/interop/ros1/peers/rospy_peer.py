"""A rospy node for the tests, for Debian's python3. What it sees goes to stdout line by line."""

import sys

import rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse


def say(text):
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def listen(topic):
    rospy.Subscriber(topic, String, lambda message: say("heard " + message.data))
    rospy.spin()


def talk(topic, latched):
    publisher = rospy.Publisher(topic, String, queue_size=100, latch=bool(latched))
    rate = rospy.Rate(50)
    number = 0
    while not rospy.is_shutdown():
        if not latched or not number:
            publisher.publish(f"rospy {number}")
        number += 1
        rate.sleep()


def serve(service):
    def answer(request):
        if not request.data:
            raise ValueError("I will not")
        return SetBoolResponse(True, "rospy")

    rospy.Service(service, SetBool, answer)
    rospy.spin()


def call(service, persistent):
    rospy.wait_for_service(service, 100)
    proxy = rospy.ServiceProxy(service, SetBool, persistent=bool(persistent))
    for data in (True, True, False):
        try:
            say("answer " + proxy(data).message)
        except rospy.ServiceException as error:
            say(f"error {error}")
            if persistent:
                proxy = rospy.ServiceProxy(service, SetBool, persistent=True)
    rospy.sleep(0.1)


ACTS = {
    "listen": listen,
    "talk": lambda topic: talk(topic, 0),
    "latch": lambda topic: talk(topic, 1),
    "serve": serve,
    "call": lambda service: call(service, 0),
    "call_persistent": lambda service: call(service, 1),
}

act, name, *rest = rospy.myargv()[1:]
rospy.init_node("rospy_" + act, anonymous=True)
ACTS[act](name)
