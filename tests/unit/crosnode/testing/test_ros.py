"""The network around a controller under test: master, nodes, and what the test itself does."""

import pytest

from crosnode.errors import InvalidNameError
from crosnode.plc.project import create_node
from crosnode.testing import Ros
from plcsim import Program
from plcsim.testing import ExpectationFailed, Plc, PlcTestError, open_plc
from plcsim.testing.target import program_target, project_target
from st_types import BOOL, STRING, UDINT, var

TEXT = "std_msgs/String"
MAIN = """
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import STRING, UDINT, var


class Cell(Program):
    __slots__ = ("node", "out", "into", "empty")
    heard = var(STRING(20))
    count = var(UDINT)
    speed = var(UDINT)

    def init(self):
        self.node = create_node(self.context, "cell")
        self.out = self.node.register_publisher("/out", "std_msgs/String")
        self.into = self.node.register_subscriber("/in", "std_msgs/String")
        self.empty = self.node.register_service_provider("/empty", "std_srvs/SetBool")

    def cyclic(self):
        self.node.do_events_loop()
        if (message := self.into.pop()) is not None:
            self.heard = message.data
            self.count += 1
            self.out.send(self.out.new(data=f"heard {message.data}"))
        if (request := self.empty.pop()) is not None:
            if request.request.data:
                request.respond(success=True, message="well")
            else:
                request.fail("not this way")

    def exit(self):
        self.node.destroy()
"""
SET_BOOL = "std_srvs/SetBool"


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "cell").mkdir()
    (tmp_path / "cell" / "main.py").write_text(MAIN)
    return tmp_path


@pytest.fixture
def open_cell(folder):
    """``open_cell(**[ros])``: a booted controller; several classes of tasks by ``more``."""
    made = []

    def open_cell(more="", **table):
        lines = "".join(f"{key} = {value}\n" for key, value in table.items())
        text = f'[task_class.1]\ncycle = "1ms"\nprograms = ["cell"]\n{more}[ros]\n{lines}'
        (folder / "plc.toml").write_text(text)
        opened = open_plc(project=folder)
        made.append(opened)
        return opened.__enter__()

    yield open_cell
    for opened in made:
        opened.__exit__(None, None, None)


@pytest.fixture(params=["the test's", "embedded"])
def plc(request, open_cell):
    return open_cell(**({"master": '"embedded"'} if request.param == "embedded" else {}))


@pytest.fixture
def ros(plc):
    return Ros(plc)


def test_topics_go_both_ways_between_hosts(plc, ros):
    out = ros.subscribe("/out", TEXT)
    plc.until(lambda: out.publishers)
    ros.publish("/in", TEXT, data="hello")
    plc.assert_within("5ms", {"cell.heard": "hello"})
    plc.until(lambda: out.queue, within="5ms")
    assert [message.data for message in iter(out.pop, None)] == ["heard hello"]
    assert {packet.source.ip for packet in plc.network.trace} >= {ros.tester.host, plc.ip}


def test_a_second_message_of_a_topic_goes_at_once(plc, ros):
    ros.publish("/in", TEXT, data="one")
    before_ns = plc.time_ns
    ros.publish("/in", TEXT, data="two")
    assert plc.time_ns == before_ns
    plc.assert_within("5ms", {"cell.count": 2, "cell.heard": "two"})


def test_a_service_is_called_and_its_failure_told(ros):
    response = ros.call("/empty", SET_BOOL, data=True)
    assert (response.success, response.message) == (True, "well")
    with pytest.raises(ExpectationFailed, match="the call of /empty failed: not this way"):
        ros.call("/empty", SET_BOOL, data=False)


def test_fields_may_have_any_name(ros):
    state = ros.message("rosgraph_msgs/TopicStatistics", topic="/out", node_pub="/cell")
    assert (state.topic, state.node_pub) == ("/out", "/cell")
    with pytest.raises(TypeError, match="unexpected keyword argument 'topic'"):
        ros.publish("/in", TEXT, topic="/out")


