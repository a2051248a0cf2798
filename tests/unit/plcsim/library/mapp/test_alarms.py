"""MpAlarmX: what programs see of alarms that they, or variables, set."""

import pytest

DECLARATIONS = {
    "MpAlarmX": {
        "MpAlarmX.typ": """
TYPE
    MpAlarmXStateEnum : (mpALARMX_STATE_NONE := 0, mpALARMX_STATE_ACTIVE := 1,
        mpALARMX_STATE_INACTIVE := 2, mpALARMX_STATE_ACKNOWLEDGED := 3,
        mpALARMX_STATE_UNACKNOWLEDGED := 4);
    MpAlarmXListUIAlarmListType : STRUCT
        Severity : ARRAY[0..2] OF UDINT;
        Code : ARRAY[0..2] OF UDINT;
        Message : ARRAY[0..2] OF WSTRING[20];
        InstanceID : ARRAY[0..2] OF UDINT;
        Name : ARRAY[0..2] OF STRING[20];
        StateActive : ARRAY[0..2] OF BOOL;
        StateAcknowledged : ARRAY[0..2] OF BOOL;
        Timestamp : ARRAY[0..2] OF STRING[50];
        SelectedIndex : UINT;
        MaxSelection : UINT;
    END_STRUCT;
    MpAlarmXListUIConnectType : STRUCT
        AlarmList : MpAlarmXListUIAlarmListType;
        Acknowledge : BOOL;
        AcknowledgeAll : BOOL;
        AcknowledgeID : UDINT;
    END_STRUCT;
    MpAlarmXListUISetupType : STRUCT
        AlarmListSize : UINT := 20;
    END_STRUCT;
END_TYPE
""",
        "MpAlarmX.fun": """
FUNCTION_BLOCK MpAlarmXCore
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        ErrorReset : BOOL;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        Error : BOOL;
        StatusID : DINT;
        ActiveAlarms : UDINT;
        PendingAlarms : UDINT;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK MpAlarmXAcknowledgeAll
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        Execute : BOOL;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        CommandDone : BOOL;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK MpAlarmXAlarmControl
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        Name : REFERENCE TO STRING[255];
        ID : UDINT;
        Set : BOOL;
        Reset : BOOL;
        Acknowledge : BOOL;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        Error : BOOL;
        StatusID : DINT;
        CommandDone : BOOL;
        InstanceID : UDINT;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK MpAlarmXListUI
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        UISetup : MpAlarmXListUISetupType;
        UIConnect : REFERENCE TO MpAlarmXListUIConnectType;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        StatusID : DINT;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION MpAlarmXSet : UDINT
    VAR_INPUT
        MpLink : MpComIdentType;
        Name : STRING[255];
    END_VAR
END_FUNCTION
FUNCTION MpAlarmXReset : DINT
    VAR_INPUT
        MpLink : MpComIdentType;
        Name : STRING[255];
    END_VAR
END_FUNCTION
FUNCTION MpAlarmXAcknowledge : DINT
    VAR_INPUT
        MpLink : MpComIdentType;
        Name : STRING[255];
    END_VAR
END_FUNCTION
FUNCTION MpAlarmXCheckState : BOOL
    VAR_INPUT
        MpLink : MpComIdentType;
        Name : STRING[255];
        State : MpAlarmXStateEnum;
    END_VAR
END_FUNCTION
FUNCTION MpAlarmXCheckReaction : BOOL
    VAR_INPUT
        MpLink : MpComIdentType;
        Name : STRING[255];
    END_VAR
END_FUNCTION
""",
    }
}

CONFIGURATION = {
    "Physical/PC/CPU/mappServices/Alarms.mpalarmxcore": """<Configuration>
  <Element ID="gAlarms" Type="mpalarmxcore">
    <Group ID="mapp.AlarmX.Core"><Group ID="BySeverity">
      <Group ID="[0]"><Property ID="Severity" Value="1-9" />
        <Selector ID="[0]" Value="Reaction"><Property ID="Name" Value="Lamp" /></Selector>
      </Group>
      <Group ID="[1]"><Property ID="Severity" Value="10-19" />
        <Selector ID="[0]" Value="Reaction"><Property ID="Name" Value="Stop" /></Selector>
      </Group>
    </Group></Group>
    <Group ID="mapp.AlarmX.Core.Configuration">
      <Group ID="[0]"><Property ID="Name" Value="Jam" /><Property ID="Message" Value="Jammed" />
        <Property ID="Severity" Value="12" /><Property ID="Code" Value="7" />
        <Selector ID="Behavior" Value="PersistentAlarm" /></Group>
      <Group ID="[1]"><Property ID="Name" Value="Door" /></Group>
      <Group ID="[2]"><Property ID="Name" Value="Hot" /><Property ID="Severity" Value="2" />
        <Selector ID="Behavior" Value="LevelMonitoring"><Group ID="Monitoring">
          <Property ID="MonitoredPV" Value="::Main:heat" />
          <Selector ID="HighLimitEnable" Value="Static">
            <Property ID="Limit" Value="80" /></Selector>
          <Selector ID="Settings"><Property ID="Delay" Value="0.05" /></Selector>
        </Group></Selector></Group>
    </Group>
  </Element>
</Configuration>"""
}

