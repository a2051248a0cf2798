import pytest

from crosnode.node import LogLevel
from crosnode.node.ros_time import Epoch

from .world import OTHER_IP, World, drain


def test_entries_go_to_rosout_with_time_and_topics() -> None:
    world = World()
    node = world.node("n", epoch=Epoch(10**18))
    subscriber = world.node("l", OTHER_IP).register_subscriber("/rosout", "rosgraph_msgs/Log")
    node.log(LogLevel.ERROR, "broken \ud800", file="main.py", line=3, function="cyclic")
    world.until(lambda: subscriber.queue)
    (entry,) = drain(subscriber.pop)
    assert (entry.level, entry.name, entry.msg) == (8, "/n", "broken ?")
    assert (entry.file, entry.line, entry.function) == ("main.py", 3, "cyclic")
    assert entry.topics == ["/rosout"]
    assert entry.header.stamp.to_ns() >= 10**18


def call(world: World, service: str, type_name: str, **values: object) -> object:
    node = world.node("caller", "192.168.0.50")
    caller = node.register_service_caller(service, type_name)
    caller.call(caller.new(**values))
    world.until(lambda: caller.replies)
    reply = caller.pop()
    node.close()
    return reply


@pytest.mark.parametrize(("level", "heard"), [("warn", 1), ("DEBUG", 3), ("fatal", 0)])
def test_the_level_is_set_by_a_service(level: str, heard: int) -> None:
    world = World()
    node = world.node("n")
    subscriber = world.node("l", OTHER_IP).register_subscriber("/rosout", "rosgraph_msgs/Log")
    world.until(lambda: subscriber.publishers and node.is_registered)
    reply = call(world, "/n/set_logger_level", "roscpp/SetLoggerLevel", logger="ros", level=level)
    assert not reply.error  # type: ignore[attr-defined]
    for each in (LogLevel.DEBUG, LogLevel.INFO, LogLevel.ERROR):
        node.log(each, "x")
    world.run(10)
    entries = [e for e in drain(subscriber.pop) if e.name == "/n"]
    assert len(entries) == heard
    reply = call(world, "/n/get_loggers", "roscpp/GetLoggers")
    assert [(e.name, e.level) for e in reply.response.loggers] == [("ros.crosnode", level.lower())]  # type: ignore[attr-defined]


def test_an_unknown_level_is_an_error_of_the_caller() -> None:
    world = World()
    node = world.node("n")
    world.until(lambda: node.is_registered)
    reply = call(world, "/n/set_logger_level", "roscpp/SetLoggerLevel", logger="x", level="loud")
    assert "no level 'LOUD'" in reply.error  # type: ignore[attr-defined]