def test_calls_leave_nothing_behind(ros):
    for _ in range(3):
        ros.call("/empty", SET_BOOL, data=True)
    assert ros.tester.callers == []


def test_who_does_not_come_is_named(plc, ros):
    waited = r"waited 250 ms for a subscriber of /nobody"
    with pytest.raises(ExpectationFailed, match=waited), plc.assert_within("250ms"):
        ros.publish("/nobody", TEXT, data="x")
    waited = r"waited 250 ms for a provider of /nothing"
    with pytest.raises(ExpectationFailed, match=waited), plc.assert_within("250ms"):
        ros.call("/nothing", SET_BOOL)
    assert ros.tester.callers == []


def test_the_state_of_the_system_is_what_the_master_knows(plc, ros):
    plc.until(lambda: "/empty" in ros.system_state().services)
    state = ros.system_state()
    assert state.publishers["/out"] == state.subscribers["/in"] == ["/cell"]
    assert state.services["/empty"] == ["/cell"]
    plc.stop()
    after = ros.system_state()
    assert "/cell" not in str((after.publishers, after.subscribers, after.services))


def test_nodes_live_on_hosts_of_their_own(plc, ros):
    camera = ros.node("camera", "image:=/picture")
    robot = ros.node("robot", ip="192.168.0.50")
    assert [node.host for node in (ros.tester, camera, robot)] == [
        "192.168.0.101", "192.168.0.102", "192.168.0.50",
    ]  # fmt: skip
    picture = camera.register_publisher("image", TEXT, latching=True)
    picture.send(picture.new(data="black"))
    seen = robot.register_subscriber("/picture", TEXT)
    plc.until(lambda: seen.queue)
    assert seen.pop().data == "black"
    with pytest.raises(InvalidNameError):
        ros.node("no name")


def test_a_host_that_is_cut_off_is_missed_and_comes_back(plc, ros):
    ros.publish("/in", TEXT, data="one")
    plc.until({"cell.count": 1})
    plc.faults.silence(ros.tester.host, for_="1s")
    ros.publish("/in", TEXT, data="two")
    plc.assert_stable("cell.count", for_="990ms")
    plc.until({"cell.heard": "two"})


def test_a_node_that_closes_is_gone_from_the_master(plc, ros):
    other = ros.node("other")
    other.register_publisher("/news", TEXT)
    plc.until(lambda: "/news" in ros.system_state().publishers)
    other.close()
    plc.until(lambda: other.is_closed)
    assert "/news" not in ros.system_state().publishers


def test_a_node_may_be_destroyed_at_once(plc, ros):
    other = ros.node("other")
    other.register_publisher("/news", TEXT)
    plc.until(lambda: "/news" in ros.system_state().publishers)
    other.destroy()
    assert "/news" not in ros.system_state().publishers


def test_after_a_restart_of_the_controller_all_is_connected_again(plc, ros):
    out = ros.subscribe("/out", TEXT)
    ros.publish("/in", TEXT, data="one")
    plc.until({"cell.count": 1})
    plc.restart()
    assert plc["cell.count"] == 0
    plc.until(lambda: "/out" in ros.system_state().publishers and out.publishers, within="20s")
    ros.publish("/in", TEXT, data="two")
    plc.until({"cell.heard": "two"})


def test_two_runs_are_the_same_to_the_packet(folder, open_cell):
    def run():
        plc = open_cell()
        ros = Ros(plc)
        plc.faults.short_sends(7, host=ros.tester.host, for_="2s")
        out = ros.subscribe("/out", TEXT)
        plc.until(lambda: out.publishers)
        for number in range(5):
            ros.publish("/in", TEXT, data=f"message {number}")
        plc.until({"cell.count": 5})
        return plc.time_ns, list(plc.network.trace)

    assert run() == run()


