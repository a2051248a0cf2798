"""Random programs through our compiler and, translated, through gcc: all memory is equal.

As Automation Studio's C they are compiled for 32 bits and SSE. ``ST_SOAK=10000`` runs as many
programs, ``ST_FIRST=5000`` begins at another one.
"""

import mmap
import os
import random
import struct
import subprocess
from contextlib import contextmanager

import pytest

from plcsim.program.structured_text.lower.semantics import IEC
from st_types.resolve import dialect as dialects

from .random_program import BASE, Program, c_file
from .random_st import REALS, TYPES
from .running import Running

BATCH = 25
FIRST = int(os.environ.get("ST_FIRST", "0"))
PROGRAMS = int(os.environ.get("ST_SOAK", "50"))
SCANS = 6
SIZE = 1 << 16
FLAGS = ["-m32", "-msse2", "-mfpmath=sse", "-O0", "-w", "-fwrapv", "-fno-strict-aliasing"]
FLAGS += ["-funsigned-char", "-no-pie", "-fno-pic"]
VALUES = [0, 1, -1, 2, 3, 7, 100, 127, -128, 255, 256, -32768, 32767, 65535, 70000]
VALUES += [-(2**31), 2**31 - 1]
NUMBERS = [0.0, 1.0, -1.0, 0.5, -2.5, 3.25, 1e6, -1e6, 0.1, 1e-3]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder for C, where gcc makes programs of 32 bits."""
    folder = tmp_path_factory.mktemp("c")
    (folder / "try.c").write_text("#include <stdlib.h>\nint main(void) { return 0; }")
    command = ["gcc", *FLAGS, folder / "try.c", "-o", folder / "try"]
    try:
        subprocess.run(command, check=True, capture_output=True)
        subprocess.run([folder / "try"], check=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("gcc makes no programs of 32 bits here (Debian: gcc-multilib)")
    return folder


class InC:
    """Translated programs, with a memory of their own."""

    def __init__(self, process, memory):
        self._process = process
        self.memory = memory

    def run(self, number, unit):
        """Run the unit of a program (0 INIT, 1 CYCLIC)."""
        self._process.stdin.write(struct.pack("<I", 2 * number + unit))
        assert self._process.stdout.read(1), f"C ended with {self._process.wait()}"


@contextmanager
def in_c(folder, programs):
    """Compile the translations and run them in a process."""
    (folder / "programs.c").write_text(c_file(programs))
    subprocess.run(
        ["gcc", *FLAGS, folder / "programs.c", "-o", folder / "programs", "-lm"], check=True
    )
    file = folder / "memory"
    file.write_bytes(bytes(SIZE))
    command = [folder / "programs", file, str(SIZE)]
    with (
        file.open("r+b") as opened,
        mmap.mmap(opened.fileno(), SIZE) as memory,
        subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0
        ) as process,
    ):
        yield InC(process, memory)
        process.stdin.close()


def bytes_of(chance, type_name):
    """A random value of a type."""
    _, size, _sign = TYPES[type_name]
    if type_name == "BOOL":
        return bytes([chance.randrange(2)])
    if type_name == "Colour":
        return struct.pack("<i", chance.choice([0, 5, 6, 3]))
    if type_name in REALS:
        return struct.pack("<f" if size == 4 else "<d", chance.choice(NUMBERS))
    return (chance.choice(VALUES) & (1 << 8 * size) - 1).to_bytes(size, "little")


def difference(number, program, beside):
    """Run a program on both sides; return what differs, None if nothing does."""
    chance = random.Random(program.name)
    options = {"semantics": IEC, "dialect": dialects.IEC} if program.is_standard else {}
    running = Running(program.st, **options)
    try:
        assert running.address(program.variables[0][0]) == BASE
        size = program.end - BASE
        beside.memory[:size] = running.memory.read(BASE, size)
        running.run(1, "init")
        beside.run(number, 0)
        for scan in range(SCANS):
            for _name, address, _size, type_name in program.variables:
                if type_name in TYPES and chance.random() < 0.5:
                    data = bytes_of(chance, type_name)
                    running.memory.write(address, data)
                    beside.memory[address - BASE : address - BASE + len(data)] = data
            running.run()
            beside.run(number, 1)
            if running.memory.read(BASE, size) != beside.memory[:size]:
                return f"scan {scan}: {_unlike(program, running, beside)}"
    finally:
        running.close()
    return None


def _unlike(program, running, beside):
    found = []
    for name, address, size, _ in program.variables:
        here = running.memory.read(address, size)
        there = beside.memory[address - BASE : address - BASE + size]
        if here != there:
            found.append(f"{name}: {here.hex()} here, {there.hex()} in C")
    return "\n".join(found)


@pytest.mark.parametrize("is_standard", [False, True], ids=["vendor", "standard"])
@pytest.mark.parametrize("first", range(FIRST, FIRST + PROGRAMS, BATCH))
def test_memory_is_equal_after_every_scan(folder, first, is_standard):
    seeds = range(first, min(first + BATCH, FIRST + PROGRAMS))
    programs = [Program(seed, is_standard=is_standard) for seed in seeds]
    with in_c(folder, programs) as beside:
        for number, program in enumerate(programs):
            found = difference(number, program, beside)
            assert found is None, f"{found}\n{program.st}\n{program.c}"
