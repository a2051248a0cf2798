from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.network import Address, Link, Option, Outcome, WireLimits
from plcsim.network.virtual_socket import TRANSITIONS, SocketAct, SocketState

from .world import SERVER, World


def test_every_state_has_its_row_and_ends_closed() -> None:
    assert set(TRANSITIONS) == set(SocketState)
    for state, row in TRANSITIONS.items():
        assert (row.get(SocketAct.CLOSE) is SocketState.CLOSED) is (state is not SocketState.CLOSED)


def test_the_backlog_grows_by_a_second_listen() -> None:
    world = World()
    listener = world.listen(backlog=0)
    listener.listen(5)
    dialled = [world.dial() for _ in range(4)]
    assert [client.connect(target) for client, target in dialled] == [Outcome.OK] * 4


def test_the_send_buffer_is_that_of_a_small_controller() -> None:
    world = World(link=Link(latency_ns=1_000_000))
    client, _ = world.pair()
    assert client.send(bytes(100_000)) == (Outcome.OK, 8192)
    assert client.send(b"x") == (Outcome.WOULD_BLOCK, 0)


@settings(max_examples=50)
@given(
    data=st.binary(max_size=3_000),
    seed=st.integers(0, 2**32),
    smallest=st.integers(1, 50),
    jitter_ns=st.integers(0, 1_000),
    sends=st.lists(st.integers(1, 400), min_size=1, max_size=9),
    reads=st.lists(st.integers(1, 400), min_size=1, max_size=9),
)
def test_any_split_of_the_bytes_arrives_in_order(
    data: bytes, seed: int, smallest: int, jitter_ns: int, sends: list[int], reads: list[int]
) -> None:
    link = Link(
        latency_ns=500, jitter_ns=jitter_ns, smallest_packet=smallest, largest_packet=smallest + 20
    )
    world = World(seed=seed, link=link, limits=WireLimits(send_buffer=300, receive_buffer=200))
    client, server = world.pair()
    sent, got, turn = 0, b"", 0
    while len(got) < len(data):
        sent += client.send(data[sent : sent + sends[turn % len(sends)]]).taken
        world.now_ns += 100
        got += server.recv(reads[turn % len(reads)]).data
        turn += 1
        assert turn < 100_000
    client.close()
    assert got == data
    assert world.outcome_at(world.now_ns + 10_000, server) is Outcome.CLOSED


CALLS = {
    "listen": lambda s, n: s.listen(n),
    "accept": lambda s, n: s.accept().outcome,
    "connect": lambda s, n: s.connect(Address(SERVER, 80 + n % 3)),
    "send": lambda s, n: s.send(bytes(n * 50), urgent=n % 2 == 0).outcome,
    "recv": lambda s, n: s.recv(n, peek=n % 3 == 0, urgent=n % 4 == 0).outcome,
    "shutdown": lambda s, n: s.shutdown(read=n % 2 == 0, write=n % 3 == 0),
    "close": lambda s, n: s.close() or Outcome.OK,
    "option": lambda s, n: s.set_option(list(Option)[n % len(Option)], n),
    "linger": lambda s, n: s.set_linger(n % 3 - 1),
}


@settings(max_examples=100)
@given(
    st.lists(
        st.tuples(
            st.sampled_from([*CALLS, "open", "wait", "reset", "silence"]),
            st.integers(0, 9),
            st.integers(0, 200),
        ),
        max_size=60,
    )
)
def test_no_order_of_calls_raises_or_leaks(calls: list[tuple[str, int, int]]) -> None:
    world = World(limits=WireLimits(sockets=8))
    sockets = []
    for call, which, number in calls:
        if call == "open":
            host = world.server if number % 2 else world.client
            made = host.open("", 80 + number % 3 if number % 2 else 0).socket
            sockets += [] if made is None else [made]
        elif call == "wait":
            world.now_ns += number * 10_000_000
        elif call == "reset":
            world.faults.reset(SERVER)
        elif call == "silence":
            world.faults.silence(SERVER, until_ns=world.now_ns + number + 1)
        elif sockets:
            assert CALLS[call](sockets[which % len(sockets)], number) in Outcome
    assert world.server.socket_count <= 8
    for made in sockets:
        made.close()
    world.now_ns += 10 * world.net.limits.fade_ns
    world.net.settle()
    assert world.server.socket_count == world.client.socket_count == 0
