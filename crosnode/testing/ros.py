"""The ROS network around the controller under test: a master, nodes, each on a host of its own."""

from __future__ import annotations

from functools import partial
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.graph.arguments import node_settings
from crosnode.master.server import MasterOptions, MasterServer
from crosnode.node import CrosNode, NodeOptions
from crosnode.plc.extension import EXTENSION
from crosnode.plc.in_process_master import InProcessMaster
from crosnode.plc.player import ROUND_NS, Player
from crosnode.plc.project import MASTER_IP, SharedTypes, step_beside, surroundings
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.core.system import State
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.errors import RecordingError
from plcsim.settings.table import Table
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from crosnode.messages import Message
    from crosnode.node import Publisher, Subscriber
    from plcsim.testing import Plc

__tracebackhide__ = True

FIRST_IP: Final = 101
"""Last part of the address of the first node; the following ones count up."""

SETTLING: Final = 3
"""Cycles between a connection and the first message of a bag."""

SETTLING_NS: Final = 500_000_000
"""As long as no other topic is subscribed to for so long, all are."""

QUEUE: Final = 1000
"""Messages that wait for the test; in a program it is ten, but a test looks only now and then."""


class SystemState(NamedTuple):
    """What is registered with the master: names of nodes by topic or service."""

    publishers: dict[str, list[str]]
    subscribers: dict[str, list[str]]
    services: dict[str, list[str]]


