"""Tags to topics and back: values, times, changes, and what does not fit."""

import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from crosnode.graph.arguments import node_settings
from crosnode.master.server import MasterOptions, MasterServer
from crosnode.node import CrosNode, StatusKind
from crosnode.plc.bridge import is_power_of_two
from crosnode.plc.bridge_services import CallStatus
from crosnode.plc.bridge_topics import BridgeStatus
from crosnode.plc.extension import EXTENSION
from plcsim.core.clock import VirtualClock
from plcsim.core.context import Context
from plcsim.core.errors import ConfigurationError
from plcsim.core.memory import Memory
from plcsim.network import VirtualNetwork
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.settings.table import Table
from st_types import ARRAY, BOOL, INT, LREAL, REAL, STRING, TIME, UDINT, Struct, var

MS = 1_000_000


class Vector(Struct):
    x = var(LREAL)
    y = var(REAL)


class Speeds(Struct):
    linear = var(Vector)
    angular = var(Vector)
    note = var(INT, 7)


class Stamp(Struct):
    sec = var(UDINT)
    nsec = var(UDINT)


class Head(Struct):
    stamp = var(Stamp)


class Place(Struct):
    point = var(Vector)


class StampedPlace(Struct):
    header = var(Head)
    point = var(Vector)


class Reply(Struct):
    success = var(BOOL)
    message = var(STRING(20))


class Request(Struct):
    data = var(BOOL)


class Plant(Program):
    quality = var(INT)
    age = var(TIME)
    point = var(Place)
    stamped = var(StampedPlace)
    asked = var(BOOL)
    ignored = var(BOOL)
    request = var(Request)
    reply = var(Reply)
    count = var(INT)
    level = var(LREAL)
    text = var(STRING(5))
    on = var(BOOL)
    speeds = var(Speeds)
    joints = var(ARRAY(LREAL, (0, 2)))

    def cyclic(self) -> None:
        self.count += 1
        if self.asked:
            self.reply.success, self.reply.message = self.on, "done"
            self.asked = False


class Rig:
    """A controller with a bridge, and a peer node on the same host."""

    def __init__(self, **tables: dict[str, Any]) -> None:
        clock = self.clock = VirtualClock()
        host = VirtualNetwork(clock.now_ns).host("192.168.0.10")
        setup = Setup([TaskClassSetup(1, MS, [ProgramSetup("plant", PythonCode(Plant))])])
        self.plc = make_controller(setup, network=host, clock=clock)
        self.context = Context(Memory(), host)
        self.master = MasterServer(self.context, MasterOptions(host="127.0.0.1"))
        values = {"master": "http://127.0.0.1:11311/", "host": "127.0.0.1"} | tables
        table = Table(Path("plc.toml"), "ros", values)
        EXTENSION.attach(EXTENSION.read(table), self.plc)
        settings = node_settings("peer", environment={"ROS_MASTER_URI": self.master.uri},
                                 host="127.0.0.1")  # fmt: skip
        self.peer = CrosNode(self.context, settings)
        self.plc.image.watchers.append(lambda _: self._step())
        self.plc.boot()

    def _step(self) -> None:
        self.context.release_ns = self.clock.now_ns()
        self.master.step()
        self.peer.do_events_loop()

    def run(self, cycles: int) -> "Rig":
        self.plc.run(cycles=cycles)
        return self

    def tag(self, path: str) -> Any:
        return self.plc.tags.read(self.plc.tags.find(path))

    def set(self, path: str, value: object) -> None:
        self.plc.tags.write(self.plc.tags.find(path), value)


def entry(tag: str, type_name: str, **options: object) -> dict[str, object]:
    return {"tag": tag, "type": type_name} | options


def data_of(subscriber: Any) -> list[Any]:
    found = []
    while (message := subscriber.pop()) is not None:
        found.append(message.data)
    return found


def test_a_tag_is_published_at_its_rate() -> None:
    rig = Rig(publish={"/count": entry("plant.count", "std_msgs/Int16", every="10ms")})
    subscriber = rig.peer.register_subscriber("/count", "std_msgs/Int16", queue_size=1000)
    rig.run(300)
    counts = data_of(subscriber)
    assert len(counts) >= 20
    assert {b - a for a, b in pairwise(counts)} == {10}


