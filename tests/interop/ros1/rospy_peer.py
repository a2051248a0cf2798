"""Runs under Debian's python3: a rospy node in the role that its argument names."""

import sys

import rospy
from std_msgs.msg import Empty, String
from std_srvs.srv import SetBool, SetBoolResponse


def say(text):
    print(text, flush=True)


def talker():
    publisher = rospy.Publisher("chatter", String, queue_size=10, latch=True)
    publisher.publish("hello " * 300)
    say("ready")
    rospy.spin()


def listener():
    rospy.Subscriber("chatter", String, lambda message: say(message.data))
    rospy.Subscriber("nothing", Empty, lambda message: say("empty"))
    say("ready")
    rospy.spin()


def provider():
    def answer(request):
        if request.data:
            return SetBoolResponse(True, "done")
        raise ValueError("not today")

    rospy.Service("switch", SetBool, answer)
    say("ready")
    rospy.spin()


def caller():
    rospy.wait_for_service("switch", timeout=100)
    for persistent in (False, True):
        switch = rospy.ServiceProxy("switch", SetBool, persistent=persistent)
        say(switch(True).message)
        try:
            switch(False)
        except rospy.ServiceException as error:
            say(error)


def watcher():
    say(rospy.get_param("~gain"))
    rospy.set_param("~answer", {"x": [1, 2.5, "é", True]})
    say(rospy.search_param("top"))
    say("ready")
    rospy.spin()


rospy.init_node("peer_" + sys.argv[1])
globals()[sys.argv[1]]()
