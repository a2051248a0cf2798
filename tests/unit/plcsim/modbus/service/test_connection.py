import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.modbus.service.connection import (
    FULL_BUFFER,
    WRITES_IN_FLIGHT,
    ModbusLimits,
)

from ..site import MS, Log, World, frame, frames

WORLD = World()
READ = bytes.fromhex("03 0000 0001")


def write(value: int, register: int = 0) -> bytes:
    return b"\x06" + struct.pack(">HH", register, value)


requests = st.sampled_from(
    [bytes.fromhex(t) for t in (
        "01 0000 0003", "03 0000 0006", "03 0000 007e", "06 0000 0001", "06 0004 0065",
        "10 0000 0001 02 0009", "16 0001 0000 0001", "17 0000 0001 0001 0001 02 0003", "63",
        "2b 0e 01 00", "11", "05 0000 1234", "06 0002 0000",
    )]
)  # fmt: skip


@given(st.lists(requests, min_size=1, max_size=20), st.data())
def test_requests_are_answered_in_order_however_their_bytes_arrive(
    pdus: list[bytes], data: st.DataObject
) -> None:
    stream = b"".join(frame(pdu, number) for number, pdu in enumerate(pdus))
    cuts = sorted(data.draw(st.lists(st.integers(0, len(stream)), max_size=8)))
    peer, answers = WORLD.connect(), b""
    for start, end in zip([0, *cuts], [*cuts, len(stream)], strict=True):
        answers += WORLD.exchange(peer, stream[start:end])
    found = frames(answers)
    assert [transaction for transaction, _, _ in found] == list(range(len(pdus)))
    assert [pdu[0] & 0x7F for _, _, pdu in found] == [pdu[0] for pdu in pdus]
    assert peer.requests == len(pdus)


@settings(max_examples=300)
@given(st.lists(st.binary(max_size=40), max_size=8))
def test_any_bytes_are_answered_or_close_the_connection(pieces: list[bytes]) -> None:
    peer, answers = WORLD.connect(), b""
    for piece in pieces:
        answers += WORLD.exchange(peer, piece)
    frames(answers)
    if not peer.fault:
        assert len(peer._buffer) < 260


@given(st.integers(0, 0xFFFF), st.integers(0, 255), st.binary(min_size=1, max_size=253))
def test_any_pdu_is_answered_under_its_transaction_unit_and_function(
    transaction: int, unit: int, pdu: bytes
) -> None:
    answer = WORLD.exchange(WORLD.connect(), frame(pdu, transaction, unit))
    ((answered, answered_unit, body),) = frames(answer)
    assert (answered, answered_unit) == (transaction, unit)
    assert body[0] in (pdu[0], pdu[0] | 0x80)
    if body[0] & 0x80:
        assert len(body) == 2
        assert body[1] in (1, 2, 3)


@pytest.mark.parametrize(
    ("data", "fault"),
    [
        ("0001 0001 0006 01 03 0000 0001", "protocol 1"),
        ("0001 0000 0000 01", "length of 0"),
        ("0001 0000 0001 01", "length of 1"),
        ("0001 0000 00ff 01", "length of 255"),
        ("0001 0000 ffff 01", "length of 65535"),
        (b"GET / HTTP/1.1\r\nHost: plc\r\n\r\n".hex(), "protocol 21536"),
        ("16030100c8010000c40303", "protocol 256"),
    ],
)
def test_what_is_not_modbus_closes_the_connection_and_is_not_answered(
    data: str, fault: str
) -> None:
    peer = WORLD.connect()
    assert WORLD.exchange(peer, bytes.fromhex(data)) == b""
    assert fault in peer.fault
    assert WORLD.exchange(peer, frame(READ)) == b""


def test_requests_before_a_fault_are_answered() -> None:
    peer = WORLD.connect()
    answers = WORLD.exchange(peer, frame(READ, 5) + bytes(7))
    assert [f[0] for f in frames(answers)] == [5]
    assert peer.fault


def test_thirty_requests_in_one_segment_are_all_answered() -> None:
    answers = WORLD.exchange(WORLD.connect(), b"".join(frame(READ, i) for i in range(30)))
    assert [f[0] for f in frames(answers)] == list(range(30))


def test_one_step_does_no_more_than_its_share() -> None:
    peer = WORLD.connect()
    peer.receive(b"".join(frame(READ, i) for i in range(100)))
    assert len(frames(peer.step(0, 64))) == 64
    assert peer.has_more
    assert len(frames(peer.step(0, 64))) == 36
    assert not peer.has_more


