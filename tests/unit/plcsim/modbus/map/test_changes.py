"""What a write changed: each tag with its value and the one before."""

import struct

import pytest

from plcsim.modbus.map.changes import TagChange, changes
from plcsim.modbus.map.writing import MapWrite, Writes
from plcsim.shared_image.command import Mask, Operation, Scatter, StoreCommand

from ..plants import controller, points

PLC = controller()
PLC.boot()


def writes_of(*lines: str) -> Writes:
    return Writes(points(PLC, *lines))


def before_of(write: MapWrite, memory: dict[str, bytes]) -> list[Operation]:
    """Return the operations with what was there before, as the scan leaves them."""
    found = bytearray(1 << 20)
    base = PLC.areas[0].address
    for path, data in memory.items():
        at = PLC.tags.find(path).address - base
        found[at : at + len(data)] = data
    result: list[Operation] = []
    for operation in write.operations:
        if isinstance(operation, StoreCommand):
            at = operation.address - base
            result.append(operation._replace(data=bytes(found[at : at + len(operation.data)])))
        elif isinstance(operation, Scatter):
            old = bytes(found[a - base] for a in operation.addresses)
            result.append(operation._replace(data=old))
        else:
            at = operation.address - base
            word = int.from_bytes(found[at : at + 2], "little")
            result.append(Mask(operation.address, word, operation.or_mask))
    return result


def told(write: MapWrite, memory: dict[str, bytes]) -> list[TagChange]:
    return changes(write.points, write.operations, before_of(write, memory))


def test_registers_of_several_tags() -> None:
    writes = writes_of("p.number,hr,0", "p.real,hr,1", "p.text,hr,3,,,2")
    write = writes.registers(0, bytes.fromhex("fffe 3fc00000 68690000"))
    memory = {
        "p.number": struct.pack("<h", 7),
        "p.real": struct.pack("<f", -2.0),
        "p.text": b"hello\0\0\0\0\0",
    }
    assert told(write, memory) == [
        TagChange("p.number", -2, 7),
        TagChange("p.real", 1.5, -2.0),
        TagChange("p.text", "hi", "hello"),
    ]


def test_coils_scattered_and_side_by_side() -> None:
    writes = writes_of("p.flag,co,0", "p.bits[3],co,1", "p.bits[4],co,2")
    write = writes.coils(0, [True, False, True])
    assert told(write, {"p.bits[4]": b"\1"}) == [
        TagChange("p.flag", True, False),
        TagChange("p.bits[3]", False, False),
        TagChange("p.bits[4]", True, True),
    ]


def test_a_mask_shows_the_word_before_and_after() -> None:
    write = writes_of("p.word,hr,0").mask(0, 0x00F2, 0x0025)
    assert told(write, {"p.word": b"\x12\0"}) == [TagChange("p.word", 0x17, 0x12)]


def test_bits_of_a_register() -> None:
    write = writes_of("p.flag,hr,0,15", "p.other,hr,0,0").registers(0, b"\x80\x00")
    assert told(write, {"p.other": b"\1"}) == [
        TagChange("p.flag", True, False),
        TagChange("p.other", False, True),
    ]


def test_a_scaled_tag_shows_the_value_of_the_variable() -> None:
    from plcsim.modbus.map.csv_file import read_rows
    from plcsim.modbus.map.resolve import resolve

    from ..plants import FILE

    text = "tag,area,offset,type,scale\np.real,hr,0,int16,0.1\n"
    scaled = resolve(read_rows(text, FILE), PLC.tags.find, FILE, "ABCD")
    (change,) = told(Writes(scaled).registers(0, b"\0\x0f"), {})
    assert change == TagChange("p.real", pytest.approx(1.5), 0.0)


def test_a_tag_at_two_addresses_is_told_once() -> None:
    writes = writes_of("p.number,hr,0", "p.number,hr,1,,,,,,1")
    write = writes.registers(0, bytes.fromhex("0005 0006"))
    assert told(write, {"p.number": b"\1\0"}) == [TagChange("p.number", 6, 1)]


def test_of_a_tag_that_was_written_in_part_the_bytes_are_told() -> None:
    from plcsim.modbus.map.csv_file import read_rows
    from plcsim.modbus.map.resolve import resolve

    from ..plants import FILE

    text = "tag,area,offset,partial\np.long,hr,0,1\n"
    partial = resolve(read_rows(text, FILE), PLC.tags.find, FILE, "ABCD")
    write = Writes(partial).registers(1, b"\x12\x34")
    memory = {"p.long": struct.pack("<i", 0x0A0B0C0D)}
    assert told(write, memory) == [TagChange("p.long", "16#3412", "16#0D0C")]
