"""Every block of the library is BUSY first, resets with enable FALSE, and knows errors."""

import pytest

from plcsim.library.fileio import devices, directories, files, transfer
from plcsim.library.fileio.block import FileIoBlock
from plcsim.library.installed import installed
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE, ERR_OK

BLOCKS = [
    value
    for module in (devices, directories, files, transfer)
    for value in vars(module).values()
    if isinstance(value, type) and issubclass(value, FileIoBlock) and "_plc_type" in dir(value)
    if value.__module__ == module.__name__ and not value.__name__.startswith("_")
]


def test_all_declared_blocks_are_here():
    declared = {b.name for b in installed()["plcsim.library.fileio"].scope.function_blocks}
    assert {block.__name__ for block in BLOCKS} == declared


@pytest.mark.parametrize("view", BLOCKS)
def test_busy_then_done_then_reset(plc, view):
    block = plc.new(view)
    block(enable=True)
    assert block.status == ERR_FUB_BUSY
    block()
    failed = block.status
    assert failed not in (ERR_OK, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE)
    assert 20700 <= failed <= 20799
    block(enable=False)
    assert block.status == ERR_FUB_ENABLE_FALSE
