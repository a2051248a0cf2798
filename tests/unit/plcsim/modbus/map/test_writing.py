import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.modbus.map import Area, IllegalAddress, IllegalValue
from plcsim.modbus.map.conversion import to_registers
from plcsim.modbus.map.reading import Reads
from plcsim.modbus.map.status_block import ControllerStatus
from plcsim.modbus.map.writing import Writes
from plcsim.shared_image import Mask, Scatter, StoreCommand

from ..plants import controller, points

PLC = controller()
PLC.boot()


def address(path: str) -> int:
    return PLC.tags.find(path).address


def writes_of(*lines: str, order: str = "ABCD") -> Writes:
    return Writes(points(PLC, *lines, order=order))


def test_registers_become_stores_of_whole_variables() -> None:
    writes = writes_of("p.number,hr,0", "p.big,hr,1,,,,CDAB", "p.text,hr,3,,,2")
    data = bytes.fromhex("fb2e cdef89ab 68690000")
    assert writes.registers(0, data).operations == (
        StoreCommand(address("p.number"), struct.pack("<h", -1234)),
        StoreCommand(address("p.big"), struct.pack("<I", 0x89ABCDEF)),
        StoreCommand(address("p.text"), b"hi".ljust(10, b"\0")),
    )


def test_an_array_is_one_store() -> None:
    writes = writes_of(*(f"p.words[{i}],hr,{i}" for i in range(1, 124)))
    assert len(writes.registers(1, bytes(246)).operations) == 1
    coils = writes_of(*(f"p.bits[{i}],co,{i}" for i in range(32)))
    assert coils.coils(0, [True, False] * 16).operations == (
        StoreCommand(address("p.bits"), b"\1\0" * 16),
    )


@pytest.mark.parametrize(
    ("lines", "first", "data"),
    [
        (["p.number,hr,0"], 1, "0001"),
        (["p.number,hr,0"], 0, "00010002"),
        (["p.number,hr,0", "p.count,hr,2"], 0, "000100020003"),
        (["p.number,hr,0,,,,,ro"], 0, "0001"),
        (["p.number,ir,0"], 0, "0001"),
        (["p.number,hr,0", "p.count,hr,1,,,,,ro"], 0, "00010002"),
        (["p.long,hr,0"], 0, "0001"),
        (["p.long,hr,0"], 1, "0001"),
        (["p.vast,hr,0"], 1, "00010002"),
        (["p.text,hr,0"], 0, "00010002"),
        (["p.flag,hr,0,0", "p.other,hr,0,1,,,,ro"], 0, "0003"),
    ],
)
def test_what_cannot_be_written_whole_is_refused(lines: list[str], first: int, data: str) -> None:
    with pytest.raises(IllegalAddress):
        writes_of(*lines).registers(first, bytes.fromhex(data))


def test_one_value_out_of_range_refuses_the_whole_write() -> None:
    writes = writes_of("p.number,hr,0", "p.percent,hr,1")
    assert len(writes.registers(0, bytes.fromhex("00010064")).operations) == 2
    with pytest.raises(IllegalValue, match="percent"):
        writes.registers(0, bytes.fromhex("00010065"))


@pytest.mark.parametrize("order", ["ABCD", "CDAB", "BADC", "DCBA"])
@pytest.mark.parametrize("register", [0, 1, 2, 3])
def test_a_partial_tag_takes_a_register_in_every_order(order: str, register: int) -> None:
    row = "p.vast,hr,0,,,,,,,,,,,1"
    writes = writes_of(row, order=order)
    PLC.tags.write(PLC.tags.find("p.vast"), 0)
    for operation in writes.registers(register, b"\x12\x34").operations:
        if isinstance(operation, Scatter):
            for place, value in zip(operation.addresses, operation.data, strict=True):
                PLC.memory.write(place, bytes([value]))
        else:
            assert isinstance(operation, StoreCommand)
            PLC.memory.write(*operation)
    reads = Reads(points(PLC, row, order=order), lambda a, _: a)

    class Memory:
        latest = 1

        def copy(self, start: int, end: int) -> tuple[int, bytes]:
            return 1, PLC.memory.read(start, end - start)

    whole = reads.read(Area.HOLDING_REGISTERS, 0, 4, Memory(), ControllerStatus)
    assert whole.hex() == "".join("1234" if i == register else "0000" for i in range(4))


