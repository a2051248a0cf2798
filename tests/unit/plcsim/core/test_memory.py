import mmap
import subprocess
import sys
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.errors import ConfigurationError, PageFault
from plcsim.core.memory import (
    DEFAULT_SIZE,
    FIRST,
    LIBRARY_AREA,
    MAX_SIZE,
    MAX_STACK,
    PAGE,
    SYSTEM_AREA,
    Memory,
    adr,
    sizeof,
)
from st_types import (
    ARRAY,
    BOOL,
    INT,
    LREAL,
    REAL,
    STRING,
    UDINT,
    Struct,
    ValueRangeError,
    var,
)
from st_types.types.derived import AliasType, Member, StructType
from st_types.types.views import context_of, type_of, view_class


class Axis(Struct):
    on = var(BOOL)
    speed = var(REAL, 1.5)


class Cell(Struct):
    number = var(INT, -3)
    main = var(Axis)
    axes = var(ARRAY(Axis, (1, 3)))
    grid = var(ARRAY(INT, (0, 1), (-1, 1)))
    name = var(STRING(5), "cell")


@pytest.fixture
def memory():
    return Memory(4 * PAGE)


def test_the_first_variable_lies_at_the_first_address(memory):
    assert (memory.used, memory.allocate(1), memory.used) == (0, FIRST, 1)


@pytest.mark.parametrize(("alignment", "address"), [(1, 4), (2, 4), (4, 4), (8, 8)])
def test_allocation_keeps_the_alignment(memory, alignment, address):
    memory.allocate(1)
    assert memory.allocate(4, alignment) == FIRST + address


def test_a_full_memory_says_so_and_stays_usable(memory):
    with pytest.raises(ConfigurationError) as caught:
        memory.allocate(4 * PAGE + 1)
    assert str(caught.value) == (
        "the PLC memory of 262144 bytes is full: 262145 more bytes do not fit."
    )
    assert memory.allocate(4 * PAGE) == FIRST
    with pytest.raises(ConfigurationError):
        memory.allocate(1)


@pytest.mark.parametrize("size", [0, PAGE + 1, PAGE - 1, MAX_SIZE + PAGE, -PAGE])
def test_an_impossible_size_is_refused(size):
    with pytest.raises(ConfigurationError, match=f"memory of {size} bytes"):
        Memory(size)


def test_default_size():
    assert Memory().size == DEFAULT_SIZE == 1 << 24


# Page faults: addresses are valid from the first variable to the end of the last page allocated.


@pytest.mark.parametrize(
    ("address", "size"),
    [
        (0, 1),
        (0, 0),
        (1, 4),
        (SYSTEM_AREA - 1, 1),
        (SYSTEM_AREA, 8),
        (LIBRARY_AREA - 1, 1),
        (LIBRARY_AREA - 1, 2),
        (FIRST + PAGE, 1),
        (FIRST + PAGE - 3, 4),
        (-1, 1),
        (2**32 - 1, 1),
        (2**32 + FIRST, 1),
        (FIRST, PAGE + 1),
        (LIBRARY_AREA, 2 * PAGE + 1),
        (FIRST, -1),
    ],
)
def test_a_wild_address_is_a_page_fault(memory, address, size):
    memory.allocate(10)
    with pytest.raises(PageFault) as caught:
        memory.check(address, size)
    assert (caught.value.address, caught.value.size) == (address, size)
    with pytest.raises(PageFault):
        memory.read(address, size)


@pytest.mark.parametrize(
    "address", [0, LIBRARY_AREA - 1, FIRST + PAGE - type_of(Cell).size + 1, 2**32 - 4]
)
def test_access_to_a_wild_address_is_a_page_fault(memory, address):
    memory.allocate(10)
    with pytest.raises(PageFault):
        memory.access(Cell, address)


def test_a_page_fault_says_where():
    fault = PageFault(0x1A2B, 4)
    assert str(fault) == "page fault: 4 bytes at address 16#00001A2B"


def test_before_the_first_allocation_nothing_is_valid(memory):
    with pytest.raises(PageFault):
        memory.read(FIRST, 1)
    assert memory.read(LIBRARY_AREA, PAGE) == bytes(PAGE)