def test_several_task_classes_step_the_hosts_once_at_a_time(open_cell):
    more = '[task_class.2]\ncycle = "1ms"\nprograms = [{name = "twin", source = "cell"}]\n'
    plc = open_cell(more)
    ros = Ros(plc)
    steps = []
    ros._hosts[0].step = lambda: steps.append(plc.clock.now_ns())
    plc.run("10ms")
    assert len(steps) == len(set(steps)) == 10


# The master


def test_without_a_master_the_program_goes_on_and_finds_the_next_one(open_cell):
    plc = open_cell(master='"http://robot.example:12345/"')
    ros = Ros(plc)
    ros.stop_master()
    plc.run("3s")
    with pytest.raises(PlcTestError, match="no master runs"):
        ros.system_state()
    ros.start_master()
    plc.until(lambda: "/out" in ros.system_state().publishers)
    ros.stop_master()
    ros.start_master()
    assert ros.system_state().publishers == {}
    plc.until(lambda: "/out" in ros.system_state().publishers)
    with pytest.raises(PlcTestError, match="a master runs already"):
        ros.start_master()


def test_the_embedded_master_ends_with_the_controller_only(open_cell):
    ros = Ros(open_cell(master='"embedded"'))
    for act in (ros.stop_master, ros.start_master):
        with pytest.raises(PlcTestError, match="the master is in the scan"):
            act()


def test_parameters_are_those_of_the_master(plc, ros):
    ros.tester.set_param("/speed", 3)
    plc.run("100ms")
    answer = ros.tester.get_param("/speed")
    plc.until(lambda: answer.was_answered)
    assert answer.value == 3


# What the project says


def test_host_and_bind_of_the_table_are_those_of_another_network(open_cell):
    plc = open_cell(host='"10.1.2.3"', bind='"10.1.2.3"', namespace='"/line"')
    ros = Ros(plc)
    plc.until(lambda: "/out" in ros.system_state().publishers)
    assert ros.system_state().publishers["/out"] == ["/line/cell"]


def test_the_environment_does_not_count(open_cell, monkeypatch):
    monkeypatch.setenv("ROS_NAMESPACE", "/elsewhere")
    monkeypatch.setenv("ROS_MASTER_URI", "http://10.1.1.1:1/")
    monkeypatch.setenv("ROS_IP", "10.1.1.2")
    ros = Ros(open_cell())
    assert ros.call("/empty", SET_BOOL, data=True).success
    assert ros.system_state().services["/empty"] == ["/cell"]


def test_without_a_table_it_must_come_before_the_boot():
    class Quiet(Program):
        __slots__ = ("node",)
        text = var(STRING(20), "hello")
        sent = var(UDINT)
        off = var(BOOL)

        def init(self):
            self.node = create_node(self.context, "quiet")
            self.node.register_publisher("/out", TEXT)

        def cyclic(self):
            self.node.do_events_loop()

    target = program_target([Quiet], "1ms")
    plc = Plc(target)
    ros = Ros(plc)
    plc.boot()
    plc.until(lambda: "/out" in ros.system_state().publishers)
    plc.close()
    late = Plc(target)
    late.boot()
    with pytest.raises(PlcTestError, match="booted without a table"):
        Ros(late)
    late.close()


def test_a_controller_has_one_network(ros, plc):
    with pytest.raises(PlcTestError, match="has its ROS network already"):
        Ros(plc)


def test_every_interleaving_can_have_one(folder, open_cell):
    more = '[task_class.2]\ncycle = "2ms"\nprograms = [{name = "twin", source = "cell"}]\n'
    open_cell(more)
    target = project_target(folder)
    plc = Plc(target)
    seen = 0
    for one in plc.every_interleaving(most=2):
        ros = Ros(one)
        assert ros.call("/empty", SET_BOOL, data=True).success
        seen += 1
    assert seen == 2
