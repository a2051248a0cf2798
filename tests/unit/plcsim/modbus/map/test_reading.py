import struct
from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.modbus.map import Area, IllegalAddress, Point
from plcsim.modbus.map.conversion import to_registers
from plcsim.modbus.map.reading import PLANS_KEPT, Reads
from plcsim.modbus.map.status_block import FIRST, ControllerStatus, registers

from ..plants import controller, points

HR, IR, CO, DI = Area.HOLDING_REGISTERS, Area.INPUT_REGISTERS, Area.COILS, Area.DISCRETE_INPUTS
PLC = controller()
PLC.boot()


class Memory:
    """The PLC memory as snapshots; counts how often one was copied."""

    def __init__(self) -> None:
        self.latest = 1
        self.copies = 0

    def copy(self, start: int, end: int) -> tuple[int, bytes]:
        self.copies += 1
        return self.latest, PLC.memory.read(start, end - start) if start else b""


def reads_of(*lines: str, strict: bool = False, order: str = "ABCD") -> Reads:
    given_points = points(PLC, *lines, order=order)
    return Reads(given_points, lambda address, _size: address, strict_holes=strict)


def read(reads: Reads, area: Area, address: int, count: int, memory: Memory | None = None) -> str:
    return reads.read(area, address, count, memory or Memory(), ControllerStatus).hex()


MAP = (
    "p.number,hr,0", "p.big,hr,1", "p.vast,hr,3", "p.real,hr,7", "p.text,hr,9,,,3",
    "p.flag,hr,12,0", "p.other,hr,12,1", "p.axes[1].ready,hr,12,15", "p.small,hr,13",
    "p.byte,hr,14", "p.flag,hr,15", "p.real,hr,16,,int16,,,,0.5,,,,1", "p.double,hr,20,,float32",
)  # fmt: skip


@pytest.mark.parametrize(
    ("address", "count", "wire"),
    [
        (0, 1, "fb2e"),
        (1, 2, "89abcdef"),
        (2, 1, "cdef"),
        (3, 4, "0123456789abcdef"),
        (4, 2, "456789ab"),
        (7, 2, "3fc00000"),
        (9, 3, "68656c6c6f00"),
        (10, 1, "6c6c"),
        (11, 1, "6f00"),
        (12, 1, "8001"),
        (13, 3, "fffd00c80001"),
        (16, 1, "0003"),
        (17, 3, "000000000000"),
        (20, 2, "c0100000"),
        (21, 1, "0000"),
    ],
)  # fmt: skip
def test_registers_are_as_on_the_wire(address: int, count: int, wire: str) -> None:
    assert read(reads_of(*MAP), HR, address, count) == wire


@pytest.mark.parametrize("order", ["CDAB", "BADC", "DCBA"])
def test_the_word_order_holds_for_parts_of_a_tag_too(order: str) -> None:
    reads = reads_of("p.vast,hr,0", order=order)
    whole = read(reads, HR, 0, 4)
    (point,) = points(PLC, "p.vast,hr,0", order=order)
    assert whole == to_registers(point, struct.pack("<Q", 0x0123456789ABCDEF)).hex()
    assert [read(reads, HR, i, 1) for i in range(4)] == [whole[4 * i : 4 * i + 4] for i in range(4)]


@given(st.data())
def test_any_part_of_a_map_is_that_part_of_the_whole(data: st.DataObject) -> None:
    order = data.draw(st.sampled_from(["ABCD", "CDAB", "BADC", "DCBA"]))
    reads = reads_of(*MAP, order=order)
    whole = read(reads, HR, 0, 22)
    address = data.draw(st.integers(0, 21))
    count = data.draw(st.integers(1, 22 - address))
    assert read(reads, HR, address, count) == whole[4 * address : 4 * (address + count)]


def test_a_read_over_everything_joins_the_parts() -> None:
    whole = read(reads_of(*MAP), HR, 0, 22)
    assert whole[:32] == "fb2e89abcdef0123456789abcdef3fc0"
    assert whole[32:] == "000068656c6c6f008001fffd00c800010003000000000000c0100000"


