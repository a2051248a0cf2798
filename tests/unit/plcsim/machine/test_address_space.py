import ctypes
import resource
import subprocess
import sys
from pathlib import Path

import pytest

from plcsim.core.memory import FIRST, LIBRARY_AREA, PAGE, SYSTEM_AREA, Memory
from plcsim.machine.address_space import GUARD, RESERVATION, AddressSpace, must_compare
from plcsim.machine.errors import MachineError

MAPS = Path("/proc/self/maps")
ALWAYS = [SYSTEM_AREA, LIBRARY_AREA]


def rights(space):
    """Return the rights of each page of the mapping that are not none, as (PLC address, rights)."""
    found = {}
    with MAPS.open(encoding="ascii") as lines:
        for line in lines:
            span, mode, *_ = line.split()
            low, high = (int(text, 16) - space.base for text in span.split("-"))
            for address in range(max(low, 0), min(high, RESERVATION), PAGE):
                if mode[:3] != "---" and 0 <= address < space.size:
                    found[address] = mode
    return found


@pytest.fixture
def memory():
    return Memory(4 * PAGE)


@pytest.fixture(params=[False, True], ids=["guarded", "compared"])
def space(request, memory):
    space = AddressSpace(memory, compare=request.param)
    yield space
    space.close()


def test_only_what_is_valid_has_rights(space, memory):
    assert rights(space) == dict.fromkeys(ALWAYS, "rw-s")
    memory.allocate(PAGE + 1)
    memory.open_stack(1)
    valid = [SYSTEM_AREA - PAGE, *ALWAYS, FIRST, FIRST + PAGE]
    assert rights(space) == dict.fromkeys(valid, "rw-s")
    memory.allocate(3 * PAGE - 4)
    assert max(rights(space)) == FIRST + 3 * PAGE


def test_what_was_allocated_before_is_valid_too():
    memory = Memory(4 * PAGE)
    memory.allocate(1)
    memory.open_stack(1)
    space = AddressSpace(memory)
    assert rights(space) == dict.fromkeys([SYSTEM_AREA - PAGE, *ALWAYS, FIRST], "rw-s")
    space.close()


def test_both_mappings_are_the_same_bytes(space, memory):
    address = memory.allocate(8)
    memory.write(address, b"to there")
    assert ctypes.string_at(space.base + address, 8) == b"to there"
    ctypes.memmove(space.base + address, b"and back", 8)
    assert memory.read(address, 8) == b"and back"
    memory.system.cells[3] = 99
    cell = ctypes.c_int64.from_address(space.base + SYSTEM_AREA + 24)
    assert cell.value == 99
    cell.value = -1
    assert memory.system.cells[3] == -1


def test_every_address_of_32_bits_is_reserved():
    space = AddressSpace(Memory(PAGE))
    with MAPS.open(encoding="ascii") as lines:
        spans = [line.split()[0].split("-") for line in lines]
    inside = [(int(a, 16), int(b, 16)) for a, b in spans if space.base <= int(a, 16)]
    covered = space.base
    for low, high in sorted(inside):
        if low != covered or covered >= space.base + RESERVATION + GUARD:
            break
        covered = high
    assert covered >= space.base + RESERVATION + GUARD
    space.close()


def test_after_closing_the_memory_goes_on_alone(space, memory):
    space.close()
    space.close()
    memory.allocate(PAGE)
    assert space.base == 0


def test_the_limit_of_the_process_decides(monkeypatch):
    assert not must_compare()
    monkeypatch.setattr(resource, "getrlimit", lambda _which: (2 << 30, 2 << 30))
    assert must_compare()


UNDER_A_LIMIT = """
import resource
resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
from plcsim.core.memory import Memory
from plcsim.machine import CodeCache, Machine, MachineError, MachineFault
from plcsim.machine.encoder import ModuleWriter, Signature, memarg, uleb
from plcsim.machine.opcodes import I32, I32_LOAD, LOCAL_GET
machines = [Machine(Memory(), cache=CodeCache(None)) for _ in range(10)]
writer = ModuleWriter("unit")
writer.import_memory("env", "memory")
load = writer.function(Signature(bytes([I32]), bytes([I32])), "load")
writer.body(load, LOCAL_GET + uleb(0) + I32_LOAD + memarg())
writer.export_function("load", load)
code = machines[0].compile(writer.encode().wasm)
for address in 0, 0x130000, 0x7fffffff, 0xffffffff:
    try:
        machines[0].instantiate(code, {}).function("load")(address)
    except MachineFault as fault:
        print(fault.kind.name)
try:
    Machine(Memory(1 << 30), cache=CodeCache(None))
except (MachineError, OSError) as error:
    print(error)
"""


def test_under_a_limit_of_addresses_machines_run_all_the_same():
    done = subprocess.run(
        [sys.executable, "-c", UNDER_A_LIMIT], capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    *faults, full = done.stdout.splitlines()
    assert faults == ["PAGE_FAULT"] * 4
    assert "Cannot allocate memory" in full


def test_without_room_the_host_is_named(monkeypatch):
    memory = Memory(PAGE)
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (RESERVATION // 2, hard))
    try:
        with pytest.raises(MachineError, match=r"4160 MiB of addresses .*: Cannot allocate memory"):
            AddressSpace(memory)
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
