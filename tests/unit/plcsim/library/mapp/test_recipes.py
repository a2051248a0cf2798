"""MpRecipe: variables that are registered, saved to files and loaded from them."""

import pytest

FUN = """
FUNCTION_BLOCK MpRecipeRegPar
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        ErrorReset : BOOL;
        PVName : REFERENCE TO STRING[100];
        Category : REFERENCE TO STRING[50];
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        Error : BOOL;
        StatusID : DINT;
        UpdateNotification : BOOL;
    END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK MpRecipeUI
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        UIConnect : REFERENCE TO MpRecipeUIConnectType;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        Error : BOOL;
        StatusID : DINT;
    END_VAR
END_FUNCTION_BLOCK
"""
FILE_BLOCK = """
FUNCTION_BLOCK {name}
    VAR_INPUT
        MpLink : REFERENCE TO MpComIdentType;
        Enable : BOOL;
        ErrorReset : BOOL;
        DeviceName : REFERENCE TO STRING[50];
        FileName : REFERENCE TO STRING[255];
        Header : REFERENCE TO MpRecipeXmlHeaderType;
        Category : REFERENCE TO STRING[50];
        Load : BOOL;
        Save : BOOL;
        UpdateNotification : BOOL;
    END_VAR
    VAR_OUTPUT
        Active : BOOL;
        Error : BOOL;
        StatusID : DINT;
        CommandBusy : BOOL;
        CommandDone : BOOL;
    END_VAR
END_FUNCTION_BLOCK
"""
DECLARATIONS = {
    "MpRecipe": {
        "MpRecipe.typ": """
TYPE
    MpRecipeXmlHeaderType : STRUCT
        Name : STRING[100];
        Version : STRING[20];
        DateTime : DATE_AND_TIME;
    END_STRUCT;
    MpRecipeUIStatusEnum : (mpRECIPE_UI_STATUS_IDLE := 0, mpRECIPE_UI_STATUS_LOAD := 1,
        mpRECIPE_UI_STATUS_SAVE := 2, mpRECIPE_UI_STATUS_ERROR := 99);
    MpRecipeUIRecipeListType : STRUCT
        Names : ARRAY[0..1] OF STRING[255];
        SelectedIndex : UINT;
        MaxSelection : UINT;
    END_STRUCT;
    MpRecipeUIRecipeType : STRUCT
        List : MpRecipeUIRecipeListType;
        Load : BOOL;
        Save : BOOL;
        Delete : BOOL;
        Refresh : BOOL;
    END_STRUCT;
    MpRecipeUINewType : STRUCT
        FileName : STRING[255];
        Create : BOOL;
    END_STRUCT;
    MpRecipeUIConnectType : STRUCT
        Status : MpRecipeUIStatusEnum;
        Recipe : MpRecipeUIRecipeType;
        New : MpRecipeUINewType;
    END_STRUCT;
END_TYPE
""",
        "MpRecipe.fun": FUN
        + FILE_BLOCK.format(name="MpRecipeXml")
        + FILE_BLOCK.format(name="MpRecipeCsv"),
    }
}
CONFIGURATION = {
    "Physical/PC/CPU/mappServices/R.mprecipexml": '<Configuration><Element ID="gRecipe" '
    'Type="mprecipexml" /></Configuration>',
    "Logical/Main/Main.typ": """
TYPE
    Steps : STRUCT
        speed : REAL;
        times : ARRAY[1..2] OF TIME;
        name : STRING[20];
        isFast : BOOL;
        color : Color;
    END_STRUCT;
    Color : (RED, BLUE := 7);
END_TYPE
""",
    "Logical/Main/IEC.prg": "<Program><Files><File>Main.st</File><File>Main.typ</File>"
    "<File>Main.var</File></Files></Program>",
}
CODE = """
    PROGRAM _CYCLIC
        steps(MpLink := ADR(gRecipe), Enable := TRUE, PVName := ADR('recipe'));
        other(MpLink := ADR(gRecipe), Enable := TRUE, PVName := ADR(otherName));
        file.MpLink := ADR(gRecipe);
        file.DeviceName := ADR(device);
        file.FileName := ADR('first.rec');
        file.Header := ADR(head);
        file(Enable := TRUE);
        IF file.CommandBusy THEN busy := busy + 1; END_IF
        IF steps.UpdateNotification THEN updates := updates + 1; END_IF
        screen(MpLink := ADR(gRecipe), Enable := TRUE, UIConnect := ADR(panel));
        seen := seen OR (panel.Status = mpRECIPE_UI_STATUS_LOAD);
    END_PROGRAM
"""
VARIABLES = """
    steps, other : MpRecipeRegPar;
    file : {block};
    screen : MpRecipeUI;
    panel : MpRecipeUIConnectType;
    head : MpRecipeXmlHeaderType;
    recipe : Steps;
    device : STRING[20] := 'USER';
    otherName : STRING[40] := '::gCount';
    busy, updates : UDINT;
    seen : BOOL;
"""