CODE = """
    PROGRAM _CYCLIC
        core.MpLink := ADR(gAlarms);
        core(Enable := TRUE);
        all(MpLink := ADR(gAlarms), Enable := TRUE, Execute := ackAll);
        control(MpLink := ADR(gAlarms), Enable := TRUE, Name := ADR(controlName));
        list(MpLink := ADR(gAlarms), Enable := TRUE, UIConnect := ADR(screen));
        IF doSet THEN ident := MpAlarmXSet(gAlarms, name); doSet := FALSE; END_IF
        IF doReset THEN result := MpAlarmXReset(gAlarms, name); doReset := FALSE; END_IF
        IF doAck THEN result := MpAlarmXAcknowledge(gAlarms, name); doAck := FALSE; END_IF
        lamp := MpAlarmXCheckReaction(gAlarms, 'Lamp');
        stop := MpAlarmXCheckReaction(gAlarms, 'Stop');
        isActive := MpAlarmXCheckState(gAlarms, name, mpALARMX_STATE_ACTIVE);
        isUnacknowledged := MpAlarmXCheckState(gAlarms, name, mpALARMX_STATE_UNACKNOWLEDGED);
        isNone := MpAlarmXCheckState(gAlarms, name, mpALARMX_STATE_NONE);
    END_PROGRAM
"""
VARIABLES = """
    core : MpAlarmXCore;
    all : MpAlarmXAcknowledgeAll;
    control : MpAlarmXAlarmControl;
    list : MpAlarmXListUI;
    screen : MpAlarmXListUIConnectType;
    name : STRING[80];
    controlName : STRING[80];
    doSet, doReset, doAck, ackAll : BOOL;
    lamp, stop, isActive, isUnacknowledged, isNone : BOOL;
    ident : UDINT;
    result : DINT;
    heat : REAL;
"""
TWICE = "20ms"


@pytest.fixture
def plc(filler):
    return filler(DECLARATIONS, CONFIGURATION, CODE, VARIABLES)


def do(plc, what, name):
    plc["Main.name"] = name
    plc[f"Main.{what}"] = True
    plc.run(TWICE)


def counts(plc):
    return plc["Main.core.ActiveAlarms"], plc["Main.core.PendingAlarms"]


def states(plc):
    return {each for each in ("isActive", "isUnacknowledged", "isNone") if plc[f"Main.{each}"]}


def test_an_alarm_is_active_until_it_is_reset_and_pending_until_it_is_acknowledged(plc):
    do(plc, "doSet", "Jam")
    assert (plc["Main.core.Active"], counts(plc)) == (True, (1, 1))
    assert plc["Main.ident"] > 0
    assert states(plc) == {"isActive", "isUnacknowledged"}
    do(plc, "doSet", "Jam")
    assert counts(plc) == (1, 1)
    do(plc, "doReset", "Jam")
    assert (counts(plc), plc["Main.result"], states(plc)) == ((0, 1), 0, {"isUnacknowledged"})
    do(plc, "doAck", "Jam")
    assert (counts(plc), plc["Main.result"], states(plc)) == ((0, 0), 0, {"isNone"})
    do(plc, "doReset", "Jam")
    assert plc["Main.result"] == -1064116220


def test_reactions_by_severity_last_until_the_alarm_is_no_more(plc):
    assert (plc["Main.lamp"], plc["Main.stop"]) == (False, False)
    do(plc, "doSet", "Jam")
    assert (plc["Main.lamp"], plc["Main.stop"]) == (False, True)
    do(plc, "doAck", "Jam")
    assert (plc["Main.stop"], counts(plc)) == (True, (1, 1))
    do(plc, "doReset", "Jam")
    assert (plc["Main.stop"], counts(plc)) == (False, (0, 0))