class Ros:
    """The other hosts of the controller's ROS network; what the fixture ``ros`` is.

    The nodes of the programs find a master: the embedded one where plc.toml says so, otherwise one
    at 192.168.0.1 that takes the place of the master in plc.toml or ROS_MASTER_URI. All on other
    hosts do one step after every cycle of the controller.

    Args:
        plc: the controller under test, on the virtual network.

    Attributes:
        tester: node ``/tester``, for what the test itself publishes, subscribes to and calls.

    Raises:
        PlcTestError: the project has no table [ros], and the controller has booted.
    """

    def __init__(self, plc: Plc) -> None:
        self._plc = plc
        self._context = plc.controller.context
        self._hosts: list[_Host] = []
        self._numbers = count(FIRST_IP)
        self._players = count(1)
        self._publishers: dict[tuple[str, str], Publisher] = {}
        self._last_ns = -1
        self._playing: _Host | None = None
        self._happened = self._step_ns = 0
        self._enter()
        self._types = self._context.library(SharedTypes)
        self._master: MasterServer | None = None
        self._master_host: _Host | None = None
        if not self._is_embedded:
            self.start_master()
        self.tester = self.node("tester")
        plc.after_cycle.append(self._after_cycle)

    def _enter(self) -> None:
        """Let the programs' nodes know of the other hosts."""
        found = surroundings(self._context)
        if found is None:
            self._attach()
            found = surroundings(self._context)
            assert found is not None
        if found.beside is not None:
            raise PlcTestError("ros: this controller has its ROS network already")
        self._found = found
        self._is_embedded = found.settings.is_embedded
        self._context.give_settings(found._replace(beside=self._step))

    def _attach(self) -> None:
        """Act as an empty table [ros] would, before any program makes a node."""
        if self._plc.controller.state is not State.BOOT:
            raise PlcTestError(
                "ros: the programs were booted without a table [ros] in plc.toml; add one (it may "
                "be empty), or use @pytest.mark.plc(boot=False) and call plc.boot()"
            )
        settings = EXTENSION.read(Table(Path("plc.toml"), "ros", {}))
        here = EXTENSION.in_process(settings, self._plc.ip)
        EXTENSION.attach(here, self._plc.controller)

    # The master

    @property
    def master(self) -> MasterServer:
        """The master.

        Raises:
            PlcTestError: it is stopped.
        """
        self._find_embedded()
        if self._master is None:
            raise PlcTestError("ros: no master runs")
        return self._master

    def _find_embedded(self) -> None:
        """Note the present embedded master: every start of the controller makes another one."""
        if self._is_embedded and self._plc.controller.state is State.RUN:
            self._master = self._context.library(InProcessMaster)

    def stop_master(self) -> None:
        """End the master at once: its connections end, and what it knows is lost.

        Raises:
            PlcTestError: it is stopped, or embedded: it ends with the controller.
        """
        self._require_own_master()
        self.master.close()
        self._master = None
        assert self._master_host
        self._hosts.remove(self._master_host)

    def start_master(self) -> None:
        """Start another master, which knows nothing.

        Raises:
            PlcTestError: one runs.
        """
        self._require_own_master()
        if self._master is not None:
            raise PlcTestError("ros: a master runs already; stop_master() ends it")
        host = self._master_host = self._new_host(MASTER_IP)
        self._master = MasterServer(host.context, MasterOptions(host=MASTER_IP))
        host.step = self._master.step

    def _require_own_master(self) -> None:
        if self._is_embedded:
            raise PlcTestError("ros: the master is in the scan; plc.restart() starts it again")

    def system_state(self) -> SystemState:
        """Return what is registered with the master."""
        _, _, kinds = self.master.master.get_system_state("")
        return SystemState(*(dict(kind) for kind in kinds))

    # Nodes

    def node(self, name: str, *arguments: str, ip: str = "") -> CrosNode:
        """Return a new node on a host of its own, with all that nodes of programs have.

        Args:
            name: base name of the node.
            arguments: remapping arguments such as ``chatter:=/other``.
            ip: of its host, which may have several; by default 192.168.0.101 and so on.

        Raises:
            InvalidNameError: a name is not legal.
        """
        host = self._new_host(ip or f"192.168.0.{next(self._numbers)}")
        environment = {"ROS_MASTER_URI": self._found.settings.master_uri}
        settings = node_settings(name, arguments, environment, host=host.ip)
        options = NodeOptions(epoch=self._found.epoch, beside=partial(step_beside, self._context))
        node = CrosNode(host.context, settings, self._types, options)
        host.step = node.do_events_loop
        return node

    def _new_host(self, ip: str) -> _Host:
        host = _Host(ip, Context(Memory(), self._plc.network.host(ip)))
        host.context.release_ns = self._plc.clock.now_ns()
        self._hosts.append(host)
        return host

    def message(self, type_name: str, /, **values: object) -> Message:
        """Return a message, as part of another one: ``points=[ros.message(...), ...]``."""
        return self._types.message(type_name).new(**values)

    # What the tools of ROS do, by the node /tester

    def subscribe(self, topic: str, type_name: str) -> Subscriber:
        """Subscribe to a topic from now on, as ``rostopic echo`` does; ``pop`` gives messages.

        It takes some cycles until the subscriber is connected.
        """
        return self.tester.register_subscriber(topic, type_name, queue_size=QUEUE)

    def publish(self, topic: str, type_name: str, /, **values: object) -> None:
        """Send a message as ``rostopic pub`` does; its fields are ``values``, else defaults.

        For the first one of a topic the controller runs until somebody subscribes.

        Raises:
            TypeError: there is no such field.
            MessageValueError: a field cannot hold its value.
            ExpectationFailed: nobody subscribes in time (see `Plc.until`).
        """
        publisher = self._publishers.get((topic, type_name))
        if publisher is None:
            publisher = self.tester.register_publisher(topic, type_name)
            self._publishers[topic, type_name] = publisher
        message = publisher.new(**values)
        self._until(f"a subscriber of {topic}", lambda: publisher.subscribers)
        publisher.send(message)

    def replay(self, bag: str | Path, topics: Collection[str] = ()) -> int:
        """Play a bag to the programs: each message at its recorded time, on the virtual clock.

        Types that the project does not know are taken from the bag. The controller runs until the
        last message is sent and one cycle more; before the first one it runs until somebody
        subscribes to a topic of the bag.

        Args:
            bag: of ``rosbag record``, of ROS 2 or of plcsim; relative names begin at the test's
                working directory.
            topics: that are played; none for all that programs subscribe to.

        Returns:
            how many messages were played.

        Raises:
            PlcTestError: the bag is damaged, has no such topic, or a type is another one here.
            ExpectationFailed: nobody subscribes in time (see `Plc.until`).
        """
        plc = self._plc
        player_node = self.node(f"player_{next(self._players)}")
        host = self._hosts[-1]
        try:
            with open_bag(Path(bag)) as reader:
                wanted = topics or self._subscribed({topic.name for topic in reader.topics})
                player = Player(reader, player_node, wanted, self._context.traffic)
                heard = [p for n, p in player.publishers.items() if n in self._heard()]
                self._until(
                    "subscribers of the bag's topics", lambda: all(p.subscribers for p in heard)
                )
                plc.advance(SETTLING * plc.cycle_ns)  # the subscriber has to see the connection too
                player.start(plc.clock.now_ns())
                host.step = lambda: player.step(plc.clock.now_ns())
                self._playing = host
                plc.advance(reader.end_ns - reader.start_ns + plc.cycle_ns, lambda: player.is_over)
                plc.cycles(1)
                return player.sent
        except RecordingError as error:
            raise PlcTestError(str(error)) from None
        finally:
            self._playing = None

    def _heard(self) -> set[str]:
        """Return the topics that somebody subscribes to."""
        return set(self.system_state().subscribers)

    def _subscribed(self, topics: Collection[str]) -> list[str]:
        """Run until programs subscribe to some of these topics; return which."""

        def found() -> list[str]:
            return sorted(set(topics) & self._heard())

        self._until("a subscriber of a topic of the bag", found)
        known: list[str] = []
        while known != found():  # a node registers one topic after another
            known = found()
            self._plc.advance(SETTLING_NS)
        return known

    def call(self, service: str, type_name: str, /, **values: object) -> Message:
        """Call a service as ``rosservice call`` does; the controller runs until the reply.

        Args:
            service: its name.
            type_name: ``pkg/Name``.
            values: fields of the request.

        Returns:
            The response.

        Raises:
            TypeError: there is no such field.
            MessageValueError: a field cannot hold its value.
            ExpectationFailed: there is no provider or no reply in time, or the call fails; then
                with the reason that the provider gives.
        """
        caller = self.tester.register_service_caller(service, type_name)
        name = caller.service
        try:
            request = caller.new(**values)
            self._until(f"a provider of {name}", lambda: name in self.system_state().services)
            caller.call(request)
            self._until(f"a reply of {name}", lambda: caller.replies)
        finally:
            self.tester.unregister(caller)
        reply = caller.pop()
        assert reply is not None
        if reply.response is None:
            self._plc.fail(f"the call of {name} failed: {reply.error}", ())
        return reply.response

    def _until(self, what: str, condition: Callable[[], object]) -> None:
        condition.__name__ = what  # for the text of the failure
        self._plc.until(condition)

    # Steps

    def _after_cycle(self) -> None:
        """Step all hosts, once at a time: task classes may be released together."""
        now_ns = self._plc.clock.now_ns()
        if now_ns > self._last_ns:
            self._last_ns = now_ns
            self._find_embedded()
            self._step()

    def _step(self) -> None:
        now_ns = self._plc.clock.now_ns()
        playing = self._playing
        for host in [playing] if playing and self._rests(now_ns) else self._hosts:
            host.context.release_ns = now_ns
            host.step()

    def _rests(self, now_ns: int) -> bool:
        """Whether nothing has happened on the network since all hosts did a step.

        It counts while a bag is played, when no test asks them for anything; their timers may wait.
        """
        happened = self._plc.network.happened
        if happened == self._happened and now_ns < self._step_ns + ROUND_NS:
            return True
        self._happened, self._step_ns = happened, now_ns
        return False


class _Host:
    """A computer of the network, and what runs on it."""

    def __init__(self, ip: str, context: Context) -> None:
        self.ip = ip
        self.context = context
        self.step: Callable[[], None] = lambda: None
