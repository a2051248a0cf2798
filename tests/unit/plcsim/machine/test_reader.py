import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.machine.encoder import ModuleWriter, name, sleb, uleb
from plcsim.machine.errors import MachineError
from plcsim.machine.reader import CUSTOM, HEADER, Reader, sections


@given(st.integers(0, 2**64 - 1), st.integers(-(2**63), 2**63 - 1), st.text())
def test_what_was_written_is_read(unsigned, signed, text):
    reader = Reader(b"x" + uleb(unsigned) + sleb(signed) + name(text) + b"end", 1)
    assert (reader.uleb(), reader.sleb(), reader.name()) == (unsigned, signed, text)
    assert reader.more
    assert reader.bytes(2) == b"en"
    assert reader.byte() == ord("d")
    assert not reader.more


@pytest.mark.parametrize(
    ("data", "read"),
    [
        (b"", Reader.byte),
        (b"\x80", Reader.uleb),
        (b"\xff" * 11, Reader.uleb),
        (b"\x05abc", Reader.name),
        (b"\xff\xff\xff\xff\x0f", Reader.name),
    ],
)
def test_what_ends_too_early_is_told(data, read):
    with pytest.raises(MachineError, match=r"in the middle of|too long"):
        read(Reader(data))


def test_an_end_before_the_end_of_the_bytes_is_kept():
    with pytest.raises(MachineError):
        Reader(b"abcd", 1, 3).bytes(3)


def test_sections_are_found():
    writer = ModuleWriter("unit")
    writer.table(1)
    writer.export_table("t")
    writer.custom("extra", b"\1\2")
    wasm = writer.encode().wasm
    found = list(sections(wasm))
    assert [(s.number, s.name) for s in found] == [
        (4, ""),
        (7, ""),
        (CUSTOM, "name"),
        (CUSTOM, "extra"),
    ]
    assert wasm[found[-1].start : found[-1].end] == b"\1\2"


@pytest.mark.parametrize("wasm", [b"", b"ELF", HEADER[:7], HEADER + b"\1", HEADER + b"\1\5abc"])
def test_what_is_no_module_is_told(wasm):
    with pytest.raises(MachineError):
        list(sections(wasm))


@given(st.binary())
def test_any_bytes_are_read_or_refused(data):
    try:
        found = list(sections(HEADER + data))
    except MachineError:
        return
    assert all(s.end <= len(HEADER + data) for s in found)
