"""Semaphores: they count, and nobody waits."""

import pytest

from plcsim.library import assem
from plcsim.library.assem import (
    semERR_ALREADY_FREE,
    semERR_CREATE,
    semERR_DELETE,
    semERR_NOT_EXIST,
    semERR_NOT_FREE,
)
from plcsim.library.assem.semaphores import Semaphores
from plcsim.library.runtime import ERR_OK


def test_a_semaphore_counts(plc):
    ident = plc.call(assem.SemCreate, initCount=1, maxCount=2).ident
    acquire, release = plc.function("SemAcquire"), plc.function("SemRelease")
    assert [acquire(ident), acquire(ident)] == [ERR_OK, semERR_NOT_FREE]
    assert [release(ident), release(ident)] == [ERR_OK, ERR_OK]
    assert release(ident) == semERR_ALREADY_FREE
    info = plc.call(assem.SemGetInfo, ident=ident)
    assert (info.status, info.maxCount, info.curCount) == (ERR_OK, 2, 2)


def test_a_deleted_one_is_unknown(plc):
    ident = plc.call(assem.SemCreate, initCount=0, maxCount=1).ident
    assert plc.call(assem.SemDelete, ident=ident).status == ERR_OK
    assert plc.call(assem.SemDelete, ident=ident).status == semERR_DELETE
    assert plc.call(assem.SemGetInfo, ident=ident).status == semERR_NOT_EXIST
    assert plc.function("SemAcquire")(ident) == semERR_NOT_EXIST
    assert plc.function("SemRelease")(ident) == semERR_NOT_EXIST
    assert plc.call(assem.SemCreate, initCount=0, maxCount=1).ident != ident


@pytest.mark.parametrize("counts", [(0, 0), (3, 2)])
def test_counts_that_cannot_be(plc, counts):
    made = plc.call(assem.SemCreate, initCount=counts[0], maxCount=counts[1])
    assert made.status == semERR_CREATE


def test_there_is_an_end_of_semaphores(plc):
    block = plc.new(assem.SemCreate)
    block.maxCount = 1
    for _ in range(4096):
        block(enable=True)
        assert block.status == ERR_OK
    block()
    assert block.status == semERR_CREATE
    assert len(plc.context.library(Semaphores)) == 4096