@pytest.fixture(params=["MpRecipeXml", "MpRecipeCsv"])
def plc(filler, request):
    variables = VARIABLES.format(block=request.param)
    plc = filler(DECLARATIONS, CONFIGURATION, CODE, variables, "gCount : DINT;")
    plc.run("20ms")
    return plc


def command(plc, name):
    plc[f"Main.file.{name}"] = True
    plc.run("30ms")
    outcome = plc["Main.file.CommandDone"], plc["Main.file.Error"]
    plc[f"Main.file.{name}"] = False
    plc.run("10ms")
    return outcome


VALUES = {
    "Main.recipe.speed": 1.25,
    "Main.recipe.times[2]": 90,
    "Main.recipe.name": 'a <"ö">; b',
    "Main.recipe.isFast": True,
    "Main.recipe.color": 7,
    "Main.head.Name": "First",
    "gCount": -5,
}


def test_what_was_saved_comes_back(plc):
    for path, value in VALUES.items():
        plc[path] = value
    plc.run("10ms")
    assert command(plc, "Save") == (True, False)
    assert plc["Main.busy"] == 1
    assert plc["Main.file.CommandDone"] is False
    for path, value in VALUES.items():
        plc[path] = type(value)()
    plc.run("10ms")
    assert (plc["gCount"], plc["Main.updates"]) == (0, 0)
    assert command(plc, "Load") == (True, False)
    assert {path: plc[path] for path in VALUES} == VALUES
    assert plc["Main.updates"] == 1


def test_a_file_that_is_not_there_is_an_error_until_it_is_reset(plc):
    plc["gCount"] = 3
    assert command(plc, "Load") == (False, True)
    assert plc["Main.file.StatusID"] == -1064140798
    assert command(plc, "Save") == (False, True)
    plc["Main.file.ErrorReset"] = True
    plc.run("10ms")
    plc["Main.file.ErrorReset"] = False
    plc.run("10ms")
    assert plc["Main.file.Error"] is False
    assert command(plc, "Save") == (True, False)
    assert plc["gCount"] == 3


def test_a_file_that_is_broken_changes_nothing(plc, tmp_path):
    assert command(plc, "Save") == (True, False)
    file = next(tmp_path.rglob("first.rec"))
    plc["gCount"] = 3
    plc.run("10ms")
    file.write_bytes(b"<DATA><Element")
    assert command(plc, "Load") == (False, True)
    assert plc["gCount"] == 3


def test_a_device_that_is_not_there(plc):
    plc["Main.device"] = "NOWHERE"
    plc.run("10ms")
    assert command(plc, "Save") == (False, True)
    assert plc["Main.file.StatusID"] == -1064140797


def test_a_variable_that_is_not_there(plc):
    plc["Main.otherName"] = "Main:nothing"
    plc.run("20ms")
    assert (plc["Main.other.Error"], plc["Main.other.StatusID"]) == (True, -1064140786)
    assert plc["Main.other.Active"] is False


def test_the_operator_sees_files_and_loads_the_selected_one(plc):
    plc["gCount"] = 4
    plc.run("10ms")
    command(plc, "Save")
    plc["Main.panel.New.FileName"] = "empty.rec"
    plc["Main.panel.New.Create"] = True
    plc["gCount"] = 9
    plc.run("20ms")
    names = [plc[f"Main.panel.Recipe.List.Names[{n}]"] for n in range(2)]
    assert names == ["empty.rec", "first.rec"]
    plc["Main.panel.Recipe.List.SelectedIndex"] = 1
    plc["Main.panel.Recipe.Load"] = True
    plc.run("20ms")
    assert (plc["gCount"], plc["Main.seen"]) == (4, True)
    plc["Main.panel.Recipe.List.SelectedIndex"] = 0
    plc["Main.panel.Recipe.Delete"] = True
    plc.run("20ms")
    assert plc["Main.panel.Recipe.List.Names[0]"] == "first.rec"


def test_files_of_others_are_listed_when_they_are_asked_for(plc, tmp_path):
    command(plc, "Save")
    file = next(tmp_path.rglob("first.rec"))
    (file.parent / "another.rec").write_bytes(file.read_bytes())
    plc.run("50ms")
    assert plc["Main.panel.Recipe.List.Names[0]"] == "first.rec"
    plc["Main.panel.Recipe.Refresh"] = True
    plc.run("20ms")
    assert plc["Main.panel.Recipe.List.Names[0]"] == "another.rec"
