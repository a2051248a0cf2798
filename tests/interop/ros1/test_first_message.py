"""The first message reaches a new node within 20 ticks of a millisecond (issue of the node, speed).

The master is Debian's or ours, the publisher rospy's and latched: what is counted is the way to it,
which is a registration, a call, a connection and a header, and not the wait for its next message.
"""

import statistics

from .rig import Ros

TRIES = 9
MOST_TRIES = 90
"""The master and the publisher share the host with other tests, which may have it for a while."""

MOST_TICKS = 20


def ticks_to_first_message(ros: Ros, number: int) -> int:
    node = ros.node(f"plc{number}")
    subscriber = node.register_subscriber("/chatter", "std_msgs/String")
    ticks = ros.ticks_until(lambda: subscriber.queue)
    message = subscriber.pop()
    assert message is not None
    assert message.data == "rospy 0"  # type: ignore[attr-defined]
    node.close()
    ros.until(lambda: node.is_closed)
    return ticks


def test_the_first_message_comes_within_its_ticks(ros: Ros) -> None:
    ros.rospy("latch", "/chatter")
    ticks_to_first_message(ros, 0)  # waits until the publisher is up
    ticks = [ticks_to_first_message(ros, number) for number in range(1, TRIES + 1)]
    while statistics.median(ticks[-TRIES:]) > MOST_TICKS and len(ticks) < MOST_TRIES:
        ticks.append(ticks_to_first_message(ros, len(ticks) + 1))
    median = statistics.median(ticks[-TRIES:])
    print(f"\n{ros.kind}: first message after {median:.0f} ticks (median), all: {ticks}")
    assert median <= MOST_TICKS
