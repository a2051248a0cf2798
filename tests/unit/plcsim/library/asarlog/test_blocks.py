"""AsArLog: logbooks are made, written, read, cleared and deleted."""

import pytest

from plcsim.library import asarlog
from plcsim.library.areventlog.books import ArEventLogGetIdent
from plcsim.library.asarlog import blocks
from plcsim.library.asarlog.interface import (
    arlogBASE_SYSTEM_LOG_IDENT,
    arlogBASE_USER_LOG_IDENT,
    arlogDRAM,
    arlogERR_ACCESS_DENIED,
    arlogERR_EXISTING,
    arlogERR_ILL_LEN,
    arlogERR_ILL_LOGLEVEL,
    arlogERR_ILL_MEMTYPE,
    arlogERR_ILL_NAME,
    arlogERR_INVALID_IDENT,
    arlogERR_INVALID_INDEX,
    arlogERR_NOMEMORY,
    arlogERR_NOTEXISTING,
    arlogERR_READ_ASCII_BUFFER,
    arlogERR_READ_BINARY_BUFFER,
    arlogERR_READ_BUFFER,
    arlogLEVEL_FATAL,
    arlogLEVEL_WARNING,
)
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_OK


@pytest.fixture
def text(plc):
    return lambda value: plc.memory.keep(value.encode("latin-1") + b"\0")


@pytest.fixture
def do(plc):
    """``do(Block, ident=1)``: call a block until it is not BUSY."""

    def do(view, **inputs):
        block = plc.call(view, **inputs)
        assert block.status == ERR_FUB_BUSY
        block()
        return block

    return do


@pytest.fixture
def ident(do, text):
    made = do(blocks.AsArLogCreate, pName=text("mylog"), len=4096, memType=arlogDRAM)
    assert made.status == ERR_OK
    return made.ident


def test_what_was_written_is_read(plc, do, text, ident):
    data = plc.memory.keep(b"\1\2\3")
    for number in (50000, 70000):
        inputs = {"logLevel": arlogLEVEL_WARNING, "errornr": number, "mem": data, "len": 3}
        written = do(blocks.AsArLogWrite, ident=ident, asciiString=text("Türe offen"), **inputs)
        assert written.status == ERR_OK
    info = plc.call(blocks.AsArLogGetInfo, pName=text("mylog"))
    assert (info.status, info.ident, info.actualIndex) == (ERR_OK, ident, 2)
    assert (info.len, info.memType) == (4096, arlogDRAM)
    header, binary, ascii_ = (plc.memory.keep(bytes(100)) for _ in range(3))
    places = {"memBin": binary, "lenBin": 3, "memAscii": ascii_, "lenAscii": 11}
    read = do(blocks.AsArLogRead, ident=ident, index=2, arlogRead=header, **places)
    assert read.status == ERR_OK
    found = plc.memory.access(asarlog.asarlogRead, header)
    assert (found.errornr, found.logLevel) == (70000, arlogLEVEL_WARNING)
    assert (found.lenBin, found.lenAscii, found.len) == (3, 10, 88 + 13)
    assert (found.errYear, found.errMonth) == (2000, 1)
    assert plc.memory.read(binary, 4) == b"\1\2\3\0"
    assert plc.memory.string(ascii_, 99).decode("latin-1") == "Türe offen"


def test_places_that_are_too_small(plc, do, text, ident):
    data = plc.memory.keep(b"\1\2\3")
    write = {"logLevel": arlogLEVEL_FATAL, "errornr": 1, "mem": data, "len": 3}
    do(blocks.AsArLogWrite, ident=ident, asciiString=text("abc"), **write)
    place = plc.memory.keep(bytes(100))

    def status(**inputs):
        return do(
            blocks.AsArLogRead, ident=ident, **{"index": 1, "arlogRead": place, **inputs}
        ).status

    assert status(memBin=place, lenBin=2) == arlogERR_READ_BINARY_BUFFER
    assert status(memAscii=place, lenAscii=3) == arlogERR_READ_ASCII_BUFFER
    assert status(arlogRead=0) == arlogERR_READ_BUFFER
    assert status(index=2) == arlogERR_INVALID_INDEX
    assert status() == ERR_OK


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"pName": 0}, arlogERR_ILL_NAME),
        ({"len": 4095}, arlogERR_ILL_LEN),
        ({"memType": 9}, arlogERR_ILL_MEMTYPE),
    ],
)
def test_what_no_logbook_is_made_of(do, text, inputs, status):
    given = {"pName": text("x"), "len": 4096, "memType": arlogDRAM, **inputs}
    assert do(blocks.AsArLogCreate, **given).status == status


def test_a_logbook_that_is_there_or_not(plc, do, text, ident):
    again = do(blocks.AsArLogCreate, pName=text("mylog"), len=4096, memType=arlogDRAM)
    assert (again.status, again.ident) == (arlogERR_EXISTING, ident)
    assert plc.call(blocks.AsArLogGetInfo, pName=text("no")).status == arlogERR_NOTEXISTING
    assert do(blocks.AsArLogDelete, ident=ident).status == ERR_OK
    assert do(blocks.AsArLogDelete, ident=ident).status == arlogERR_INVALID_IDENT
    assert plc.call(blocks.AsArLogGetInfo, pName=text("mylog")).status == arlogERR_NOTEXISTING


def test_the_logbooks_of_the_controller_are_not_for_deleting(plc, do, text):
    for ident in (arlogBASE_SYSTEM_LOG_IDENT, arlogBASE_USER_LOG_IDENT):
        assert do(blocks.AsArLogDelete, ident=ident).status == arlogERR_ACCESS_DENIED
        assert do(blocks.AsArLogClear, ident=ident).status == arlogERR_ACCESS_DENIED
        given = {"logLevel": arlogLEVEL_FATAL, "errornr": 5, "asciiString": text("ow")}
        assert do(blocks.AsArLogWrite, ident=ident, **given).status == ERR_OK
    assert plc.call(blocks.AsArLogGetInfo, pName=text("$arlogusr")).actualIndex == 1


def test_what_is_not_written(do, ident):
    write = blocks.AsArLogWrite
    assert do(write, ident=ident, logLevel=4).status == arlogERR_ILL_LOGLEVEL
    assert do(write, ident=3, logLevel=1).status == arlogERR_INVALID_IDENT
    assert do(write, ident=5, logLevel=1).status == arlogERR_INVALID_IDENT
    assert do(write, ident=ident, logLevel=1, len=1001).status == arlogERR_NOMEMORY


def test_clear_and_the_other_library(plc, do, text, ident):
    do(blocks.AsArLogWrite, ident=ident, logLevel=1, asciiString=text("abc"))
    assert do(blocks.AsArLogClear, ident=ident).status == ERR_OK
    assert plc.call(blocks.AsArLogGetInfo, pName=text("mylog")).actualIndex == 0
    found = plc.new(ArEventLogGetIdent)
    found(Execute=True, Name="mylog")
    assert (found.Done, found.Ident + 4) == (True, ident)
