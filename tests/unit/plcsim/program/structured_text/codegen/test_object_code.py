from array import array

import pytest

from plcsim.machine.encoder import sleb, uleb
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.body import HOLE
from plcsim.program.structured_text.codegen.lines import ModuleLines
from plcsim.program.structured_text.codegen.object_code import HOLES, ObjectCode


def filled(address, offset=0):
    """What is put into a hole."""
    holes = array(HOLES, [1, 0, offset])
    code = ObjectCode(
        "test", b"\x41" + HOLE + b"\x0b", [ir.Segment("program")], holes, ModuleLines([], {})
    )
    placed = code.place({"program": address})
    assert placed[0] == 0x41
    assert placed[6] == 0x0B
    return placed[1:6]


def value_of(data, *, signed):
    number = sum((byte & 0x7F) << 7 * n for n, byte in enumerate(data))
    assert all(byte & 0x80 for byte in data[:-1])
    assert not data[-1] & 0x80
    return number - (1 << 35) if signed and data[-1] & 0x40 else number


@pytest.mark.parametrize("address", [0, 1, 0x7F, 0x80, 0x11_0000, 0x4000_0000, 0x7FFF_FFFF])
def test_an_address_is_the_same_signed_and_unsigned(address):
    for signed in (True, False):
        assert value_of(filled(address), signed=signed) == address


def test_offsets_may_lie_before_the_segment():
    assert value_of(filled(0x11_0000, -8), signed=False) == 0x11_0000 - 8
    assert value_of(filled(0x11_0000, 3), signed=False) == 0x11_0003


def test_what_is_filled_in_is_what_the_encoder_writes_but_longer():
    address = 0x1234_5678
    assert len(uleb(address)) == len(sleb(address)) == 5
    assert filled(address) == uleb(address) == sleb(address)


def test_every_hole_takes_the_address_of_its_segment():
    holes = array(HOLES, [0, 1, 4, 5, 0, 0, 10, 1, 0])
    code = ObjectCode(
        "test", HOLE * 3, [ir.Segment("program"), ir.Segment("global")], holes, ModuleLines([], {})
    )
    placed = code.place({"global": 0x20_0000, "program": 0x30_0000, "more": 1})
    parts = [value_of(placed[n : n + 5], signed=False) for n in (0, 5, 10)]
    assert parts == [0x20_0004, 0x30_0000, 0x20_0000]
    assert code.wasm == HOLE * 3
    with pytest.raises(KeyError):
        code.place({"program": 1})


def test_code_without_addresses():
    code = ObjectCode("test", b"abc", [], array(HOLES), ModuleLines([], {}))
    assert code.place({}) == b"abc"
