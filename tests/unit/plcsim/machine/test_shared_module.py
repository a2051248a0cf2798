import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.machine.api import FUNCTION
from plcsim.machine.engine import Type
from plcsim.machine.errors import MachineError
from plcsim.machine.reader import CODE, sections
from plcsim.machine.shared_module import read_shared

from .shared import linked
from .units import assemble


def test_a_module_tells_what_it_holds_and_what_it_needs():
    module = read_shared(linked())
    assert (module.memory_size, module.memory_alignment, module.table_size) == (24, 8, 2)
    assert module.addresses == ["outside", "own"]
    assert module.pointers == ["seven"]
    assert module.called == {"host": Type(FUNCTION, "i")}
    assert module.variables == {"own": 8}
    assert module.functions[:3] == ["seven", "addresses", "indirect"]


def test_debug_information_counts_from_the_code():
    wasm = linked() + b"\0\x0e\x0b.debug_line\1\2"
    module = read_shared(wasm)
    assert module.section(".debug_line") == b"\1\2"
    assert module.section(".debug_info") == b""
    (code,) = (s for s in sections(wasm) if s.number == CODE)
    assert module.code_start == code.start


def test_a_module_of_another_kind_is_refused():
    with pytest.raises(MachineError, match="not position-independent"):
        read_shared(assemble(""))


@given(st.data())
def test_a_damaged_module_is_refused_or_read(data):
    wasm = bytearray(linked())
    for _ in range(data.draw(st.integers(1, 3))):
        wasm[data.draw(st.integers(8, len(wasm) - 1))] = data.draw(st.integers(0, 255))
    with contextlib.suppress(MachineError):
        read_shared(bytes(wasm[: data.draw(st.integers(8, len(wasm)))]))