def test_addresses_are_valid_to_the_end_of_the_page(memory):
    memory.allocate(10)
    end = FIRST + PAGE
    memory.write(end - 2, b"ab")
    assert memory.read(end - 2, 2) == b"ab"
    assert memory.read(end, 0) == b""
    memory.allocate(PAGE)
    memory.write(end + PAGE - 1, b"c")


def test_a_write_that_faults_stores_nothing(memory):
    memory.allocate(10)
    with pytest.raises(PageFault):
        memory.write(FIRST + PAGE - 2, b"abc")
    assert memory.read(FIRST + PAGE - 2, 2) == b"\0\0"


EDGES = (
    0,
    SYSTEM_AREA - 2 * PAGE,
    SYSTEM_AREA,
    LIBRARY_AREA,
    FIRST,
    FIRST + PAGE,
    FIRST + 2 * PAGE,
)


@given(
    st.integers(-(2**33), 2**33)
    | st.builds(int.__add__, st.sampled_from(EDGES), st.integers(-9, 9)),
    st.integers(-5, 9) | st.integers(0, 3 * PAGE),
    st.integers(1, 3 * PAGE),
    st.integers(0, 2 * PAGE),
)
def test_an_access_is_good_or_a_page_fault(address, size, allocated, stack):
    memory = Memory(4 * PAGE)
    memory.allocate(allocated)
    memory.open_stack(stack)
    top = FIRST + -(-allocated // PAGE) * PAGE
    low = SYSTEM_AREA - -(-stack // PAGE) * PAGE
    in_variables = LIBRARY_AREA <= address <= address + size <= top
    in_stack = low <= address < SYSTEM_AREA and address + size <= SYSTEM_AREA
    if size >= 0 and (in_variables or in_stack):
        assert memory.read(address, size) == bytes(size)
        memory.write(address, b"x" * size)
        assert memory.read(address, size) == b"x" * size
    else:
        with pytest.raises(PageFault):
            memory.read(address, size)


@pytest.mark.parametrize(
    ("data", "limit", "found"),
    [(b"ab\0c", 10, b"ab"), (b"abc\0", 2, b"ab"), (b"\0", 10, b""), (b"abc\0", 3, b"abc")],
)
def test_a_string_ends_at_its_nul_or_at_the_limit(memory, data, limit, found):
    address = memory.allocate(100)
    memory.write(address, data)
    assert memory.string(address, limit) == found


@pytest.mark.parametrize("end", [FIRST + PAGE, SYSTEM_AREA])
def test_a_string_must_not_run_into_an_invalid_address(memory, end):
    memory.allocate(10)
    memory.open_stack(10)
    memory.write(end - 3, b"abc")
    assert memory.string(end - 3, 3) == b"abc"
    with pytest.raises(PageFault):
        memory.string(end - 3, 4)
    memory.write(end - 1, b"\0")
    assert memory.string(end - 3, 1000) == b"ab"
    for address in (0, SYSTEM_AREA, FIRST + PAGE):
        with pytest.raises(PageFault):
            memory.string(address, 5)


# The stack of compiled programs, and who is told.


def test_a_stack_is_opened_in_pages_and_never_shrinks(memory):
    assert memory.stack == SYSTEM_AREA
    memory.open_stack(PAGE + 1)
    assert memory.stack == SYSTEM_AREA - 2 * PAGE
    memory.open_stack(1)
    assert memory.stack == SYSTEM_AREA - 2 * PAGE
    memory.open_stack(MAX_STACK)
    assert memory.stack == PAGE


@pytest.mark.parametrize("size", [-1, MAX_STACK + 1])
def test_an_impossible_stack_is_refused(memory, size):
    with pytest.raises(ConfigurationError, match=f"stack of {size} bytes: at most 983040"):
        memory.open_stack(size)


def test_followers_hear_when_the_valid_addresses_change(memory):
    heard = []
    memory.follow(lambda told: heard.append((told.stack, told.limit)))
    memory.allocate(1)
    memory.allocate(PAGE - 1)
    memory.allocate(1)
    memory.open_stack(1)
    stack = SYSTEM_AREA - PAGE
    assert heard == [
        (SYSTEM_AREA, FIRST + PAGE),
        (SYSTEM_AREA, FIRST + 2 * PAGE),
        (stack, FIRST + 2 * PAGE),
    ]


def test_the_file_holds_the_bytes_for_a_second_mapping(memory):
    address = memory.allocate(4)
    memory.write(address, b"plc!")
    ((fd, start, size),) = memory.files
    assert (start, size) == (0, FIRST + memory.size)
    with mmap.mmap(fd, size) as second:
        assert second[address : address + 4] == b"plc!"


DESCRIPTORS = """
import resource
resource.setrlimit(resource.RLIMIT_NOFILE, (60, 60))
from plcsim.core.memory import PAGE, Memory
for _ in range(200):
    memory = Memory(PAGE)
    memory.itself = memory
"""


def test_memories_that_nobody_uses_take_no_descriptors():
    """They may lie in cycles, which Python finds only when it looks for them."""
    subprocess.run([sys.executable, "-c", DESCRIPTORS], check=True)


# Variables


def test_a_new_variable_is_aligned_and_has_its_initial_values(memory):
    memory.allocate(1)
    cell = memory.new(Cell, "context")
    assert adr(cell) == FIRST + 4
    assert (cell.number, cell.main.speed, cell.axes[3].speed, cell.name) == (-3, 1.5, 1.5, "cell")
    assert context_of(cell.axes[2]) == "context"
    assert memory.used == 4 + type_of(Cell).size


def test_view_and_memory_are_the_same_bytes(memory):
    cell = memory.new(Cell)
    cell.axes[2].speed = 2.5
    assert memory.get(REAL, adr(cell, "axes[2].speed")) == 2.5
    memory.set(INT, adr(cell, "grid[1, -1]"), 7)
    assert cell.grid[1, -1] == 7
    with pytest.raises(ValueRangeError):
        memory.set(INT, adr(cell), 40000)
    with pytest.raises(PageFault):
        memory.get(LREAL, 8)
    with pytest.raises(PageFault):
        memory.set(LREAL, 8, 1.0)


def test_access_gives_a_view_of_the_same_variable(memory):
    cell = memory.new(Cell)
    memory.access(Axis, adr(cell, "axes[3]")).on = True
    memory.access(type_of(Cell).find("grid")[0].data_type, adr(cell, "grid"))[0, 0] = 9
    memory.access(AliasType("Other", type_of(Axis)), adr(cell.main)).speed = 4.0
    assert (cell.axes[3].on, cell.grid[0, 0], cell.main.speed) == (True, 9, 4.0)
    assert adr(memory.access(Axis, adr(cell.main))) == adr(cell.main)


def test_a_declared_struct_may_have_a_member_called_bind(memory):
    view = memory.new(view_class(StructType("Odd", [Member("bind", INT, 5)])))
    assert view.bind == 5
    assert memory.access(type_of(view), adr(view)).bind == 5


# Paths: the offsets of Cell are number 0, main 4, axes 12, grid 36, name 48.


def test_adr_of_a_variable_and_its_parts(memory):
    cell = memory.new(Cell)
    base = adr(cell)
    assert adr(cell, "axes[2].speed") == base + 12 + 8 + 4
    assert adr(cell.axes) == base + 12
    assert adr(cell.axes[2]) == adr(cell, "axes[2]") == adr(cell.axes, "[2]") == base + 20
    with pytest.raises(KeyError, match="no member torque"):
        adr(cell, "torque")


def test_adr_outside_plc_memory_is_a_page_fault():
    for view in (Cell(), Cell().main, Cell().axes):
        with pytest.raises(PageFault) as caught:
            adr(view)
        assert (caught.value.address, caught.value.size) == (0, type_of(view).size)


def test_sizeof(memory):
    cell = memory.new(Cell)
    assert [sizeof(v) for v in (cell, Cell, cell.main, cell.axes, UDINT)] == [56, 56, 8, 24, 4]
    assert [sizeof(cell, p) for p in ("name", "axes[1]", "grid")] == [6, 8, 12]
    with pytest.raises(KeyError):
        sizeof(Cell, "torque")


def test_variables_never_overlap():
    memory = Memory(16 * PAGE)
    views = [memory.new(view) for view in (Axis, Cell, Axis, Cell)]
    ranges = [range(adr(v), adr(v) + sizeof(v)) for v in views]
    for before, after in pairwise(ranges):
        assert before.stop <= after.start
