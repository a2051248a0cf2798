"""MpPackML: a machine goes through the states of PackML."""

import pytest

from plcsim.library.mapp.packml import COMMANDS, COMPLETED, PackMlMachine, PackMlState

S = PackMlState

_COMMANDS = [*COMMANDS, "StateComplete"]
_LINES = "\n".join(f"{name} : BOOL;" for name in _COMMANDS)
DECLARATIONS = {
    "MpPackML": {
        "MpPackML.typ": f"""
TYPE
    MpPackMLStateEnum : (mpPACKML_STATE_UNDEFINED := 0, mpPACKML_STATE_CLEARING := 1,
        mpPACKML_STATE_STOPPED := 2, mpPACKML_STATE_STARTING := 3, mpPACKML_STATE_IDLE := 4,
        mpPACKML_STATE_EXECUTE := 6, mpPACKML_STATE_ACTIVATING := 32);
    MpPackMLModuleCommandType : STRUCT
        {_LINES}
    END_STRUCT;
    MpPackMLModuleInfoType : STRUCT
        StateCurrent : STRING[20];
    END_STRUCT;
END_TYPE
""",
        "MpPackML.fun": f"""
FUNCTION_BLOCK MpPackMLCore
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        ModeCurrent : DINT;
        StateCurrent : MpPackMLStateEnum;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK MpPackMLMode
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        ModeID : DINT;
        Activate : BOOL;
        {_LINES}
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        ChangeModeAllowed : BOOL;
        ModeActive : BOOL;
        StateCurrent : MpPackMLStateEnum;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK MpPackMLModule
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        Command : MpPackMLModuleCommandType;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        StateCurrent : MpPackMLStateEnum;
        Info : MpPackMLModuleInfoType;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION MpPackMLStateIsActive : BOOL
    VAR_INPUT
        MpLink : MpComIdentType;
        State : MpPackMLStateEnum;
        Mode : DINT;
    END_VAR
END_FUNCTION
FUNCTION MpPackMLModeIsActive : BOOL
    VAR_INPUT
        MpLink : MpComIdentType;
        Mode : DINT;
    END_VAR
END_FUNCTION
FUNCTION MpPackMLAbort : BOOL
    VAR_INPUT
        MpLink : MpComIdentType;
        Mode : DINT;
    END_VAR
END_FUNCTION
FUNCTION MpPackMLChangeMode : DINT
    VAR_INPUT
        MpLink : MpComIdentType;
        ModeID : DINT;
    END_VAR
END_FUNCTION
""",
    }
}
CODE = """
    PROGRAM _CYCLIC
        core(MpLink := ADR(gCore), Enable := TRUE);
        auto(MpLink := ADR(gAuto), Enable := TRUE, ModeID := 1);
        manual(MpLink := ADR(gManual), Enable := TRUE, ModeID := 3);
        part(MpLink := ADR(gPart), Enable := TRUE);
        isIdle := MpPackMLStateIsActive(gCore, mpPACKML_STATE_IDLE, 1);
        isManual := MpPackMLModeIsActive(gCore, 3);
        IF doAbort THEN doAbort := FALSE; aborted := MpPackMLAbort(gCore, 1); END_IF
        IF doChange THEN doChange := FALSE; result := MpPackMLChangeMode(gCore, 3); END_IF
    END_PROGRAM
"""
VARIABLES = """
    core : MpPackMLCore;
    auto, manual : MpPackMLMode;
    part : MpPackMLModule;
    isIdle, isManual, doAbort, aborted, doChange : BOOL;
    result : DINT;
"""


@pytest.fixture
def plc(filler):
    links = "gCore, gAuto, gManual, gPart : MpComIdentType;"
    return filler(DECLARATIONS, {}, CODE, VARIABLES, links)


def give(plc, *names, block="Main.auto"):
    for name in names:
        plc[f"{block}.{name}"] = True
        plc.run("10ms")
        plc[f"{block}.{name}"] = False
    plc.run("10ms")
    return plc[f"{block}.StateCurrent"]


def test_no_mode_no_state(plc):
    plc.run("20ms")
    assert (plc["Main.auto.Active"], plc["Main.auto.ModeActive"]) == (True, False)
    assert (plc["Main.core.StateCurrent"], give(plc, "Reset")) == (0, 0)


def test_a_mode_goes_through_its_states(plc):
    assert give(plc, "Activate") == S.STOPPED
    assert (plc["Main.core.ModeCurrent"], plc["Main.core.StateCurrent"]) == (1, S.STOPPED)
    assert give(plc, "Start") == S.STOPPED
    assert give(plc, "Reset") == S.RESETTING
    assert give(plc, "StateComplete") == S.IDLE
    assert plc["Main.isIdle"] is True
    assert give(plc, "Start", "StateComplete") == S.EXECUTE
    assert give(plc, "Hold", "StateComplete", "Unhold", "StateComplete") == S.EXECUTE
    assert give(plc, "StateComplete", "StateComplete") == S.COMPLETE
    assert give(plc, "Reset", "StateComplete", "Stop") == S.STOPPING


def test_the_mode_changes_in_states_that_wait_only(plc):
    give(plc, "Activate", "Reset")
    give(plc, "Activate", block="Main.manual")
    assert (plc["Main.manual.ModeActive"], plc["Main.auto.ModeActive"]) == (False, True)
    plc["Main.doChange"] = True
    plc.run("20ms")
    assert plc["Main.result"] == 1
    give(plc, "StateComplete")
    assert plc["Main.auto.ChangeModeAllowed"] is True
    assert give(plc, "Activate", block="Main.manual") == S.IDLE
    assert (plc["Main.isManual"], plc["Main.auto.StateCurrent"]) == (True, 0)


def test_abort_by_a_function_and_clear(plc):
    give(plc, "Activate")
    plc["Main.doAbort"] = True
    plc.run("20ms")
    assert (plc["Main.aborted"], plc["Main.core.StateCurrent"]) == (True, S.ABORTING)
    assert give(plc, "StateComplete", "Clear", "StateComplete") == S.STOPPED


def test_a_module_has_a_machine_of_its_own(plc):
    plc.run("20ms")
    assert plc["Main.part.StateCurrent"] == S.ACTIVATING
    plc["Main.part.Command.StateComplete"] = True
    plc.run("20ms")
    assert (plc["Main.part.StateCurrent"], plc["Main.core.StateCurrent"]) == (S.STOPPED, 0)
    assert plc["Main.part.Info.StateCurrent"] == "Stopped"


@pytest.mark.parametrize("state", [*S])
def test_every_state_leads_to_execute_and_to_a_stop(state):
    """No state but those before a module is there, or after, is a dead end."""
    if state in (S.UNDEFINED, S.DEACTIVATED, S.DEACTIVATING):
        return
    found, new = {state}, {state}
    while new:
        nexts = {COMPLETED[each] for each in new if each in COMPLETED}
        nexts |= {target for takes, target in COMMANDS.values() if takes & new}
        new = nexts - found
        found |= new
    assert {S.EXECUTE, S.STOPPED, S.ABORTED} <= found


def test_the_machine_refuses_what_its_state_does_not_take():
    machine = PackMlMachine(S.ABORTED)
    assert [name for name in COMMANDS if PackMlMachine(S.ABORTED).command(name)] == ["Clear"]
    assert (machine.complete(), machine.command("Abort"), machine.state) == (
        False,
        False,
        S.ABORTED,
    )
