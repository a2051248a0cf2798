"""``plcsim ros topic`` on a virtual network."""

import re

import pytest

from crosnode.commands.topics import (
    Rate,
    echo,
    list_topics,
    measure,
    message_of,
    publish,
    tell_topic,
)
from crosnode.errors import MessageValueError
from crosnode.messages import MessageTypes
from plcsim.core.errors import PlcError

from ..node.world import MS, OTHER_IP, SECOND, STRING, words
from .network import Desk

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def desk() -> Desk:
    """A network where /talker says a word every 100 ms and /listener hears."""
    desk = Desk()
    talker = desk.world.node("talker")
    publisher = talker.register_publisher("/words", STRING, loop_period_ns=100 * MS)
    desk.world.node("listener", OTHER_IP).register_subscriber("/words", STRING)

    def speak() -> None:
        if (message := publisher.pop()) is not None:
            message.data = f"word {publisher.sent}"
            publisher.send(message)

    desk.world.steps.append(speak)
    desk.world.until(lambda: publisher.subscribers and talker.is_registered)
    return desk


def test_list(desk: Desk, capsys: Capture) -> None:
    desk.type(list_topics)
    assert capsys.readouterr().out == "/rosout [rosgraph_msgs/Log]\n/words [std_msgs/String]\n"


def test_info(desk: Desk, capsys: Capture) -> None:
    desk.type(tell_topic, topic="words")
    out = capsys.readouterr().out
    assert out.startswith("Type: std_msgs/String\n\nPublishers:\n * /talker (http://192.168.0.10:")
    assert "\nSubscribers:\n * /listener (http://192.168.0.20:" in out
    with pytest.raises(PlcError, match="/nothing: nobody publishes"):
        desk.type(tell_topic, topic="nothing")


def test_echo(desk: Desk, capsys: Capture) -> None:
    desk.type(echo, topic="/words", count=3)
    first, *others, last = capsys.readouterr().out.split("---\n")
    assert first.startswith('data: "word ')
    assert (len(others), last) == (2, "")


def test_hz(desk: Desk, capsys: Capture) -> None:
    desk.type(measure, topic="/words", for_ns=3 * SECOND)
    out = capsys.readouterr().out
    assert "average rate: 10.000\n\tmin: 0.100s max: 0.100s std dev: 0.00000s window: 1" in out


def test_hz_of_a_topic_that_is_quiet(capsys: Capture) -> None:
    desk = Desk()
    node = desk.world.node("quiet")
    node.register_publisher("/words", STRING)
    desk.world.until(lambda: node.is_registered)
    desk.type(measure, topic="/words", for_ns=SECOND)
    assert set(capsys.readouterr().out.splitlines()) == {"no new messages"}


def test_a_rate_of_messages_that_came_at_once() -> None:
    rate = Rate()
    assert str(rate) == "no new messages"
    rate.add(5)
    rate.add(5)
    assert str(rate) == "no new messages"


def test_pub_once(desk: Desk, capsys: Capture) -> None:
    listener = desk.world.node("other", "192.168.0.30").register_subscriber("/set", "std_msgs/Int8")
    options = {"type": "std_msgs/Int8", "rate": None, "once": True}
    desk.type(publish, topic="set", value="7", **options)
    assert listener.pop() == listener.message_type.new(data=7)
    assert listener.pop() is None
    assert capsys.readouterr().out == "plcsim: publishing /set, latched\n"


def test_pub_at_a_rate_until_it_is_interrupted(desk: Desk) -> None:
    listener = desk.world.node("other", "192.168.0.30").register_subscriber(
        "/set", STRING, queue_size=100
    )

    def interrupt() -> None:
        if listener.queue.pushed == 20:
            raise KeyboardInterrupt

    desk.world.steps.append(interrupt)
    start_ns = desk.world.now_ns
    with pytest.raises(KeyboardInterrupt):
        desk.type(publish, topic="/set", type=STRING, value="x", rate=10.0, once=False)
    assert words(listener.pop) == ["x"] * 20
    assert 1.9 * SECOND <= desk.world.now_ns - start_ns <= 2.5 * SECOND


def test_without_a_master_nothing_is_published() -> None:
    with pytest.raises(PlcError, match="no answer of the master"):
        Desk(master=False).type(publish, topic="/x", type=STRING, value="x", rate=1.0, once=False)


@pytest.mark.parametrize(
    ("type_name", "text", "values"),
    [
        (STRING, '{"data": "a"}', {"data": "a"}),
        (STRING, '"a"', {"data": "a"}),
        (STRING, "a b", {"data": "a b"}),
        (STRING, "{data: a b}", {"data": "a b"}),
        (STRING, "[INFO] a {b", {"data": "[INFO] a {b"}),
        ("std_msgs/Float64", "{data: 2}", {"data": 2.0}),
        ("std_msgs/Float64", "3.5", {"data": 3.5}),
        ("std_msgs/Empty", "{}", {}),
    ],
)
def test_a_value_stands_for_the_message_of_one_field(
    type_name: str, text: str, values: dict[str, object]
) -> None:
    types = MessageTypes()
    message_type = types.message(type_name)
    assert message_of(types, message_type, text) == message_type.new(**values)


def test_a_message_is_typed_as_for_rostopic() -> None:
    types = MessageTypes()
    text = "{joint_names: [a, b], points: [{positions: [1, 2.5], time_from_start: {secs: 1}}]}"
    trajectory = message_of(types, types.message("trajectory_msgs/JointTrajectory"), text)
    (point,) = trajectory.points
    assert trajectory.joint_names == ["a", "b"]
    assert (list(point.positions), point.time_from_start.secs) == ([1.0, 2.5], 1)


def test_a_value_that_fits_nothing() -> None:
    types = MessageTypes()
    wrong = re.escape("Twist: expected ':' at character 9, got '{x: 1}}'")
    with pytest.raises(MessageValueError, match=wrong):
        message_of(types, types.message("geometry_msgs/Twist"), "{linear {x: 1}}")
    with pytest.raises(MessageValueError, match="expected an object"):
        message_of(types, types.message("geometry_msgs/Twist"), "3")
