"""Random modules: what the compiled code leaves in memory, against the interpreter."""

import math
import random
import struct

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from plcsim.core.memory import FIRST
from plcsim.machine import FaultKind, MachineFault
from plcsim.program.structured_text.codegen.options import CodegenOptions

from .compiled import Compiled
from .interpreter import Interpreter, TrapError
from .random_ir import REALS, STRING_LENGTH, STRINGS, Maker
from .random_ir import SIZE as USED

SCANS = 3
REAL_PLACES = [
    (start + offset, width)
    for start in (0, *(instance - 64 for instance in (144, 208)))
    for width, offset in REALS.items()
]


def foreign_block(side, address):
    """Changes its data block and bytes of root 0, as a block in Python may."""
    side.write(address, bytes([side.read(address, 1)[0] + 3 & 0xFF]))
    side.write(address + 8, side.read(FIRST + 4, 1))
    side.write(FIRST + 5, bytes([side.read(FIRST + 5, 1)[0] + 1 & 0xFF]))


def foreign_function(side, number, real):
    side.write(FIRST + 9, bytes([side.read(FIRST + 9, 1)[0] ^ 0x55]))
    return (number & 0xFFFF) + (0 if math.isnan(real) else 7)


IMPORTS = {"b.FOREIGN": foreign_block, "f.foreign": foreign_function}


def initial(choose):
    memory = bytearray(choose.randbytes(USED))
    for place, width in REAL_PLACES:
        value = choose.choice((0.0, 1.5, -2e9, 3.7e18, math.inf, math.nan, -0.0))
        struct.pack_into("<f" if width == "f32" else "<d", memory, place, value)
    for start in STRINGS:
        text = choose.randbytes(choose.randrange(STRING_LENGTH)).replace(b"\0", b"x")
        memory[start : start + STRING_LENGTH] = text.ljust(STRING_LENGTH, b"\0")
    return bytes(memory)


def without_nans(data):
    """All NaNs are one: their bits are not defined."""
    data = bytearray(data)
    for place, width in REAL_PLACES:
        form = "<f" if width == "f32" else "<d"
        if math.isnan(struct.unpack_from(form, data, place)[0]):
            struct.pack_into(form, data, place, math.nan)
    return bytes(data)


def outcome(run):
    """How a scan ends."""
    try:
        run("CYCLIC")
    except TrapError as trap:
        return str(trap)
    except MachineFault as fault:
        return "index" if fault.kind is FaultKind.UNREACHABLE else fault.kind.value
    return "end"


def check(seed, options):
    choose = random.Random(seed)
    module = Maker(choose).module()
    start = initial(choose)
    reference = Interpreter(module, {"program": FIRST}, bytearray(USED), IMPORTS)
    compiled = Compiled(module, IMPORTS, options)
    for side in (reference, compiled):
        side.write(FIRST, start)
    for _ in range(SCANS):
        assert outcome(compiled.run) == outcome(reference.run)
        after = [without_nans(side.read(FIRST, USED)) for side in (compiled, reference)]
        assert after[0] == after[1]
    compiled.close()


@pytest.mark.parametrize("copies", [True, False])
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(seed=st.integers(0, 2**32))
def test_memory_is_as_interpreted_after_every_scan_and_at_every_trap(copies, seed):
    check(seed, CodegenOptions(copies=copies))
