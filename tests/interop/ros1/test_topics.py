"""Topics with rospy and roscpp in both directions, and the master killed while messages flow."""

from pathlib import Path

from .rig import Ros

STRING = "std_msgs/String"


def test_from_us_to_rospy(ros: Ros) -> None:
    node = ros.node("plc")
    publisher = node.register_publisher("/chatter", STRING)
    peer = ros.rospy("listen", "/chatter")
    ros.until(lambda: publisher.subscribers)
    for number in range(200):
        publisher.send(publisher.new(data=f"plc {number}"))
        ros.tick()
    ros.until(lambda: "plc 199" in peer.text)
    assert peer.text.split("\n")[:200] == [f"heard plc {number}" for number in range(200)]


def test_from_rospy_to_us(ros: Ros) -> None:
    node = ros.node("plc")
    subscriber = node.register_subscriber("/chatter", STRING, queue_size=1000)
    ros.rospy("talk", "/chatter")
    ros.until(lambda: len(subscriber.queue) >= 50)
    numbers = []
    while (message := subscriber.pop()) is not None:
        numbers.append(int(message.data.split()[1]))  # type: ignore[attr-defined]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_latched_both_ways(ros: Ros) -> None:
    node = ros.node("plc")
    publisher = node.register_publisher("/ours", STRING, latching=True)
    publisher.send(publisher.new(data="kept"))
    subscriber = node.register_subscriber("/theirs", STRING)
    ros.rospy("latch", "/theirs")
    ros.until(lambda: subscriber.queue)
    peer = ros.rospy("listen", "/ours")
    ros.until(lambda: "heard kept" in peer.text)


def test_roscpp_both_ways(ros: Ros, roscpp: Path) -> None:
    node = ros.node("plc")
    subscriber = node.register_subscriber("/chatter", "prova/hello", queue_size=1000)
    publisher = node.register_publisher("/plc", "prova/hello", loop_period_ns=20_000_000)
    talker = ros.start([str(roscpp / "talker")])
    listener = ros.start([str(roscpp / "listener"), "/chatter:=/plc"])

    def say() -> None:
        if (message := publisher.pop()) is not None:
            message.aWord = "from the cycle"  # type: ignore[attr-defined]
            publisher.send(message)

    ros.steps.append(say)
    ros.until(lambda: len(subscriber.queue) >= 50)
    ros.until(lambda: listener.text.count("I heard: [from the cycle]") >= 50)
    assert talker.is_running


def test_a_publisher_that_returns_is_connected_again(ros: Ros) -> None:
    node = ros.node("plc")
    subscriber = node.register_subscriber("/chatter", STRING, queue_size=1000)
    first = ros.rospy("talk", "/chatter")
    ros.until(lambda: subscriber.queue)
    first.kill()
    ros.until(lambda: subscriber.publishers == 0)
    subscriber.queue.release()
    ros.rospy("talk", "/chatter")
    ros.until(lambda: subscriber.queue)


def test_a_wrong_md5_is_told_to_both(ros: Ros) -> None:
    node = ros.node("plc")
    publisher = node.register_publisher("/chatter", "std_msgs/Int32")
    peer = ros.rospy("listen", "/chatter")
    ros.until(lambda: "PEER_REFUSED" in str(list(node.statuses._entries)))
    assert publisher.subscribers == 0
    assert peer.is_running


def test_the_master_is_killed_and_started_again_while_messages_flow(ros: Ros) -> None:
    node = ros.node("plc")
    publisher = node.register_publisher("/ours", STRING, queue_size=1000)
    subscriber = node.register_subscriber("/theirs", STRING, queue_size=10_000)
    node.register_service_provider("/plc_set", "std_srvs/SetBool")
    param = node.subscribe_param("/speed")
    peer = ros.rospy("listen", "/ours")
    ros.rospy("talk", "/theirs")
    ros.until(lambda: publisher.subscribers and subscriber.publishers)
    sent = [0]

    def say() -> None:
        publisher.send(publisher.new(data=f"plc {sent[0]}"))
        sent[0] += 1

    ros.steps.append(say)
    ros.run(1)
    ros.master.kill()
    ros.run(1)
    ros.start_master()
    ros.until(lambda: node.core.master.is_found and node.is_registered)
    assert "/plc" in ros.tool("rosnode", "list")
    pushed = subscriber.queue.pushed
    ros.run(7)  # rospy does not register again; its connection is kept
    ros.until(lambda: subscriber.queue.pushed - pushed > 250)
    ros.tool("rosparam", "set", "/speed", "7")
    ros.until(lambda: param.value == 7)
    ros.steps.clear()
    ros.until(lambda: f"plc {sent[0] - 1}\n" in peer.text)
    heard = [line for line in peer.text.split("\n") if line.startswith("heard plc")]
    first = int(heard[0].split()[-1])
    assert heard == [f"heard plc {number}" for number in range(first, sent[0])]
    numbers = []
    while (message := subscriber.pop()) is not None:
        numbers.append(int(message.data.split()[1]))  # type: ignore[attr-defined]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
