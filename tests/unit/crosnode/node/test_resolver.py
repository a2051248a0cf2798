"""Names by DNS on the virtual network: nobody waits, and nobody asks for ever."""

import struct
from ipaddress import ip_address

import pytest

from crosnode.errors import HostPendingError, InvalidNameError
from crosnode.graph.dns import PORT, NameServers
from crosnode.node import resolver as module
from crosnode.node.resolver import ASK_AGAIN_NS, ATTEMPTS, FORGET_NS, LEAST_NS, Resolver
from crosnode.node.status import StatusKind
from plcsim.network import Address, Outcome

from .world import MASTER_IP, MS, PLC_IP, World, news

SERVER_IP, OTHER_SERVER_IP = "192.168.0.53", "192.168.0.54"


class NameServer:
    """A name server: an address for each name it knows."""

    def __init__(self, world: World, names: dict[str, str], ip: str = SERVER_IP) -> None:
        self.names = names
        self.asked: list[str] = []
        self.kinds: list[int] = []
        made = world.net.host(ip).open_datagrams("", PORT).socket
        assert made is not None
        self.socket = made
        world.steps.append(self.step)

    def step(self) -> None:
        while True:
            outcome, data, peer = self.socket.recv(512)
            if outcome is not Outcome.OK:
                return
            labels, at = [], 12
            while data[at]:
                labels.append(data[at + 1 : at + 1 + data[at]].decode())
                at += 1 + data[at]
            self.asked.append(".".join(labels))
            (kind,) = struct.unpack_from(">H", data, at + 1)
            self.kinds.append(kind)
            self.reply(data, self.names.get(self.asked[-1]), peer, kind)

    def reply(self, asked: bytes, ip: str | None, peer: Address, kind: int = 1) -> None:
        """Answer; a name that has an address of the other kind exists, but without this one."""
        packed = ip_address(ip).packed if ip else b""
        fits = len(packed) == {1: 4, 28: 16}[kind]
        head = struct.pack(">HHHHHH", int.from_bytes(asked[:2], "big"),
                           0x8180 if ip else 0x8183, 1, int(fits), 0, 0)  # fmt: skip
        record = b""
        if fits:
            record = b"\xc0\x0c" + struct.pack(">HHIH", kind, 1, 1, len(packed)) + packed
        self.socket.send(head + asked[12:] + record, peer)


def rig(
    names: dict[str, str], *servers: str, domains: tuple[str, ...] = (), ipv6: bool = False
) -> tuple[World, NameServer, Resolver]:
    world = World(master=False)
    server = NameServer(world, names)
    asked = NameServers(servers or (SERVER_IP,), domains)
    found = Resolver(world.context(PLC_IP), asked, ipv6=ipv6)
    world.steps.append(found.step)
    return world, server, found


def known(found: Resolver, host: str) -> bool:
    try:
        found.find(host)
    except HostPendingError:
        return False
    return True