def test_an_edge_alarm_is_inactive_at_once_and_waits_for_the_operator(plc):
    do(plc, "doSet", "Door")
    assert (counts(plc), plc["Main.lamp"]) == ((0, 1), True)
    plc["Main.ackAll"] = True
    plc.run(TWICE)
    assert (counts(plc), plc["Main.lamp"]) == ((0, 0), False)
    assert plc["Main.all.CommandDone"] is True


def test_a_name_that_the_configuration_does_not_have_sets_nothing(plc):
    do(plc, "doSet", "jam")
    assert (plc["Main.ident"], counts(plc), states(plc)) == (0, (0, 0), {"isNone"})


def test_a_variable_beyond_its_limit_sets_an_alarm_after_the_delay(plc):
    plc["Main.heat"] = 80.5
    plc.run("40ms")
    assert counts(plc) == (0, 0)
    plc.run("40ms")
    assert (counts(plc), plc["Main.lamp"]) == ((1, 1), True)
    plc["Main.heat"] = 80.0
    plc.run(TWICE)
    assert counts(plc) == (0, 1)


def test_alarm_control_sets_and_resets_one_alarm_at_edges(plc):
    plc["Main.controlName"] = "Jam"
    plc["Main.control.Set"] = True
    plc.run(TWICE)
    assert plc["Main.control.CommandDone"] is True
    assert (plc["Main.control.InstanceID"] > 0, counts(plc)) == (True, (1, 1))
    plc["Main.control.Set"] = False
    plc["Main.control.Reset"] = True
    plc.run(TWICE)
    assert counts(plc) == (0, 1)
    plc["Main.control.Reset"] = False
    plc.run(TWICE)
    assert plc["Main.control.CommandDone"] is False
    plc["Main.controlName"] = "Nothing"
    plc["Main.control.Set"] = True
    plc.run("10ms")
    assert (plc["Main.control.Error"], plc["Main.control.StatusID"]) == (True, -1064116212)


def test_the_operator_sees_the_latest_alarm_first_and_acknowledges_what_is_selected(plc):
    do(plc, "doSet", "Door")
    do(plc, "doSet", "Jam")
    plc.run(TWICE)
    line = "Main.screen.AlarmList"
    assert [plc[f"{line}.Name[{n}]"] for n in range(3)] == ["Jam", "Door", ""]
    assert (plc[f"{line}.Message[0]"], plc[f"{line}.Code[0]"]) == ("Jammed", 7)
    assert [plc[f"{line}.StateActive[{n}]"] for n in range(3)] == [True, False, False]
    assert plc[f"{line}.Timestamp[0]"].endswith(":025")
    plc[f"{line}.SelectedIndex"] = 1
    plc["Main.screen.Acknowledge"] = True
    plc.run(TWICE)
    assert (plc[f"{line}.Name[0]"], plc[f"{line}.Name[1]"]) == ("Jam", "")
    assert plc["Main.screen.Acknowledge"] is False


def test_the_list_is_written_where_something_has_changed(plc):
    do(plc, "doSet", "Jam")
    plc["Main.screen.AlarmList.Name[0]"] = "mine"
    plc.run(TWICE)
    assert plc["Main.screen.AlarmList.Name[0]"] == "mine"
    do(plc, "doReset", "Jam")
    assert plc["Main.screen.AlarmList.Name[0]"] == "Jam"


def test_a_component_without_a_link_says_so(filler):
    code = """
        PROGRAM _CYCLIC
            core(Enable := enable);
        END_PROGRAM
    """
    plc = filler(DECLARATIONS, CONFIGURATION, code, "core : MpAlarmXCore; enable : BOOL;")
    plc.run(TWICE)
    assert (plc["Main.core.Error"], plc["Main.core.StatusID"]) == (False, 0)
    plc["Main.enable"] = True
    plc.run(TWICE)
    assert (plc["Main.core.Error"], plc["Main.core.StatusID"]) == (True, -1064239102)
    assert plc["Main.core.Active"] is False


def test_check_names_what_stands_for_the_library(plc):
    texts = [entry.text for entry in plc.controller.logbook]
    assert any("MpAlarmXSet is simulated: the alarms of its core" in text for text in texts)


def test_without_a_configuration_each_link_takes_any_name(filler):
    plc = filler(DECLARATIONS, {}, CODE, VARIABLES, "gAlarms : MpComIdentType;")
    do(plc, "doSet", "Whatever")
    assert counts(plc) == (1, 1)
    do(plc, "doReset", "Whatever")
    assert counts(plc) == (0, 1)
