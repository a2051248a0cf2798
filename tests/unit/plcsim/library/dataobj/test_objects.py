"""Data objects: made, found, written, read, copied, deleted."""

import pytest

from plcsim.core.errors import PageFault
from plcsim.library import dataobj
from plcsim.library.dataobj import (
    doERR_DUPOBJECT,
    doERR_ILLEGALLENGTH,
    doERR_ILLMEMTYPE,
    doERR_ILLOBJECT,
    doERR_ILLPARAMETER,
    doERR_ILLSTATE,
    doERR_MODULNOTFOUND,
    doERR_NOMEMORY,
    doERR_TOOLONG_MODULNAME,
    doERR_WRONGOFFSET,
    doERR_WRONGTIME,
    doTEMP,
    doUSRRAM,
    doUSRROM,
    objects,
)
from plcsim.library.dataobj.settings import MadeObjects
from plcsim.library.heap import heap_of
from plcsim.library.runtime import ERR_OK

NEW_YEAR_2000 = 946_684_800


def make(plc, name="recipe", size=10, data=0, memory=doUSRRAM):
    return plc.finish(
        objects.DatObjCreate, pName=plc.text(name), len=size, MemType=memory, pCpyData=data
    )


def info(plc, name):
    return plc.call(objects.DatObjInfo, pName=plc.text(name))


@pytest.fixture
def made(plc):
    """An object of ten bytes: 0123456789."""
    found = make(plc, data=plc.bytes(b"0123456789xx"))
    assert found.status == ERR_OK
    return found


def test_an_object_holds_what_it_was_made_from(plc, made):
    assert plc.memory.read(made.pDatObjMem, 10) == b"0123456789"
    assert plc.memory.read(make(plc, "zeros").pDatObjMem, 10) == bytes(10)


def test_it_is_found_by_its_name(plc, made):
    found = info(plc, "recipe")
    assert (found.status, found.ident, found.pDatObjMem) == (ERR_OK, made.ident, made.pDatObjMem)
    assert (found.len, found.MemType, found.ChangeDate) == (10, doUSRRAM, NEW_YEAR_2000)
    other = info(plc, "Recipe")
    assert (other.status, other.ident, other.len) == (doERR_MODULNOTFOUND, 0, 0)


def test_writing_and_reading_a_part(plc, made):
    plc.pass_ms(5000)
    source = plc.bytes(b"abc")
    write = plc.call(objects.DatObjWrite, ident=made.ident, Offset=7, pSource=source, len=3)
    assert write.status == ERR_OK
    target = plc.bytes(b"#" * 6)
    read = plc.call(objects.DatObjRead, ident=made.ident, Offset=5, pDestination=target, len=5)
    assert read.status == ERR_OK
    assert plc.memory.read(target, 6) == b"56abc#"
    assert info(plc, "recipe").ChangeDate == NEW_YEAR_2000 + 5


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"Offset": 11, "len": 0}, doERR_WRONGOFFSET),
        ({"Offset": 8, "len": 3}, doERR_ILLEGALLENGTH),
        ({"Offset": 0, "len": 2**32 - 1}, doERR_ILLEGALLENGTH),
        ({"Offset": 0, "len": 1}, doERR_ILLPARAMETER),
        ({"ident": 77}, doERR_ILLOBJECT),
    ],
)
def test_parts_that_are_not_there(plc, made, inputs, status):
    inputs = {"ident": made.ident} | inputs
    for block in objects.DatObjWrite, objects.DatObjRead:
        assert plc.call(block, **inputs).status == status
    assert plc.memory.read(made.pDatObjMem, 10) == b"0123456789"


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"name": "recipe"}, doERR_DUPOBJECT),
        ({"name": "other", "size": 0}, doERR_ILLEGALLENGTH),
        ({"name": "other", "memory": 99}, doERR_ILLMEMTYPE),
        ({"name": "other", "size": 2**31}, doERR_NOMEMORY),
        ({"name": "eleven_char"}, doERR_TOOLONG_MODULNAME),
        ({"name": ""}, doERR_ILLPARAMETER),
    ],
)
def test_objects_that_cannot_be(plc, made, inputs, status):
    found = make(plc, **inputs)
    assert (found.status, found.ident, found.pDatObjMem) == (status, 0, 0)


