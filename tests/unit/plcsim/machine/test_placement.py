import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.core.errors import CycleTimeViolation
from plcsim.core.memory import SYSTEM_AREA
from plcsim.core.system_area import STALLED
from plcsim.machine import MachineError, MachineFault, frames_of
from plcsim.machine.placement import Placement, initial_values, place
from plcsim.machine.shared_module import read_shared

from .shared import linked
from .units import Rig


class Placed:
    """The module at an address of a machine, its data written."""

    def __init__(self, gap=0):
        rig = self.rig = Rig()
        self.module = read_shared(linked())
        rig.memory.allocate(gap)
        rig.machine.reserve_functions(gap % 7)
        self.address = rig.memory.allocate(24, 8)
        self.table = rig.machine.reserve_functions(2)
        self.pointer = rig.machine.reserve_functions(1)
        self.placement = Placement(
            self.address,
            self.table,
            {"outside": 0x8000_1234, "own": self.address + 8},
            {"seven": self.pointer},
        )
        self.placed = place(self.module, self.placement, "unit of C")
        self.heard = []
        host = rig.machine.host_function(self.heard.append, "I")
        code = rig.machine.compile(self.placed.wasm)
        self.instance = rig.machine.instantiate(code, {("env", "host"): host})
        rig.machine.set_function(self.pointer, self.instance.extern("seven"))
        for address, content in initial_values(self.module, self.placement):
            rig.memory.write(address, content)

    def call(self, name, *values, **codes):
        return self.instance.function(name, **codes)(*values)


@pytest.fixture
def placed():
    return Placed()


@pytest.mark.parametrize("gap", [0, 1, 1000, 70_000])
def test_addresses_become_constants_of_their_place(gap):
    placed = Placed(gap)
    found = [placed.call("addresses", n, results="I") for n in range(4)]
    assert found == [0x8000_1234, placed.address + 8, placed.address, placed.pointer]
    assert [placed.call("indirect", n) for n in range(2)] == [6, 9]
    assert placed.rig.memory.read(placed.address, 12) == b"\1\2\3\4\0\0\0\0own!"


def test_variables_of_its_own_and_the_stack_stay_variables(placed):
    assert placed.call("count", 3) == 8
    assert placed.call("count", 1) == 9
    assert placed.call("push") == SYSTEM_AREA - 16


def test_other_instructions_are_copied(placed):
    assert placed.call("floats") == 0.75
    assert placed.call("saturates", 1e300) == 2**31 - 1
    placed.call("calls_host")
    assert placed.heard == [3]


@pytest.mark.parametrize("name", ["endless", "recurse", "calls_host"])
def test_loops_and_functions_that_call_end_when_they_shall(placed, name):
    placed.rig.memory.system.end_program(STALLED)
    with pytest.raises(CycleTimeViolation) as caught:
        placed.call(name)
    assert len(frames_of(caught.value)) == 1
    assert placed.heard == []


def test_functions_that_neither_loop_nor_call_run_to_their_end(placed):
    placed.rig.memory.system.end_program(STALLED)
    assert placed.call("seven") == 7


@pytest.mark.parametrize("passes", [0, 1, 5])
def test_a_fault_leads_back_to_the_module_as_it_was_linked(placed, passes):
    with pytest.raises(MachineFault) as caught:
        placed.call("fails", passes)
    (frame,) = caught.value.frames
    assert frame.module == "unit of C"
    offset = placed.placed.linked_offset(frame.offset)
    assert placed.module.wasm[offset - 1 : offset + 3] == b"\x45\x04\x40\x00"  # eqz if unreachable


def test_every_byte_of_code_has_its_counterpart(placed):
    """Between two anchors both modules run alike."""
    anchors = placed.placed.anchors
    ends = [new for new, _ in anchors[1:]]
    for (new, old), end in zip(anchors, ends, strict=False):
        length = min(end - new, 3)
        if length > 0 and placed.placed.linked_offset(new) == old:
            assert placed.placed.wasm[new] in (placed.module.wasm[old], 0x41)


def test_what_is_not_placed_is_named(placed):
    with pytest.raises(KeyError, match="outside"):
        place(placed.module, Placement(0, 0, {"own": 0}, {"seven": 0}), "x")


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        (
            b"\x41\x03\x10\x00",
            b"\x41\x03\xfd\x00",
            "instruction 0xfd is none that PLC programs may use",
        ),
        (b"\xfc\x02", b"\xfc\x0b", "instruction 0xfc is none that PLC programs may use"),
    ],
)
def test_instructions_that_the_machine_does_not_run_are_refused(placed, before, after, message):
    wasm = placed.module.wasm
    assert before in wasm
    with pytest.raises(MachineError, match=message):
        place(read_shared(wasm.replace(before, after)), placed.placement, "x")


@settings(max_examples=300)
@given(st.data())
def test_a_damaged_module_is_refused_or_becomes_one_that_wasmtime_judges(data):
    wasm = bytearray(linked())
    for _ in range(data.draw(st.integers(1, 3))):
        wasm[data.draw(st.integers(40, len(wasm) - 1))] = data.draw(st.integers(0, 255))
    placement = Placement(0x12_0000, 1, {"outside": 0, "own": 8}, {"seven": 3})
    try:
        module = read_shared(bytes(wasm))
        placed = place(module, placement, "unit")
        initial_values(module, placement)
        RIG.machine.compile(placed.wasm)
    except (MachineError, KeyError):
        pass


RIG = Rig()
