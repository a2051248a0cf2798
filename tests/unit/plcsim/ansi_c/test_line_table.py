import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.line_table import read_line_table
from plcsim.machine import CodeCache
from plcsim.machine.errors import MachineError
from plcsim.machine.shared_module import read_shared

TEXT = """int marker(int a)
{
  return a * 7 / (a - 1);
}

int other(int a)
{
  int b = a;
  while (b)
    b = marker(b);
  return b;
}
"""


def test_code_belongs_to_the_lines_that_it_was_made_of(each_toolchain, source):
    file = source("main.c", TEXT)
    module = read_shared(build(BuildOrder("p", [file]), each_toolchain, CodeCache(None)).wasm)
    table = read_line_table(module.section(".debug_line"))
    wasm, start = module.wasm, module.code_start
    divisions = [at for at in range(start, len(wasm)) if wasm[at] == 0x6D][:1]
    assert [table.location(at - start) for at in divisions] == [f"{file}:3"]
    found = {table.location(address) for address in range(200)}
    assert {f"{file}:{line}" for line in (3, 7)} <= found


def test_before_and_behind_all_code_there_is_no_line(built):
    table = read_line_table(read_shared(built(TEXT).wasm).section(".debug_line"))
    assert table.location(0) == ""
    assert table.location(1 << 20) == ""


def test_without_debug_information_there_are_no_lines():
    assert read_line_table(b"").location(5) == ""


def test_another_version_is_left_out():
    unit = b"\5\0" + bytes(20)
    assert read_line_table(len(unit).to_bytes(4, "little") + unit).location(0) == ""


@given(st.binary(max_size=60), st.integers(0, 60))
def test_any_bytes_are_read_or_refused(data, length):
    section = (length + 2).to_bytes(4, "little") + b"\4\0" + data
    with contextlib.suppress(MachineError):
        read_line_table(section)


@pytest.mark.parametrize("cut", [5, 20, 40])
def test_half_a_table_is_refused_or_read_so_far(built, cut):
    section = read_shared(built(TEXT).wasm).section(".debug_line")
    with contextlib.suppress(MachineError):
        read_line_table(section[:cut])
