"""MpAlarmXHistory: what a program sees of changes of alarms."""

import pytest

from .test_alarms import CONFIGURATION, DECLARATIONS

DATA = DECLARATIONS["MpAlarmX"]
MORE = {
    "MpAlarmX": {
        "MpAlarmX.typ": DATA["MpAlarmX.typ"]
        + """
TYPE
    MpAlarmXHistoryUIAlarmListType : STRUCT
        Severity : ARRAY[0..3] OF UDINT;
        Message : ARRAY[0..3] OF WSTRING[20];
        Name : ARRAY[0..3] OF STRING[20];
        OldState : ARRAY[0..3] OF MpAlarmXStateEnum;
        NewState : ARRAY[0..3] OF MpAlarmXStateEnum;
        Timestamp : ARRAY[0..3] OF STRING[50];
        MaxSelection : UINT;
    END_STRUCT;
    MpAlarmXHistoryUIConnectType : STRUCT
        AlarmList : MpAlarmXHistoryUIAlarmListType;
    END_STRUCT;
    MpAlarmXHistoryUISetupType : STRUCT
        AlarmListSize : UINT := 20;
    END_STRUCT;
END_TYPE
""",
        "MpAlarmX.fun": DATA["MpAlarmX.fun"]
        + """
FUNCTION_BLOCK MpAlarmXHistory
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        Export : BOOL;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        Error : BOOL;
        StatusID : DINT;
        CommandBusy : BOOL;
        CommandDone : BOOL;
        HistoryEntries : UDINT;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK MpAlarmXHistoryUI
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        UISetup : MpAlarmXHistoryUISetupType;
        UIConnect : REFERENCE TO MpAlarmXHistoryUIConnectType;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        Error : BOOL;
        StatusID : DINT;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION MpAlarmXClearHistory : DINT
    VAR_INPUT
        MpLink : MpComIdentType;
    END_VAR
END_FUNCTION
""",
    }
}

CODE = """
    PROGRAM _CYCLIC
        core(MpLink := ADR(gAlarms), Enable := TRUE);
        all(MpLink := ADR(gAlarms), Enable := TRUE, Execute := ackAll);
        IF doSet THEN ident := MpAlarmXSet(gAlarms, 'Jam'); END_IF
        IF doReset THEN result := MpAlarmXReset(gAlarms, 'Jam'); END_IF
        IF doClear THEN result := MpAlarmXClearHistory(gHistory); END_IF
        doSet := FALSE; doReset := FALSE; doClear := FALSE;
        history(MpLink := ADR(gHistory), Enable := TRUE);
        list(MpLink := ADR(gHistory), Enable := TRUE, UIConnect := ADR(screen));
    END_PROGRAM
"""
VARIABLES = """
    core : MpAlarmXCore;
    all : MpAlarmXAcknowledgeAll;
    history : MpAlarmXHistory;
    list : MpAlarmXHistoryUI;
    screen : MpAlarmXHistoryUIConnectType;
    doSet, doReset, doClear, ackAll : BOOL;
    ident : UDINT;
    result : DINT;
    heat : REAL;
"""


@pytest.fixture
def plc(filler):
    return filler(MORE, CONFIGURATION, CODE, VARIABLES, "gHistory : MpComIdentType;")


def do(plc, *names):
    for name in names:
        plc[f"Main.{name}"] = True
        plc.run("20ms")


def lines(plc, member):
    return [plc[f"Main.screen.AlarmList.{member}[{n}]"] for n in range(4)]


def test_changes_are_listed_the_latest_first(plc):
    do(plc, "doSet", "doSet", "doReset", "doReset", "ackAll")
    assert plc["Main.history.HistoryEntries"] == 3
    assert lines(plc, "Name") == ["Jam", "Jam", "Jam", ""]
    assert lines(plc, "OldState")[:3] == [4, 1, 2]
    assert lines(plc, "NewState") == [3, 2, 1, 0]
    assert lines(plc, "Message") == ["Jammed", "Jammed", "Jammed", ""]
    assert [each[-3:] for each in lines(plc, "Timestamp")[:3]] == ["085", "045", "005"]
    assert plc["Main.screen.AlarmList.MaxSelection"] == 2


def test_an_alarm_that_is_set_again_is_in_the_list_again(plc):
    do(plc, "doSet", "doReset", "doSet")
    assert lines(plc, "NewState") == [1, 2, 1, 0]


def test_the_history_is_cleared(plc):
    do(plc, "doSet", "doReset")
    assert plc["Main.history.HistoryEntries"] == 2
    do(plc, "doClear")
    assert (plc["Main.result"], plc["Main.history.HistoryEntries"]) == (0, 0)
    assert lines(plc, "Name") == ["", "", "", ""]
    assert plc["Main.core.PendingAlarms"] == 1


def test_an_export_is_done_and_the_list_has_a_size(plc):
    plc["Main.list.UISetup.AlarmListSize"] = 1
    do(plc, "doSet", "doReset", "history.Export")
    assert plc["Main.history.CommandDone"] is True
    assert lines(plc, "NewState") == [2, 0, 0, 0]
    plc["Main.history.Export"] = False
    plc.run("20ms")
    assert plc["Main.history.CommandDone"] is False


def test_a_list_without_a_screen_says_so(filler):
    code = """
        PROGRAM _CYCLIC
            list(MpLink := ADR(gHistory), Enable := TRUE);
        END_PROGRAM
    """
    plc = filler(MORE, {}, code, "list : MpAlarmXHistoryUI;", "gHistory : MpComIdentType;")
    plc.run("20ms")
    assert (plc["Main.list.Active"], plc["Main.list.StatusID"]) == (True, -2137858045)