def test_a_peer_that_sends_faster_than_it_is_served_is_full() -> None:
    peer = WORLD.connect()
    assert not peer.is_full
    peer.receive(frame(READ) * (FULL_BUFFER // 12 + 1))
    assert peer.is_full


def test_writes_wait_for_the_scan_together_and_a_read_waits_for_them() -> None:
    world = World()
    peer = world.connect()
    peer.receive(frame(write(1), 1) + frame(write(2), 2) + frame(READ, 3))
    assert peer.step(0) == b""
    assert peer.is_waiting
    assert not peer.has_more
    world.run_a_cycle()
    assert peer.has_more is False
    answers = frames(peer.step(0))
    assert [f[0] for f in answers] == [1, 2, 3]
    assert answers[2][2].hex() == "03020002"


def test_only_so_many_writes_are_in_flight() -> None:
    world = World()
    peer = world.connect()
    peer.receive(b"".join(frame(write(i), i) for i in range(WRITES_IN_FLIGHT + 3)))
    peer.step(0)
    assert len(peer._writes) == WRITES_IN_FLIGHT
    world.run_a_cycle()
    assert len(frames(peer.step(0))) == WRITES_IN_FLIGHT
    world.run_a_cycle()
    assert len(frames(peer.step(0))) == 3


def test_a_refused_write_is_answered_behind_those_before_it() -> None:
    world = World()
    answers = world.exchange(
        world.connect(), frame(write(1), 1) + frame(write(101, 4), 2) + frame(write(3), 3)
    )
    assert [(f[0], f[2].hex()) for f in frames(answers)] == [
        (1, "0600000001"),
        (2, "8603"),
        (3, "0600000003"),
    ]


def test_a_write_that_the_scan_does_not_show_is_answered_busy_in_the_end() -> None:
    world = World(limits=ModbusLimits(write_timeout_ns=100 * MS))
    peer = world.connect()
    peer.receive(frame(write(1)))
    assert peer.step(0) == b""
    assert peer.step(99 * MS) == b""
    assert frames(peer.step(100 * MS))[0][2].hex() == "8606"


def test_a_write_is_answered_failed_when_the_scan_dies() -> None:
    world = World()
    peer = world.connect()
    peer.receive(frame(write(1)))
    peer.step(0)
    world.device.is_alive = False
    assert frames(peer.step(1))[0][2].hex() == "8604"


def test_a_full_ring_is_busy() -> None:
    world = World()
    peers = [world.connect() for _ in range(200)]
    answers = b""
    for peer in peers:
        peer.receive(b"".join(frame(write(i), i) for i in range(16)))
        answers += peer.step(0)
    for _ in range(250):
        world.run_a_cycle()
        for peer in peers:
            answers += peer.step(0)
    codes = {pdu.hex() for _, _, pdu in frames(answers) if pdu[0] & 0x80}
    assert codes <= {"8606"}
    assert len(frames(answers)) == 200 * 16


def test_units_that_are_not_served_get_the_gateway_code() -> None:
    world = World(limits=ModbusLimits(unit_ids=frozenset({1, 17})))
    assert world.ask(READ, unit=17) == "03020000"
    assert world.ask(READ, unit=2) == "830b"
    assert WORLD.ask(READ, unit=99)[:4] == "0302"


def test_every_write_is_audited_once() -> None:
    log = Log()
    world = World(audit=log)
    pdus = [write(1), READ, write(101, 4), bytes.fromhex("17 0000 0001 0000 0001 02 0009")]
    world.exchange(world.connect(), b"".join(frame(pdu) for pdu in pdus))
    assert log.applied_tags == [("p.words[1]", 1, 0), ("p.words[1]", 9, 1)]
    assert log.refused_codes == [("0600040065", 3)]


def test_a_write_whose_peer_has_gone_is_audited_all_the_same() -> None:
    log = Log()
    world = World(audit=log)
    peer = world.connect()
    peer.receive(frame(write(5)))
    peer.step(0)
    del peer
    world.run_a_cycle()
    assert log.applied_tags == [("p.words[1]", 5, 0)]


def test_a_write_that_was_answered_busy_is_audited_when_it_is_applied() -> None:
    log = Log()
    world = World(audit=log, limits=ModbusLimits(write_timeout_ns=MS))
    peer = world.connect()
    peer.receive(frame(write(5)))
    assert peer.step(0) == b""
    assert frames(peer.step(2 * MS))[0][2].hex() == "8606"
    assert log.applied_tags == []
    world.run_a_cycle()
    assert log.applied_tags == [("p.words[1]", 5, 0)]


def test_the_last_request_is_remembered_but_not_half_of_one() -> None:
    peer = WORLD.connect()
    peer.receive(frame(READ))
    peer.step(5 * 10**12)
    peer.receive(b"\0\1\0")
    peer.step(6 * 10**12)
    assert peer.last_request_ns == 5 * 10**12


def test_a_write_to_a_unit_that_is_not_served_is_audited_and_answered_in_its_turn() -> None:
    log = Log()
    world = World(audit=log, limits=ModbusLimits(unit_ids=frozenset({1})))
    peer = world.connect()
    peer.receive(frame(write(1), 1) + frame(write(2), 2, unit=9) + frame(write(3), 3))
    assert peer.step(0) == b""
    world.run_a_cycle()
    answers = frames(peer.step(0))
    assert [(t, pdu.hex()[:4]) for t, _, pdu in answers] == [(1, "0600"), (2, "860b"), (3, "0600")]
    assert log.applied_tags == [("p.words[1]", 1, 0), ("p.words[1]", 3, 1)]
    assert log.refused_codes == [("0600000002", 11)]


def test_a_write_takes_the_cycles_it_needs() -> None:
    world = World()
    cycles = world.tag("p.cycles")
    data = b"".join(frame(bytes.fromhex("06 0000 0001"), i) for i in range(40))
    assert len(frames(world.exchange(world.connect(), data))) == 40
    assert world.tag("p.cycles") == cycles + 3  # type: ignore[operator]  # a UDINT; 16 in flight


def test_a_write_to_a_stopped_controller_fails_instead_of_waiting() -> None:
    world = World()
    world.plc.shutdown()
    assert world.ask("06 0000 0001") == "8604"
