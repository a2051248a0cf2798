"""Execute, Busy, Done, Error: as PLCopen has them."""

from plcsim.library.areventlog import arEVENTLOG_ERR_LOGBOOK_NOT_FOUND
from plcsim.library.areventlog.books import ArEventLogCreate, ArEventLogGetIdent


def outputs(block):
    return block.Done, block.Error, block.StatusID


def test_a_synchronous_block_is_done_at_once_and_once(plc):
    block = plc.new(ArEventLogGetIdent)
    block(Execute=False)
    assert outputs(block) == (False, False, 0)
    block(Execute=True, Name="$arlogusr")
    assert outputs(block) == (True, False, 0)
    block(Name="nothing")
    assert outputs(block) == (True, False, 0)
    block(Execute=False)
    assert outputs(block) == (False, False, 0)
    block(Execute=True)
    assert outputs(block) == (False, True, arEVENTLOG_ERR_LOGBOOK_NOT_FOUND)


def test_an_asynchronous_block_is_busy_first(plc):
    block = plc.new(ArEventLogCreate)
    found = []
    for execute in (True, True, True, False, True):
        block(Execute=execute, Name="mine", Size=1000)
        found.append((block.Busy, block.Done, block.Error))
    busy, done, idle = (True, False, False), (False, True, False), (False, False, False)
    assert found == [busy, done, done, idle, busy]