def test_a_name_is_asked_for_once_and_again_when_its_time_is_over() -> None:
    world, server, found = rig({"master.plant": "192.168.0.1"})
    with pytest.raises(HostPendingError):
        found.find("Master.plant")
    world.until(lambda: known(found, "master.plant"), 20)
    assert found.find("master.plant") == "192.168.0.1"
    world.run(1_000)
    assert server.asked == ["master.plant"]
    world.run(LEAST_NS // MS, step_ms=100)
    server.names["master.plant"] = "192.168.0.2"
    assert not known(found, "master.plant")
    world.until(lambda: known(found, "master.plant"), 20)
    assert found.find("master.plant") == "192.168.0.2"


def test_a_name_without_a_dot_is_looked_for_in_the_domains() -> None:
    world, server, found = rig({"arm.plant": "10.0.0.9"}, domains=("office", "plant"))
    assert not known(found, "arm")
    world.until(lambda: known(found, "arm"), 50)
    assert found.find("arm") == "10.0.0.9"
    assert server.asked == ["arm.office", "arm.plant"]


def test_a_name_that_nobody_knows_is_an_error_and_asked_for_again_later() -> None:
    world, server, found = rig({})
    assert not known(found, "nobody.plant")
    world.run(50)
    with pytest.raises(InvalidNameError, match=r"no name server knows host 'nobody\.plant'"):
        found.find("nobody.plant")
    server.names["nobody.plant"] = "10.0.0.3"
    world.run(FORGET_NS // MS, step_ms=100)
    assert not known(found, "nobody.plant")
    world.until(lambda: known(found, "nobody.plant"), 50)


def test_servers_that_do_not_answer_are_asked_in_turn_and_then_given_up() -> None:
    world, server, found = rig({"arm.plant": "10.0.0.9"}, OTHER_SERVER_IP, SERVER_IP)
    assert not known(found, "arm.plant")
    world.until(lambda: known(found, "arm.plant"), 1_100)
    assert server.asked == ["arm.plant"]
    silent = Resolver(world.context(PLC_IP), NameServers((OTHER_SERVER_IP,)))
    world.steps.append(silent.step)
    assert not known(silent, "arm.plant")
    world.run(ATTEMPTS * ASK_AGAIN_NS // MS + 10, step_ms=5)
    with pytest.raises(InvalidNameError):
        silent.find("arm.plant")


def test_answers_of_others_are_not_taken() -> None:
    world, server, found = rig({})
    server.reply = lambda *_: None  # type: ignore[method-assign]
    liar = world.net.host("192.168.0.66").open_datagrams("", PORT).socket
    assert liar is not None
    assert not known(found, "arm.plant")
    world.run(10)
    assert found._socket is not None
    number = found._names["arm.plant"].number
    lie = struct.pack(">HHHHHH", number, 0x8180, 1, 0, 0, 0) + b"\x03arm\x05plant\0\0\x01\0\x01"
    liar.send(lie, Address(PLC_IP, found._socket.local.port))
    world.run(10)
    assert not known(found, "arm.plant")


def test_what_is_kept_is_bounded_and_what_is_no_name_is_not_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(module, "MOST_NAMES", 5)
    _, _, found = rig({})
    for number in range(20):
        assert not known(found, f"host{number}.plant")
    assert len(found._names) == 5
    for text in ("a b", "x" * 300):
        with pytest.raises(InvalidNameError, match=r"add it to \[ros.hosts\]"):
            found.find(text)
    with pytest.raises(InvalidNameError):
        Resolver(World(master=False).context(PLC_IP), NameServers()).find("arm.plant")


def test_a_node_finds_master_publishers_and_services_by_name() -> None:
    world = World()
    server = NameServer(world, {"master.plant": MASTER_IP, "arm.plant": "192.168.0.30"})
    servers = NameServers((SERVER_IP,))
    world.master_uri = "http://master.plant:11311/"
    arm = world.node("arm", "192.168.0.30", environment={"ROS_HOSTNAME": "arm.plant"},
                     name_servers=servers)  # fmt: skip
    arm.host = "arm.plant"
    publisher = arm.register_publisher("/x", "std_msgs/String")
    provider = arm.register_service_provider("/s", "std_srvs/Trigger")
    node = world.node("n", name_servers=servers)
    subscriber = node.register_subscriber("/x", "std_msgs/String")
    world.until(lambda: publisher.subscribers and subscriber.publishers)
    caller = node.register_service_caller("/s", "std_srvs/Trigger")
    caller.call(caller.new())
    world.until(lambda: provider.requests)
    assert set(server.asked) == {"master.plant", "arm.plant"}
    assert news(node, StatusKind.PEER_REFUSED) == []


@pytest.mark.parametrize(
    ("ip", "kinds"), [("fd00::1", [28]), ("192.168.0.1", [28, 1]), ("fd00:0::b", [28])]
)
def test_with_ipv6_a_name_is_asked_for_both_kinds(ip: str, kinds: list[int]) -> None:
    world, server, found = rig({"master.plant": ip}, ipv6=True)
    world.until(lambda: known(found, "master.plant"), 20)
    assert found.find("master.plant") == str(ip_address(ip))
    assert server.kinds == kinds


def test_without_ipv6_nobody_is_asked_for_it() -> None:
    world, server, found = rig({"master.plant": "fd00::1"})
    with pytest.raises(InvalidNameError):
        world.until(lambda: known(found, "master.plant"), 20)
    assert server.kinds == [1]
