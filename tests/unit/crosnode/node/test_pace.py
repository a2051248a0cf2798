"""What a step may take follows the cycle; where it does not suffice is told."""

from crosnode.node import StatusKind
from crosnode.node.pace import Pace
from crosnode.transport.budget import LARGE_SHARE, STREAM_SHARE, StepLimits
from crosnode.transport.tcpip_socket import AREA_SIZE, TcpipSocketState, Transfer

from .world import MS, OTHER_IP, PLC_IP, SECOND, World, drain, news

BYTES = "std_msgs/UInt8MultiArray"


def after(cycles_ns: list[int], given: dict[str, int] | None = None) -> StepLimits:
    pace, now_ns = Pace(given or {}), 0
    for cycle_ns in cycles_ns:
        pace.begin(now_ns)
        now_ns += cycle_ns
    pace.begin(now_ns)
    return pace.limits


def test_a_cycle_of_ten_milliseconds_takes_ten_times_as_much() -> None:
    limits = after([10 * MS] * 16)
    assert limits == StepLimits(*(10 * each for each in StepLimits()))


def test_one_long_cycle_says_nothing_a_short_one_does() -> None:
    assert after([MS] * 5 + [50 * MS] + [MS] * 20) == StepLimits()
    assert after([10 * MS] * 20 + [MS]) == StepLimits()


def test_cycles_below_a_millisecond_have_the_bounds_of_one() -> None:
    assert after([200_000] * 40) == StepLimits()


def test_no_cycle_takes_more_than_a_hundred_times_as_much() -> None:
    assert after([SECOND] * 20).messages == 100 * StepLimits().messages


def test_what_is_given_holds_as_it_is() -> None:
    limits = after([10 * MS] * 20, {"messages": 7})
    assert limits.messages == 7
    assert limits.bytes_in == 10 * StepLimits().bytes_in


def shares(large: list[int]) -> list[int]:
    """Return what each step gives for the price of a byte, where so many large ones are moved."""
    pace, found = Pace({}), []
    for now_ns, moved in enumerate(large):
        budget = pace.begin(now_ns * MS)
        found.append(budget.large_share)
        budget.take_large(moved)
        pace.end(now_ns * MS, budget)
    return found


def test_a_large_message_now_and_then_is_spread_over_steps() -> None:
    message = [130_000] * 8 + [0] * 12
    assert set(shares(20 * message)) == {LARGE_SHARE}


def test_a_stream_of_large_messages_gets_more_of_a_step_until_it_ends() -> None:
    found = shares([260_000] * 100 + [0] * 100)
    assert found[:16] == [LARGE_SHARE] * 16
    assert set(found[16:100]) == {STREAM_SHARE}
    assert found[100:117] == [STREAM_SHARE] * 17
    assert set(found[117:]) == {LARGE_SHARE}


def test_a_step_reads_on_while_its_budget_lasts() -> None:
    world = World()
    node = world.node("n")
    subscriber = node.register_subscriber("/x", BYTES, queue_size=1000)
    publisher = world.node("o", OTHER_IP).register_publisher("/x", BYTES, queue_size=1000)
    world.until(lambda: publisher.subscribers)
    world.run(400, step_ms=10)
    (link,) = [each for each in node.core.loop.links if each.owner in subscriber.peers.values()]
    first = (9 * AREA_SIZE - 4).to_bytes(4, "little") + bytes(AREA_SIZE - 4)
    areas = [memoryview(bytes(AREA_SIZE))] * 8 + [memoryview(first)]
    full = FullSocket(link.socket.ident, areas)
    link.socket = full  # type: ignore[assignment]
    node.core.loop.pool.look = lambda: {full.ident}  # type: ignore[method-assign]
    world.run(10, step_ms=10)
    assert areas == []
    assert subscriber.queue.pushed == 1


class FullSocket:
    """A socket whose buffer holds many areas, as one of the host can."""

    def __init__(self, ident: int, areas: list[memoryview]) -> None:
        self.ident = ident
        self._areas = areas

    def read_area(self, size: int) -> tuple[TcpipSocketState, memoryview]:
        if self._areas:
            return TcpipSocketState.DONE, self._areas.pop()[:size]
        return TcpipSocketState.IN_PROGRESS, memoryview(b"")

    def read_into(self, target: memoryview) -> Transfer:
        """Fill the room of a message with as many areas as it takes."""
        size = 0
        while self._areas and size + len(self._areas[-1]) <= len(target):
            size += len(self._areas.pop())
        state = TcpipSocketState.DONE if size else TcpipSocketState.IN_PROGRESS
        return Transfer(state, size)


def test_five_thousand_messages_a_second_come_in_at_ten_milliseconds() -> None:
    world = World()
    node, other = world.node("n"), world.node("o", OTHER_IP)
    subscriber = node.register_subscriber("/x", BYTES, queue_size=1000)
    publisher = other.register_publisher("/x", BYTES, queue_size=1000)
    world.until(lambda: publisher.subscribers)
    world.run(400, step_ms=10)
    taken = 0
    for _ in range(100):
        for _ in range(50):
            publisher.send_raw(b"\0\0\0\0\0\0\0\0\0\0\0\0")
        world.run(10, step_ms=10)
        taken += len(drain(subscriber.pop_raw))
    assert taken >= 5_000 - 100


def test_the_check_of_the_master_shares_no_step_with_messages() -> None:
    world = World()
    node, other = world.node("n"), world.node("o", OTHER_IP)
    subscriber = node.register_subscriber("/x", BYTES, queue_size=10_000)
    publisher = other.register_publisher("/x", BYTES, queue_size=1000)
    world.until(lambda: publisher.subscribers)
    world.run(1_500)
    received_beside = []
    for _ in range(3_000):
        publisher.send_raw(bytes(20))
        before = subscriber.queue.pushed
        world.run(1)
        if node.core.budget.work <= 0:
            received_beside.append(subscriber.queue.pushed - before)
    assert len(received_beside) >= 3 * 2  # the call, and the XML of its answer
    assert set(received_beside) == {0}
    world.run(10)
    assert subscriber.queue.pushed == 3_000


def test_a_node_that_falls_behind_says_so_once() -> None:
    world = World()
    node, other = world.node("n", step=StepLimits(work=9_000)), world.node("o", OTHER_IP)
    subscriber = node.register_subscriber("/x", BYTES, queue_size=1000)
    publisher = other.register_publisher("/x", BYTES, queue_size=1000)
    world.until(lambda: publisher.subscribers)
    drain(node.pop_status)
    for _ in range(4_000):
        publisher.send_raw(bytes(20_000))
        world.run(1)
        drain(subscriber.pop_raw)
    assert len(news(node, StatusKind.BEHIND)) == 1
    assert node.pace.is_behind
    world.run(30_000)
    assert not node.pace.is_behind


def test_what_is_sent_leaves_in_the_same_cycle() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/chatter", BYTES, queue_size=1000)
    world.until(lambda: node.is_registered)
    peer = world.subscribe_raw(node)
    world.until(lambda: publisher.subscribers)
    world.receive(peer)
    (link,) = publisher.links
    publisher.send_raw(b"now")
    assert (link.waiting, len(publisher.links[link].queue)) == (0, 0)
    for _ in range(100):  # what the step has no budget for waits for the next
        publisher.send_raw(b"x" * 10_000)
    assert link.waiting + len(publisher.links[link].queue)
    assert len(world.receive(peer, 300)) == 7 + 100 * 10_004
    assert node.host == PLC_IP