def test_on_change_only_a_new_value_is_sent_and_a_late_subscriber_gets_it() -> None:
    rig = Rig(publish={"/on": entry("plant.on", "std_msgs/Bool", on_change=True)})
    rig.run(100)
    subscriber = rig.peer.register_subscriber("/on", "std_msgs/Bool")
    rig.run(100)
    rig.set("plant.on", True)
    rig.run(100)
    assert data_of(subscriber) == [False, True]


def test_a_structure_goes_out_and_comes_in_member_by_member() -> None:
    rig = Rig(
        publish={"/out": entry("plant.speeds", "geometry_msgs/Twist", every="10ms")},
        subscribe={"/in": entry("plant.speeds", "geometry_msgs/Twist")},
    )
    publisher = rig.peer.register_publisher("/in", "geometry_msgs/Twist", latching=True)
    subscriber = rig.peer.register_subscriber("/out", "geometry_msgs/Twist", queue_size=1)
    message: Any = publisher.new()
    message.linear.x, message.linear.y, message.linear.z = 1.25, 0.5, 9.0
    message.angular.x = -2.0
    publisher.send(message)
    rig.run(300)
    assert rig.tag("plant.speeds") == {
        "linear": {"x": 1.25, "y": 0.5},
        "angular": {"x": -2.0, "y": 0.0},
        "note": 7,
    }
    echo: Any = subscriber.pop()
    assert (echo.linear.x, echo.linear.y, echo.linear.z) == (1.25, 0.5, 0.0)
    assert echo.angular.x == -2.0


def test_what_a_tag_cannot_take_is_counted_and_logged_and_the_scan_goes_on() -> None:
    rig = Rig(subscribe={"/n": entry("plant.count", "std_msgs/Int64"),
                         "/t": entry("plant.text", "std_msgs/String")})  # fmt: skip
    numbers = rig.peer.register_publisher("/n", "std_msgs/Int64", latching=True)
    texts = rig.peer.register_publisher("/t", "std_msgs/String", latching=True)
    numbers.send(numbers.new(data=1 << 40))
    texts.send(texts.new(data="lang und länger"))
    rig.run(300)
    assert rig.tag("plant.text") == "lang "
    assert any("/n: " in str(line) and "plant.count" in str(line) for line in rig.plc.logbook)
    assert rig.plc.state.name == "RUN"


@pytest.mark.parametrize(
    ("body", "text"), [(b"\xc3\xa9", "é"), (b"a\xe9", "aé"), (b"\xc3\xa9\xff", "Ã©ÿ")]
)
def test_a_string_that_is_not_utf8_is_taken_byte_for_byte(body: bytes, text: str) -> None:
    rig = Rig(subscribe={"/t": entry("plant.text", "std_msgs/String")})
    texts = rig.peer.register_publisher("/t", "std_msgs/String", latching=True)
    texts.send_raw(len(body).to_bytes(4, "little") + body)
    rig.run(300)
    assert rig.tag("plant.text") == text
    assert not [line for line in rig.plc.logbook if "/t: " in str(line)]


def test_a_string_goes_out_as_utf8() -> None:
    rig = Rig(publish={"/t": entry("plant.text", "std_msgs/String", on_change=True)})
    subscriber = rig.peer.register_subscriber("/t", "std_msgs/String")
    rig.set("plant.text", b"a\xe9\x80")
    rig.run(300)
    assert subscriber.pop_raw() == b"\x05\0\0\0a\xc3\xa9\xc2\x80"


def test_a_number_that_is_none_is_sent_once() -> None:
    """NaN differs from itself: it would be sent in each cycle."""
    rig = Rig(publish={"/level": entry("plant.level", "std_msgs/Float64", on_change=True)})
    subscriber = rig.peer.register_subscriber("/level", "std_msgs/Float64", queue_size=100)
    rig.run(200)
    for value in (math.nan, 1.0):
        rig.set("plant.level", value)
        rig.run(50)
    assert repr(data_of(subscriber)) == "[0.0, nan, 1.0]"


