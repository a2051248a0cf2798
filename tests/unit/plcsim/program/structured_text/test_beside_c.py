"""Random programs through our compiler and, translated, through gcc: all memory is equal.

``ST_SOAK=10000`` runs as many programs.
"""

import ctypes
import os
import random
import shutil
import struct
import subprocess

import pytest

from .random_st import BASE, REALS, TYPES, Program, c_file
from .running import Running

BATCH = 25
PROGRAMS = int(os.environ.get("ST_SOAK", "100"))
SCANS = 5
SIZE = 1 << 16
VALUES = [
    0,
    1,
    -1,
    2,
    3,
    7,
    100,
    127,
    -128,
    255,
    256,
    -32768,
    32767,
    65535,
    70000,
    -(2**31),
    2**31 - 1,
]
NUMBERS = [0.0, 1.0, -1.0, 0.5, -2.5, 3.25, 1e6, -1e6, 0.1, 1e-3]

pytestmark = pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    """``compiled(programs)``: their C, as a library whose memory begins at ``M``."""

    def compiled(programs):
        folder = tmp_path_factory.mktemp("c")
        source, library = folder / "programs.c", folder / "programs.so"
        source.write_text(c_file(programs) + f"static uint8_t memory[{SIZE}];uint8_t *M=memory;\n")
        flags = ["-O0", "-w", "-fwrapv", "-fno-strict-aliasing", "-shared", "-fPIC"]
        subprocess.run(["gcc", *flags, source, "-o", library], check=True)
        return ctypes.CDLL(str(library))

    return compiled


def bytes_of(chance, type_name):
    """A random value of a type."""
    _, size, _sign = TYPES[type_name]
    if type_name == "BOOL":
        return bytes([chance.randrange(2)])
    if type_name in REALS:
        return struct.pack("<f" if size == 4 else "<d", chance.choice(NUMBERS))
    return (chance.choice(VALUES) & (1 << 8 * size) - 1).to_bytes(size, "little")


def both(program, library, chance):
    """Run a program on both sides; return what differs."""
    memory = (ctypes.c_uint8 * SIZE).from_address(ctypes.c_void_p.in_dll(library, "M").value)
    ctypes.memset(memory, 0, SIZE)
    running = Running(program.st)
    try:
        ours = running.address(program.variables[0][0])
        size = program.size

        def write(offset, data):
            running.memory.write(ours + offset, data)
            memory[offset : offset + len(data)] = data

        running.run(1, "init")
        for _name, type_name, address in program.references:
            _st, c = program.places[type_name][0]
            target = int(c.split(", ")[1].rstrip(")"))
            memory[address - BASE : address - BASE + 4] = struct.pack("<I", target)
        for _ in range(SCANS):
            for _name, st_type, _c, offset, _size in program.variables:
                if st_type in TYPES and chance.random() < 0.5:
                    write(offset, bytes_of(chance, st_type))
            running.run()
            getattr(library, f"cyclic_{program.name}")()
            for name, st_type, _c, offset, length in program.variables:
                here = running.memory.read(ours + offset, length)
                there = bytes(memory[offset : offset + length])
                if st_type.startswith("REFERENCE"):
                    here = struct.pack("<I", struct.unpack("<I", here)[0] - ours + BASE)
                if here != there:
                    return f"{name}: {here.hex()} here, {there.hex()} in C"
        assert size
    finally:
        running.close()
    return None


@pytest.mark.parametrize("first", range(0, PROGRAMS, BATCH))
def test_memory_is_equal_after_every_scan(compiled, first):
    programs = [Program(seed) for seed in range(first, min(first + BATCH, PROGRAMS))]
    library = compiled(programs)
    for program in programs:
        difference = both(program, library, random.Random(program.name))
        assert difference is None, f"{difference}\n{program.st}\n{program.c}"
