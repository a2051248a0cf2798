"""The live view, asked by a plain WebSocket client as Foxglove asks."""

from collections.abc import Iterator

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.control import Action
from plcsim.network import VirtualNetwork
from plcsim.program.setup import make_controller
from plcsim.recorder.bag.head import Head
from plcsim.recorder.bag.writing import tag_messages
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.service.live import PERIOD_NS, Live
from plcsim.shared_image.command import Command, Control, StoreCommand, Write

from ..conftest import Fast, application_of
from .viewer import PAUSE, PAUSED, PLAY, PLAYING, Viewer

pytest.importorskip("foxglove")
pytest.importorskip("websockets.sync.client")


class Scene:
    def __init__(self, *tags: str, is_virtual: bool = False) -> None:
        clock = VirtualClock()
        net = VirtualNetwork(clock.now_ns).host("192.168.0.10")
        self.controller = make_controller(application_of(Fast).setup, network=net, clock=clock)
        self.controller.boot()
        self.head = Head(
            "cell",
            is_virtual=is_virtual,
            epoch_ns=100,
            origin_ns=0,
            classes=[(1, 10_000_000)],
            areas=self.controller.areas,
            tags=tags,
            sources={},
        )
        self.sent: list[Command] = []
        self.live = Live(self.head, 0, tag_messages(self.head), self._take)
        self.viewer = Viewer(self.live.port)
        self._now_ns = 0

    def _take(self, command: Command) -> int:
        self.sent.append(command)
        return 1

    def show(self, **values: object) -> None:
        """Show the variables with new values, long enough after those before."""
        for name, value in values.items():
            tag = self.controller.tags.find(f"Fast.{name}")
            self.controller.tags.write(tag, value)
        self._now_ns += PERIOD_NS
        memory = self.controller.memory
        data = b"".join(memory.view(a.address, a.data_type.size) for a in self.head.areas)
        self.live.show(self._now_ns, data)

    def close(self) -> None:
        self.viewer.close()
        self.live.close()


@pytest.fixture
def scene() -> Iterator[Scene]:
    made = Scene()
    yield made
    made.close()


def test_every_tag_is_a_channel_of_ros2msg_and_cdr(scene: Scene) -> None:
    channels = {each["topic"]: each for each in scene.viewer.told("advertise")["channels"]}

    assert sorted(channels) == [
        "/Fast/count", "/Fast/doubled", "/Fast/lamp", "/Fast/name", "/Fast/told"
    ]  # fmt: skip
    count = channels["/Fast/count"]
    assert (count["encoding"], count["schemaEncoding"]) == ("cdr", "ros2msg")
    assert count["schemaName"] == "std_msgs/msg/UInt32"
    assert count["schema"].split() == ["uint32", "data"]


def test_who_subscribes_gets_the_value_and_then_its_changes(scene: Scene) -> None:
    channels = {e["topic"]: e["id"] for e in scene.viewer.told("advertise")["channels"]}
    scene.viewer.say(
        "subscribe",
        subscriptions=[
            {"id": 5, "channelId": channels["/Fast/count"]},
            {"id": 6, "channelId": channels["/Fast/name"]},
        ],
    )
    scene.viewer.say("getParameters", parameterNames=["plcsim.paused"], id="1")
    scene.viewer.told("parameterValues")  # the server has read what came before
    scene.show(count=7)
    scene.show(count=7)
    scene.show(count=8)

    found = [scene.viewer.data() for _ in range(3)]
    assert found == [
        (5, 100 + PERIOD_NS, b"\0\1\0\0\7\0\0\0"),
        (6, 100 + PERIOD_NS, b"\0\1\0\0\5\0\0\0fast\0"),
        (5, 100 + 3 * PERIOD_NS, b"\0\1\0\0\x08\0\0\0"),
    ]


def test_tags_are_parameters_that_can_be_set(scene: Scene) -> None:
    scene.show(told=3)
    scene.viewer.say("getParameters", parameterNames=[], id="1")
    values = {e["name"]: e.get("value") for e in scene.viewer.told("parameterValues")["parameters"]}
    assert values == {
        "plcsim.paused": False,
        "Fast.count": 0,
        "Fast.told": 3,
        "Fast.doubled": 0,
        "Fast.lamp": False,
        "Fast.name": "fast",
    }

    wanted = [{"name": "Fast.told", "value": 9}, {"name": "Fast.lamp", "value": True}]
    scene.viewer.say("setParameters", parameters=wanted, id="2")
    assert scene.viewer.told("parameterValues")["parameters"] == wanted
    address = {n: scene.controller.tags.find(f"Fast.{n}").address for n in ("told", "lamp")}
    assert scene.sent == [
        Write([StoreCommand(address["told"], b"\x09\0")]),
        Write([StoreCommand(address["lamp"], b"\1")]),
    ]


@pytest.mark.parametrize("value", [70_000, -1, 1.5, "much", [1]])
def test_a_value_that_does_not_fit_changes_nothing(scene: Scene, value: object) -> None:
    scene.show(told=3)
    wanted = [{"name": "Fast.told", "value": value}, {"name": "no.tag", "value": 1}]
    scene.viewer.say("setParameters", parameters=wanted, id="2")

    assert scene.viewer.told("parameterValues")["parameters"] == [{"name": "Fast.told", "value": 3}]
    assert scene.sent == []


def test_time_is_stopped_and_goes_on_by_a_parameter(scene: Scene) -> None:
    for value in (True, False):
        wanted = [{"name": "plcsim.paused", "value": value}]
        scene.viewer.say("setParameters", parameters=wanted, id="1")
        assert scene.viewer.told("parameterValues")["parameters"] == wanted

    assert scene.sent == [Control(Action.PAUSE, by="live"), Control(Action.CONTINUE, by="live")]


def test_the_buttons_of_a_viewer_stop_and_pace_the_virtual_clock() -> None:
    scene = Scene(is_virtual=True)
    info = scene.viewer.told("serverInfo")
    assert "playbackControl" in info["capabilities"]
    start = info["dataStartTime"]
    assert (start["sec"], start["nsec"]) == (0, 100)

    def press(command: int, speed: float) -> tuple[int, float]:
        scene.viewer.press(command, speed)
        return scene.viewer.playback()

    assert press(PLAY, 1.0) == (PLAYING, 1.0)
    assert press(PAUSE, 1.0) == (PAUSED, 1.0)
    assert press(PLAY, 2.5) == (PLAYING, 2.5)
    scene.show(count=5)
    assert scene.viewer.playback() == (PLAYING, 2.5)
    assert scene.sent == [
        Control(Action.PAUSE, by="live"),
        Control(Action.SPEED, 2_500_000, "live"),
        Control(Action.CONTINUE, by="live"),
    ]
    scene.close()


def test_a_port_in_use_is_told(scene: Scene) -> None:
    with pytest.raises(RecordingError, match=f"record.live: port {scene.live.port} cannot"):
        Live(scene.head, scene.live.port, [], scene._take)