@pytest.mark.parametrize(
    ("direction", "tag", "type_name", "text"),
    [
        ("publish", "plant.level", "geometry_msgs/Twist", "is one value"),
        ("publish", "plant.speeds", "std_msgs/Float64", "does not go with float64"),
        ("publish", "plant.level", "std_msgs/Int16", "std_msgs/Int16.data: expected an integer"),
        ("subscribe", "plant.count", "std_msgs/Float64", "std_msgs/Float64: 0.0 is not a INT"),
        ("subscribe", "plant.text", "std_msgs/Bool", "does not go with bool"),
    ],
)
def test_a_pair_that_never_fits_is_an_error_before_the_first_cycle(
    direction: str, tag: str, type_name: str, text: str
) -> None:
    with pytest.raises(ConfigurationError, match=f"plc.toml: ros.{direction}./x: .*{tag}.*{text}"):
        Rig(**{direction: {"/x": entry(tag, type_name)}})


def lines(rig: Rig) -> list[str]:
    return [entry.text for entry in rig.plc.logbook if entry.source == "ros"]


def test_the_logbook_says_whether_the_master_is_there() -> None:
    rig = Rig(publish={"/on": entry("plant.on", "std_msgs/Bool")})
    rig.run(200)
    assert lines(rig)[-1] == "master found http://127.0.0.1:11311/"
    uri = "http://nowhere:11311/"
    away = Rig(publish={"/on": entry("plant.on", "std_msgs/Bool")}, master=uri).run(12_000)
    (line,) = lines(away)
    assert line.startswith(f"master lost {uri}: no name server knows host 'nowhere'")


def test_what_a_peer_says_is_one_line_of_the_logbook() -> None:
    rig = Rig(publish={"/on": entry("plant.on", "std_msgs/Bool")}).run(200)
    bridge = next(s for s in rig.plc.context.libraries() if type(s).__name__ == "Bridge")
    bridge.node.core.tell(StatusKind.PEER_REFUSED, "/on", "a\nb\x1b[2J")
    rig.run(50)
    assert lines(rig)[-1] == "peer refused /on: a?b?[2J (1 so far)"


def test_the_logbook_says_which_peers_do_not_fit_but_not_each_time() -> None:
    rig = Rig(subscribe={"/n": entry("plant.count", "std_msgs/Int16")})
    rig.peer.register_publisher("/n", "std_msgs/Int64", latching=True)
    rig.run(5000)
    told = [line for line in lines(rig) if line.startswith("peer refused /n: md5sum ")]
    assert len(told) >= 2
    assert [line.rpartition("(")[2] for line in told[:2]] == ["1 so far)", "2 so far)"]


def test_counts_that_are_told() -> None:
    assert [n for n in range(1, 40) if is_power_of_two(n)] == [1, 2, 4, 8, 16, 32]


def test_unknown_tags_and_types_are_errors_before_the_first_cycle() -> None:
    with pytest.raises(ConfigurationError, match=r"plc.toml: ros.publish./x: .*plant\.nothing"):
        Rig(publish={"/x": entry("plant.nothing", "std_msgs/Bool")})
    with pytest.raises(ConfigurationError, match=r"plc.toml: ros.publish./x.type: .*no_msgs/Such"):
        Rig(publish={"/x": entry("plant.on", "no_msgs/Such")})


def test_at_the_end_the_bridge_takes_its_registrations_back() -> None:
    rig = Rig(publish={"/count": entry("plant.count", "std_msgs/Int16")})
    rig.run(100)
    assert "/plc_bridge" in str(rig.master.master.get_system_state("/x"))
    bridge = next(s for s in rig.plc.context.libraries() if type(s).__name__ == "Bridge")
    bridge.node.options = bridge.node.options._replace(beside=rig._step)
    rig.plc.shutdown()
    assert "/plc_bridge" not in str(rig.master.master.get_system_state("/x"))


def told(rig: Rig) -> list[str]:
    return [entry.text for entry in rig.plc.logbook if entry.source == "ros"]


def test_a_value_has_a_status_and_an_age() -> None:
    rig = Rig(subscribe={"/in": entry("plant.level", "std_msgs/Float64", timeout="100ms",
                                      status="plant.quality", age="plant.age")})  # fmt: skip
    publisher = rig.peer.register_publisher("/in", "std_msgs/Float64")
    rig.run(200)
    assert rig.tag("plant.quality") == BridgeStatus.NONE
    publisher.send(publisher.new(data=1.5))
    rig.run(20)
    assert (rig.tag("plant.level"), rig.tag("plant.quality")) == (1.5, BridgeStatus.GOOD)
    assert rig.tag("plant.age") in range(17, 21)
    rig.run(100)
    assert (rig.tag("plant.level"), rig.tag("plant.quality")) == (1.5, BridgeStatus.STALE)
    publisher.send(publisher.new(data=2.5))
    rig.run(20)
    assert rig.tag("plant.quality") == BridgeStatus.GOOD
    assert [line for line in told(rig) if line.startswith("/in")] == [
        "/in: no message for 101 ms (x1)", "/in: messages come again (x1)"
    ]  # fmt: skip