def test_bits_are_packed_the_first_in_the_lowest_bit() -> None:
    for bit in (0, 3, 9, 31):
        PLC.tags.write(PLC.tags.find(f"p.bits[{bit}]"), True)
    reads = reads_of(*(f"p.bits[{i}],co,{i + 5}" for i in range(32)), "p.flag,di,7")
    assert read(reads, CO, 5, 32) == "09020080"
    assert read(reads, CO, 5, 1) == "01"
    assert read(reads, CO, 6, 3) == "04"
    assert read(reads, CO, 8, 7) == "41"
    assert read(reads, DI, 7, 1) == "01"


def test_a_hole_reads_as_zero_and_the_outside_not_at_all() -> None:
    reads = reads_of("p.number,hr,10", "p.count,hr,20", "p.flag,co,3")
    assert read(reads, HR, 15, 6) == "00" * 10 + "abcd"
    for area, address, count in ((HR, 9, 1), (HR, 20, 2), (IR, 10, 1), (CO, 2, 1), (DI, 3, 1)):
        with pytest.raises(IllegalAddress, match="outside the map"):
            read(reads, area, address, count)


def test_strict_holes_refuse_what_has_no_tag() -> None:
    reads = reads_of("p.number,hr,10", "p.count,hr,12", strict=True)
    assert read(reads, HR, 10, 1) == "fb2e"
    with pytest.raises(IllegalAddress, match="without a tag"):
        read(reads, HR, 10, 3)


def test_a_tag_that_is_for_writing_only_reads_as_zero() -> None:
    assert read(reads_of("p.number,hr,10,,,,,wo"), HR, 10, 1) == "0000"


def test_an_answer_is_kept_while_its_snapshot_is_the_latest() -> None:
    memory, reads = Memory(), reads_of("p.number,hr,0")
    for _ in range(3):
        read(reads, HR, 0, 1, memory)
    assert memory.copies == 1
    memory.latest = 2
    read(reads, HR, 0, 1, memory)
    assert memory.copies == 2


def test_a_master_that_asks_for_ever_new_ranges_does_not_fill_the_memory() -> None:
    reads = reads_of(*(f"p.words[{i}],hr,{i}" for i in range(1, 301)))
    for address in range(1, 290):
        read(reads, HR, address, 1)
        read(reads, HR, address, 2)
    assert len(reads._plans) == PLANS_KEPT


def test_the_status_block_is_in_every_map() -> None:
    status = ControllerStatus(2, 1 << 33, 12_345, 99_000_000_000, 3, 0x0102030405060708)
    for reads in (reads_of(), reads_of("p.number,ir,65100", "p.count,ir,0")):
        block = reads.read(IR, FIRST, 21, Memory(), lambda: status)
        assert block == registers(status)
        assert reads.read(IR, FIRST + 1, 2, Memory(), lambda: status).hex() == "12345678"
    assert struct.unpack(">f", block[6:10])[0] == pytest.approx(123.456)
    assert block[10:14] == b"ABCD"
    assert struct.unpack(">HIHHIQ", block[20:]) == (2, 0, 12, 65535, 3, 0x0102030405060708)


@pytest.mark.parametrize(("address", "count"), [(64999, 2), (65020, 2), (65000, 22)])
def test_a_range_is_in_the_status_block_as_a_whole_or_not(address: int, count: int) -> None:
    with pytest.raises(IllegalAddress):
        read(reads_of("p.number,ir,0"), IR, address, count)


def aliases() -> Iterator[Point]:
    yield from points(PLC, "p.long,hr,0", "p.number,hr,1,,,,,,,,,,1")


def test_of_two_tags_at_one_address_the_later_row_is_read() -> None:
    reads = Reads(list(aliases()), lambda address, _size: address)
    assert read(reads, HR, 0, 2) == "f8a4fb2e"


def test_registers_of_the_status_block_never_read_as_holes() -> None:
    reads = reads_of("p.number,ir,64999", "p.count,ir,65021")
    for address, count in ((64999, 2), (65020, 2), (64999, 23), (65000, 22)):
        with pytest.raises(IllegalAddress):
            reads.check(IR, address, count)
    for address, count in ((64999, 1), (65000, 21), (65021, 1)):
        reads.check(IR, address, count)