@pytest.mark.parametrize("order", ["ABCD", "CDAB", "BADC", "DCBA"])
@pytest.mark.parametrize(("tag", "code"), [("p.real", "f"), ("p.double", "d")])
@given(number=st.integers(0, 2**64 - 1), start=st.integers(0, 2**64 - 1))
def test_no_sequence_of_parts_makes_a_real_other_than_finite(
    tag: str, code: str, order: str, number: int, start: int
) -> None:
    size = struct.calcsize(code)
    row = f"{tag},hr,0,,,,,,,,,,,1"
    writes = writes_of(row, order=order)
    (point,) = points(PLC, row, order=order)
    wanted = (number % (1 << 8 * size)).to_bytes(size, "big")
    before = (start % (1 << 8 * size)).to_bytes(size, "big")
    if not math.isfinite(struct.unpack(">" + code, before)[0]):
        return
    PLC.memory.write(address(tag), before[::-1])
    wire = to_registers(point, wanted[::-1])
    for register in range(size // 2):
        try:
            write = writes.registers(register, wire[2 * register : 2 * register + 2])
        except IllegalValue:
            assert not math.isfinite(struct.unpack(">" + code, wanted)[0])
            continue
        for operation in write.operations:
            if isinstance(operation, Scatter):
                for place, value in zip(operation.addresses, operation.data, strict=True):
                    PLC.memory.write(place, bytes([value]))
            elif isinstance(operation, StoreCommand):
                PLC.memory.write(*operation)
        value = struct.unpack("<" + code, PLC.memory.read(address(tag), size))[0]
        assert math.isfinite(value)


def test_bits_of_a_register_are_stored_one_by_one() -> None:
    writes = writes_of("p.flag,hr,0,0", "p.bits[5],hr,0,15")
    write = writes.registers(0, b"\x80\x00")
    assert write.operations == (Scatter((address("p.flag"), address("p.bits[5]")), b"\0\1"),)
    assert [point.tag for point in write.points] == ["p.flag", "p.bits[5]"]


def test_coils_refuse_holes_and_what_is_read_only() -> None:
    writes = writes_of("p.flag,co,0", "p.other,co,1,,,,,ro", "p.bits[0],di,4")
    assert writes.coils(0, [False]).operations == (StoreCommand(address("p.flag"), b"\0"),)
    for first, bits in ((0, [True, True]), (2, [True]), (4, [True])):
        with pytest.raises(IllegalAddress):
            writes.coils(first, bits)


@given(st.integers(0, 0xFFFF), st.integers(0, 0xFFFF), st.integers(0, 0xFFFF))
def test_a_mask_follows_the_specification(word: int, and_mask: int, or_mask: int) -> None:
    expected = (word & and_mask) | (or_mask & ~and_mask & 0xFFFF)
    for order, swap in (("ABCD", False), ("BADC", True)):
        (mask,) = writes_of("p.word,hr,0", order=order).mask(0, and_mask, or_mask).operations
        assert isinstance(mask, Mask)
        stored = int.from_bytes(word.to_bytes(2, "big"), "little" if swap else "big")
        result = mask.applied_to(stored)
        assert int.from_bytes(result.to_bytes(2, "big"), "little" if swap else "big") == expected


def test_a_mask_on_bits_touches_only_the_bits_it_names() -> None:
    writes = writes_of("p.flag,hr,0,0", "p.other,hr,0,1")
    assert writes.mask(0, 0xFFFE, 0x0001).operations == (StoreCommand(address("p.flag"), b"\1"),)
    assert writes.mask(0, 0xFFFD, 0x0000).operations == (StoreCommand(address("p.other"), b"\0"),)
    assert writes.mask(0, 0xFFFF, 0xFFFF).operations == ()


@pytest.mark.parametrize(
    "row",
    ["p.long,hr,0", "p.byte,hr,0", "p.percent,hr,0", "p.count,hr,0,,,,,ro", "p.flag,hr,0",
     "p.real,hr,0,,int16,,,,0.1", "p.text,hr,0,,,1"],
)  # fmt: skip
def test_a_mask_needs_a_plain_word(row: str) -> None:
    with pytest.raises(IllegalAddress):
        writes_of(row).mask(0, 0, 0)


def test_two_tags_at_one_address_are_both_written() -> None:
    writes = writes_of("p.number,hr,0", "p.count,hr,0,,,,,,,,,,1")
    write = writes.registers(0, b"\0\1")
    assert [point.tag for point in write.points] == ["p.number", "p.count"]
    assert address("p.count") == address("p.number") + 2  # so both are one store
    assert write.operations == (StoreCommand(address("p.number"), b"\1\0\1\0"),)


def test_an_enumeration_in_one_register_is_written_whole() -> None:
    writes = writes_of("p.mode,hr,0,,uint16")
    assert writes.registers(0, b"\0\5").operations == (
        StoreCommand(address("p.mode"), struct.pack("<i", 5)),
    )
    with pytest.raises(IllegalAddress):
        writes.mask(0, 0, 1)


@pytest.mark.parametrize("columns", ["uint16", "", "int32", "float32"])
def test_a_value_that_is_none_of_an_enumerations_is_refused(columns: str) -> None:
    writes = writes_of(f"p.mode,hr,0,,{columns}")
    code = {"uint16": ">H", "": ">i", "int32": ">i", "float32": ">f"}[columns]
    (store,) = writes.registers(0, struct.pack(code, 5)).operations
    assert store == StoreCommand(address("p.mode"), struct.pack("<i", 5))
    for value in (9, 1, 2):
        with pytest.raises(IllegalValue, match=r"p\.mode: .* is none of its values"):
            writes.registers(0, struct.pack(code, value))
