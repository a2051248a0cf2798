"""Records are written and read."""

import struct

import pytest

from plcsim.core.errors import PageFault
from plcsim.core.logbook import Severity
from plcsim.library.areventlog import (
    arEVENTLOG_ERR_ADDDATA_NULL,
    arEVENTLOG_ERR_DESCRIPTION_NULL,
    arEVENTLOG_ERR_FORMAT_INVALID,
    arEVENTLOG_ERR_IDENT_INVALID,
    arEVENTLOG_ERR_IDENT_SYSTEM,
    arEVENTLOG_ERR_NO_DESCRIPTION,
    arEVENTLOG_ERR_RECORDID_INVALID,
    arEVENTLOG_ERR_SIZE_INVALID,
)
from plcsim.library.areventlog.books import ArEventLogGetIdent
from plcsim.library.areventlog.records import (
    ArEventLogGetLatestRecordID,
    ArEventLogGetPreviousRecordID,
    ArEventLogRead,
    ArEventLogReadAddData,
    ArEventLogReadDescription,
    ArEventLogReadErrorNumber,
    ArEventLogReadObjectID,
    ArEventLogWrite,
)

WARNING = 0xA000_04D2 - 2**32
"""Severity 2, code 1234."""

NEW_YEAR_2000 = 946_684_800


@pytest.fixture
def user(do):
    return do(ArEventLogGetIdent, Name="$arlogusr").Ident


@pytest.fixture
def write(do, plc, user):
    """``write(b"text", EventID=...)``: write a record with additional data, as text."""

    def write(data=b"", **inputs):
        given = {"Ident": user, "EventID": WARNING, "AddDataFormat": 1} | inputs
        if data:
            given = {"AddData": plc.bytes(data), "AddDataSize": len(data)} | given
        return do(ArEventLogWrite, **given)

    return write


def test_a_record_is_read_as_it_was_written(do, plc, user, write):
    first = write()
    plc.pass_ms(2500)
    made = write(b"hot\0", ObjectID="mixer", OriginRecordID=first.RecordID)
    read = do(ArEventLogRead, Ident=user, RecordID=made.RecordID)
    assert (read.EventID, read.OriginRecordID) == (WARNING, first.RecordID)
    assert (read.AddDataFormat, read.AddDataSize) == (1, 4)
    assert (read.TimeStamp.sec, read.TimeStamp.nsec) == (NEW_YEAR_2000 + 2, 500_000_000)
    about = do(ArEventLogReadObjectID, Ident=user, RecordID=made.RecordID)
    assert about.ObjectID == "mixer"
    number = do(ArEventLogReadErrorNumber, Ident=user, RecordID=made.RecordID)
    assert (number.ErrorNumber, number.Severity) == (1234, 2)
    target = plc.bytes(b"#" * 8)
    given = {"Ident": user, "RecordID": made.RecordID, "AddData": target}
    data = do(ArEventLogReadAddData, BytesToRead=3, **given)
    assert data.AddDataSize == 4
    assert plc.memory.read(target, 4) == b"hot#"


def test_a_time_may_be_given(do, plc, user, write):
    stamp = plc.bytes(struct.pack("<II", 1000, 7))
    made = write(TimeStamp=stamp)
    read = do(ArEventLogRead, Ident=user, RecordID=made.RecordID)
    assert (read.TimeStamp.sec, read.TimeStamp.nsec) == (1000, 7)


def test_records_from_the_latest_to_the_first(do, user, write):
    assert do(ArEventLogGetLatestRecordID, Ident=user).RecordID == 0
    numbers = [write().RecordID for _ in range(3)]
    number, found = do(ArEventLogGetLatestRecordID, Ident=user).RecordID, []
    while number:
        found.append(number)
        number = do(ArEventLogGetPreviousRecordID, Ident=user, RecordID=number).PrevRecordID
    assert found == numbers[::-1]


def test_a_record_is_a_line_of_the_logbook(plc, write):
    write(b"too \x07hot", ObjectID="mixer")
    write(EventID=0x6000_0001)
    warning, information = plc.controller.logbook
    assert (warning.severity, warning.source) == (Severity.WARNING, "mixer")
    assert warning.text == "too \\x07hot (event 16#A00004D2 in $arlogusr)"
    assert (information.severity, information.source) == (Severity.INFORMATION, "system")


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"Ident": 99}, arEVENTLOG_ERR_IDENT_INVALID),
        ({"Ident": 1}, arEVENTLOG_ERR_IDENT_SYSTEM),
        ({"AddDataFormat": 3}, arEVENTLOG_ERR_FORMAT_INVALID),
        ({"AddDataFormat": 151}, arEVENTLOG_ERR_FORMAT_INVALID),
        ({"AddDataSize": 4}, arEVENTLOG_ERR_ADDDATA_NULL),
        ({"AddDataSize": 1001, "AddData": 16}, arEVENTLOG_ERR_SIZE_INVALID),
    ],
)
def test_records_that_cannot_be(plc, write, inputs, status):
    found = write(**inputs)
    assert (found.StatusID, found.RecordID) == (status, 0)
    assert len(plc.controller.logbook) == 0


def test_a_wild_pointer_writes_nothing(do, user, write):
    with pytest.raises(PageFault):
        write(AddData=0x7000_0000, AddDataSize=4)
    assert do(ArEventLogGetLatestRecordID, Ident=user).RecordID == 0


@pytest.mark.parametrize(
    "view",
    [
        ArEventLogRead,
        ArEventLogReadAddData,
        ArEventLogReadDescription,
        ArEventLogReadErrorNumber,
        ArEventLogReadObjectID,
        ArEventLogGetPreviousRecordID,
    ],
)
def test_no_such_log_or_record(do, user, view):
    assert do(view, Ident=user, RecordID=1).StatusID == arEVENTLOG_ERR_RECORDID_INVALID
    assert do(view, Ident=99, RecordID=1).StatusID == arEVENTLOG_ERR_IDENT_INVALID


def test_the_controllers_own_logbook(do, plc, write):
    system = do(ArEventLogGetIdent, Name="$arlogsys").Ident
    plc.pass_ms(1000)
    write(b"hot", ObjectID="mixer")
    number = do(ArEventLogGetLatestRecordID, Ident=system).RecordID
    read = do(ArEventLogRead, Ident=system, RecordID=number)
    assert read.TimeStamp.sec == NEW_YEAR_2000 + 1
    severity = do(ArEventLogReadErrorNumber, Ident=system, RecordID=number).Severity
    assert severity == 2
    buffer = plc.bytes(b"#" * 20)
    given = {"Ident": system, "RecordID": number, "TextBuffer": buffer}
    text = do(ArEventLogReadDescription, TextBufferSize=8, **given)
    assert text.TextSize == 8
    assert plc.memory.read(buffer, 9) == b"hot (ev\0#"
    no_room = do(ArEventLogReadDescription, **given)
    assert no_room.StatusID == arEVENTLOG_ERR_DESCRIPTION_NULL


def test_events_of_programs_have_no_description(do, user, write):
    found = do(ArEventLogReadDescription, Ident=user, RecordID=write().RecordID)
    assert found.StatusID == arEVENTLOG_ERR_NO_DESCRIPTION


def test_additional_data_without_a_buffer(do, user, write):
    found = do(ArEventLogReadAddData, Ident=user, RecordID=write(b"x").RecordID)
    assert found.StatusID == arEVENTLOG_ERR_ADDDATA_NULL