def test_without_a_timeout_a_value_is_good_while_its_publisher_is_there() -> None:
    rig = Rig(subscribe={"/in": entry("plant.level", "std_msgs/Float64", status="plant.quality")})
    publisher = rig.peer.register_publisher("/in", "std_msgs/Float64")
    rig.run(200)
    publisher.send(publisher.new(data=1.5))
    rig.run(5_000)
    assert rig.tag("plant.quality") == BridgeStatus.GOOD
    rig.peer.unregister(publisher)
    rig.run(100)
    assert rig.tag("plant.quality") == BridgeStatus.STALE
    assert any(line.startswith("/in: no publisher, the last message is") for line in told(rig))


def test_what_is_cut_is_told_beside_the_value() -> None:
    rig = Rig(subscribe={"/in": entry("plant.text", "std_msgs/String", status="plant.quality")})
    publisher = rig.peer.register_publisher("/in", "std_msgs/String")
    rig.run(200)
    publisher.send(publisher.new(data="too long"))
    rig.run(20)
    assert (rig.tag("plant.text"), rig.tag("plant.quality")) == ("too l", BridgeStatus.CUT)
    assert "/in: longer than what takes it: plant.text 1 times (x1)" in told(rig)


def test_who_publishes_knows_whether_anybody_listens() -> None:
    rig = Rig(publish={"/out": entry("plant.level", "std_msgs/Float64", status="plant.quality")})
    rig.run(100)
    assert rig.tag("plant.quality") == BridgeStatus.NONE
    rig.peer.register_subscriber("/out", "std_msgs/Float64")
    rig.run(100)
    assert rig.tag("plant.quality") == BridgeStatus.GOOD


def test_a_header_has_the_time_of_the_cycle_and_a_number() -> None:
    rig = Rig(publish={"/out": entry("plant.point", "geometry_msgs/PointStamped", every="10ms")})
    subscriber = rig.peer.register_subscriber("/out", "geometry_msgs/PointStamped")
    rig.run(300)
    found = []
    while (message := subscriber.pop()) is not None:
        found.append((message.header.stamp.to_ns(), message.header.seq))
    assert len(found) == 10
    assert {b[0] - a[0] for a, b in pairwise(found)} == {10 * MS}
    assert {b[1] - a[1] for a, b in pairwise(found)} == {1}


def test_a_stamp_of_the_tag_is_kept() -> None:
    rig = Rig(publish={"/out": entry("plant.stamped", "geometry_msgs/PointStamped")})
    subscriber = rig.peer.register_subscriber("/out", "geometry_msgs/PointStamped")
    rig.run(200)
    message = subscriber.pop()
    assert message is not None
    assert message.header.stamp.to_ns() == 0


def test_a_tag_follows_a_parameter() -> None:
    rig = Rig(parameters={"/limit": {"tag": "plant.level"}, "/word": {"tag": "plant.text"}})
    rig.peer.set_param("/limit", 2.5)
    rig.run(200)
    assert rig.tag("plant.level") == 2.5
    rig.peer.set_param("/limit", "much")
    rig.peer.set_param("/word", "hi")
    rig.run(200)
    assert (rig.tag("plant.level"), rig.tag("plant.text")) == (2.5, "hi")
    assert any("/limit" in line and "refused so far" in line for line in told(rig))


def test_a_program_answers_a_service_by_tags() -> None:
    service = {"type": "std_srvs/SetBool", "call": "plant.asked", "request": "plant.on",
               "response": "plant.reply"}  # fmt: skip
    rig = Rig(services={"/start": service})
    rig.run(200)
    caller = rig.peer.register_service_caller("/start", "std_srvs/SetBool")
    caller.call(caller.new(data=True))
    rig.run(100)
    (reply,) = iter(caller.pop, None)
    assert rig.tag("plant.on") is True
    assert reply.response is not None
    assert (reply.response.success, reply.response.message) == (True, "done")