def test_null_and_wild_pointers(plc):
    create = plc.finish(objects.DatObjCreate, len=1, MemType=doUSRRAM)
    assert create.status == doERR_ILLPARAMETER
    assert plc.call(objects.DatObjInfo).status == doERR_ILLPARAMETER
    block = plc.call(
        objects.DatObjCreate, pName=plc.text("x"), len=8, MemType=doTEMP, pCpyData=0x7000_0000
    )
    with pytest.raises(PageFault):
        block()
    assert info(plc, "x").status == doERR_MODULNOTFOUND


def test_deleting_gives_the_memory_back(plc, made):
    assert plc.finish(objects.DatObjDelete, ident=made.ident).status == ERR_OK
    assert heap_of(plc.context).size_of(made.pDatObjMem) is None
    assert plc.finish(objects.DatObjDelete, ident=made.ident).status == doERR_ILLOBJECT
    assert info(plc, "recipe").status == doERR_MODULNOTFOUND
    assert make(plc).status == ERR_OK


def test_an_attached_object_is_kept(plc, made):
    assert plc.call(objects.DatObjAttach, ident=made.ident).status == ERR_OK
    assert plc.finish(objects.DatObjDelete, ident=made.ident).status == doERR_ILLSTATE
    assert plc.call(objects.DatObjDetach, ident=made.ident).status == ERR_OK
    assert plc.call(objects.DatObjDetach, ident=made.ident).status == doERR_ILLSTATE
    assert plc.finish(objects.DatObjDelete, ident=made.ident).status == ERR_OK
    for block in objects.DatObjAttach, objects.DatObjDetach:
        assert plc.call(block, ident=77).status == doERR_ILLOBJECT


def test_copying(plc, made):
    inputs = {"ident": made.ident, "MemTypeTarget": doTEMP}
    copy = plc.finish(objects.DatObjCopy, pNameTarget=plc.text("copy"), **inputs)
    assert copy.status == ERR_OK
    assert copy.pDatObjMemNew != made.pDatObjMem
    assert plc.memory.read(copy.pDatObjMemNew, 10) == b"0123456789"
    assert info(plc, "copy").ident == copy.identNew
    again = plc.finish(objects.DatObjCopy, pNameTarget=plc.text("copy"), **inputs)
    assert again.status == doERR_DUPOBJECT
    assert plc.finish(objects.DatObjCopy, ident=77).status == doERR_ILLOBJECT
    assert plc.finish(objects.DatObjCopy, **inputs).status == doERR_ILLPARAMETER


def test_moving_leaves_it_where_it_is(plc, made):
    moved = plc.finish(objects.DatObjMove, ident=made.ident, MemType=doTEMP)
    assert (moved.status, moved.identNew) == (ERR_OK, made.ident)
    assert info(plc, "recipe").MemType == doTEMP
    assert plc.finish(objects.DatObjMove, ident=made.ident, MemType=99).status == doERR_ILLMEMTYPE
    assert plc.finish(objects.DatObjMove, ident=77).status == doERR_ILLOBJECT


def test_the_date(plc, made):
    change = objects.DatObjChangeDate
    assert plc.call(change, pName=plc.text("recipe"), SetDate=1000).status == ERR_OK
    assert info(plc, "recipe").ChangeDate == 1000
    late = plc.call(change, pName=plc.text("recipe"), SetDate=4_102_444_800)
    assert late.status == doERR_WRONGTIME
    assert plc.call(change, pName=plc.text("x")).status == doERR_MODULNOTFOUND
    assert plc.call(change).status == doERR_ILLPARAMETER


def test_a_restart_forgets_them(plc, made):
    plc.context.restart()
    assert info(plc, "recipe").status == doERR_MODULNOTFOUND
    assert dataobj.doERR_MODULNOTFOUND == 20609


def test_the_objects_of_a_project_are_there_at_first_and_after_a_restart(plc):
    plc.context.give_settings(MadeObjects({"speeds": b"12345", "toolonganame": b"1", "none": b""}))
    for _ in range(2):
        found = info(plc, "speeds")
        assert (found.status, found.len, found.MemType) == (ERR_OK, 5, doUSRROM)
        assert plc.context.memory.read(found.pDatObjMem, 5) == b"12345"
        assert info(plc, "none").status == doERR_MODULNOTFOUND
        plc.context.restart()
