"""Blocks with enable and status: done in the call, or BUSY first."""

import pytest

from plcsim.library.astime.clock import DstGetInfo, DTStructureGetTime, UtcDTGetTime
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE, ERR_OK


def statuses(block, enables):
    found = []
    for enable in enables:
        block(enable=enable)
        found.append(block.status)
    return found


def test_a_synchronous_block_is_done_in_the_call(plc):
    wanted = [ERR_OK, ERR_FUB_ENABLE_FALSE, ERR_OK]
    assert statuses(plc.new(UtcDTGetTime), [True, False, True]) == wanted


def test_an_asynchronous_block_is_busy_first_and_starts_anew_when_done(plc):
    wanted = [ERR_FUB_BUSY, ERR_OK, ERR_FUB_BUSY, ERR_OK]
    assert statuses(plc.new(DstGetInfo), [True] * 4) == wanted


def test_enable_false_resets(plc):
    wanted = [ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE, ERR_FUB_BUSY, ERR_OK]
    assert statuses(plc.new(DstGetInfo), [True, False, True, True]) == wanted


def test_a_wild_pointer_faults_and_changes_nothing(plc):
    block = plc.new(DTStructureGetTime)
    with pytest.raises(Exception, match="page fault: 12 bytes at address 16#70000000"):
        block(enable=True, pDTStructure=0x7000_0000)
    assert block.status == 0