def test_a_program_that_does_not_answer_in_time_is_told_of_to_the_caller() -> None:
    service = {"type": "std_srvs/Trigger", "call": "plant.ignored", "timeout": "300ms"}
    rig = Rig(services={"/start": service})
    rig.run(200)
    caller = rig.peer.register_service_caller("/start", "std_srvs/Trigger")
    caller.call(caller.new())
    rig.run(100)
    assert rig.tag("plant.ignored") is True
    rig.run(400)
    (reply,) = iter(caller.pop, None)
    assert reply.error == "the program did not answer in time"
    assert rig.tag("plant.ignored") is False


def calling(**more: str) -> Rig:
    """Return a rig whose program calls a service of the peer by tags, and has just called it."""
    call = {"type": "std_srvs/SetBool", "call": "plant.ignored", "request": "plant.request",
            "response": "plant.reply", "status": "plant.quality"}  # fmt: skip
    rig = Rig(calls={"/lamp": call | more})
    rig.run(200)
    assert rig.tag("plant.quality") == CallStatus.NONE
    rig.set("plant.request.data", value=True)
    return rig


def test_a_program_calls_a_service_by_tags() -> None:
    rig = calling()
    provider = rig.peer.register_service_provider("/lamp", "std_srvs/SetBool")
    rig.run(100)
    for number in range(3):
        rig.set("plant.ignored", value=True)
        rig.run(50)
        assert rig.tag("plant.quality") == CallStatus.RUNNING
        request = provider.pop()
        assert request is not None
        assert request.request.data is True
        request.respond(success=number != 1, message=f"lit {number}")
        rig.run(50)
        assert (rig.tag("plant.quality"), rig.tag("plant.ignored")) == (CallStatus.DONE, False)
        assert rig.tag("plant.reply") == {"success": number != 1, "message": f"lit {number}"}
    rig.run(100)
    assert provider.requests == 3


def test_a_call_that_nobody_answers_has_failed() -> None:
    rig = calling(timeout="300ms")
    rig.set("plant.ignored", value=True)
    rig.run(100)
    assert (rig.tag("plant.quality"), rig.tag("plant.ignored")) == (CallStatus.FAILED, False)
    provider = rig.peer.register_service_provider("/lamp", "std_srvs/SetBool")
    rig.run(100)
    rig.set("plant.ignored", value=True)
    rig.run(250)
    assert rig.tag("plant.quality") == CallStatus.RUNNING
    rig.run(100)
    assert (rig.tag("plant.quality"), rig.tag("plant.ignored")) == (CallStatus.FAILED, False)
    assert any("/lamp: no response in time" in line for line in told(rig))
    late = provider.pop()
    assert late is not None
    late.respond(success=True)
    rig.run(50)
    assert rig.tag("plant.reply.success") is False
    rig.set("plant.ignored", value=True)
    rig.run(50)
    again = provider.pop()
    assert again is not None
    again.respond(success=True)
    rig.run(50)
    assert rig.tag("plant.quality") == CallStatus.DONE


@pytest.mark.parametrize(
    ("tables", "reason"),
    [
        ({"calls": {"/s": {"type": "std_srvs/Trigger", "call": "plant.count"}}},
         "ros.calls./s: call: tag plant.count is INT, not BOOL"),
        ({"subscribe": {"/in": entry("plant.level", "std_msgs/Float64", status="plant.on")}},
         "status: tag plant.on is BOOL, which holds no 0..3"),
        ({"subscribe": {"/in": entry("plant.level", "std_msgs/Float64", age="plant.count")}},
         "age: tag plant.count is INT, not TIME"),
        ({"services": {"/s": {"type": "std_srvs/Trigger", "call": "plant.count"}}},
         "call: tag plant.count is INT, not BOOL"),
        ({"services": {"/s": {"type": "std_srvs/Nothing", "call": "plant.on"}}},
         "std_srvs/Nothing"),
        ({"parameters": {"/p": {"tag": "plant.nothing"}}}, "plant.nothing"),
    ],
)  # fmt: skip
def test_what_cannot_work_is_said_before_the_first_cycle(tables: Any, reason: str) -> None:
    with pytest.raises(ConfigurationError, match=reason):
        Rig(**tables)
