from pathlib import Path

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError
from plcsim.project.assembly import runnable
from plcsim.project.plc_toml import read_project
from plcsim.project.survey import survey

BOTTLING = Path(__file__).parents[3] / "data" / "automation_studio" / "Bottling"


@pytest.fixture
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


@pytest.fixture
def surveyed():
    """``surveyed(folder, configuration)``: the survey of a project."""

    def surveyed(folder=BOTTLING, configuration=""):
        project = read_project(folder, {"as": {"config": configuration}})
        return survey(project, project.automation_studio)

    return surveyed


@pytest.mark.usefixtures("_a_compiler")
def test_tasks_that_run_and_what_is_idle_in_them(surveyed):
    found = surveyed()
    rows = {row.entry.name: row for row in found.rows}
    assert [name for name, row in rows.items() if row.reasons] == []
    assert (rows["ValveA"].languages, rows["ValveA"].bytes) == (("ST",), 6)
    (call,) = rows["FillStatio"].stubs
    assert (call.library, call.name, call.times) == ("MpAlarm", "MpAlarmCore", 1)
    assert call.location.endswith("FillStation/Variables.var:6")
    assert found.skipped == ("Panel",)
    assert found.is_right


def test_a_task_that_cannot_run_and_why(surveyed):
    found = surveyed(configuration="Simulation")
    panel = found.rows[-1]
    (reason,) = panel.reasons
    assert "Panel/Main.ld:5:8: error ST1001: network 1: element <lamp> is not known" in reason
    assert panel.languages == ("Ladder",)
    assert not found.is_right


def test_everything_that_is_wrong_is_told_by_task(surveyed, write_project):
    folder = write_project(
        {
            "Logical/Package.pkg": [
                "Program:Good",
                "Program:Bad",
                "Program:Half",
                "File:Global.var",
            ],
            "Logical/Global.var": "VAR g : Nothing; END_VAR",
            "Logical/Good/IEC.prg": ["File:Main.st"],
            "Logical/Good/Main.st": "PROGRAM _CYCLIC\nEND_PROGRAM",
            "Logical/Bad/IEC.prg": ["File:Main.st"],
            "Logical/Bad/Main.st": "PROGRAM _CYCLIC\nx := 1;\ny := 2;\nEND_PROGRAM",
            "Logical/Half/IEC.prg": ["File:Main.st", "File:Gone.st", "File:Notes.pdf"],
            "Logical/Half/Main.st": "PROGRAM _CYCLIC\nEND_PROGRAM",
        },
        ["Good", "Bad", "Half", "Nowhere"],
    )
    found = surveyed(folder)
    reasons = {row.entry.name: [r.splitlines()[0] for r in row.reasons] for row in found.rows}
    texts = {
        name: [reason.replace(f"{folder}/", "") for reason in each]
        for name, each in reasons.items()
    }
    assert texts == {
        "Good": [],
        "Bad": [
            "Logical/Bad/Main.st:2:1: error ST2001: no variable is called x",
            "Logical/Bad/Main.st:3:1: error ST2001: no variable is called y",
        ],
        "Half": ["Logical/Half/IEC.prg:3: error: File Gone.st is listed and not there"],
        "Nowhere": [
            "Physical/C/CP/Cpu.sw:4: error: the logical view has no program Nowhere",
        ],
    }
    (common,) = found.common
    assert "Global.var:1:9: error: no type is called Nothing" in common


def test_nothing_that_can_run(surveyed, write_project):
    found = surveyed(write_project({"Logical/Package.pkg": []}, ["Nowhere"]))
    assert (found.controller, found.is_right) == (None, False)


@pytest.mark.usefixtures("_a_compiler")
def test_a_program_that_calls_what_is_nowhere_is_left_out(surveyed, write_project):
    c = "#include <AsDefault.h>\nvoid gone(void);\nvoid _CYCLIC c(void) { gone(); }\n"
    folder = write_project(
        {
            "Logical/Package.pkg": ["Program:Good", "Program:Bad"],
            "Logical/Good/IEC.prg": ["File:Main.st"],
            "Logical/Good/Main.st": "PROGRAM _CYCLIC\nEND_PROGRAM",
            "Logical/Bad/ANSIC.prg": ["File:Main.c"],
            "Logical/Bad/Main.c": c,
        },
        ["Good", "Bad"],
    )
    good, bad = surveyed(folder).rows
    reason = f"{folder}/Logical/Bad/Main.c:3: Bad uses function gone, which is nowhere"
    assert (good.reasons, bad.reasons) == ((), (reason,))
    left = runnable(read_project(folder))
    assert left.left_out == (f"Bad is left out: {reason}",)
    assert [entry.name for entry in left.programs] == ["Good"]


@pytest.mark.usefixtures("_a_compiler")
def test_a_library_that_does_not_compile_is_told_and_its_callers(surveyed, write_project):
    folder = write_project(
        {
            "Logical/Package.pkg": ["Program:Good", "Program:Bad", "Library:Lib"],
            "Logical/Lib/ANSIC.lby": ["File:Lib.fun", "File:Lib.c"],
            "Logical/Lib/Lib.fun": "FUNCTION_BLOCK Broken END_FUNCTION_BLOCK",
            "Logical/Lib/Lib.c": "this is no C;\n",
            "Logical/Good/IEC.prg": ["File:Main.st"],
            "Logical/Good/Main.st": "PROGRAM _CYCLIC\nEND_PROGRAM",
            "Logical/Bad/IEC.prg": ["File:Main.st", "File:Local.var"],
            "Logical/Bad/Local.var": "VAR block : Broken; END_VAR",
            "Logical/Bad/Main.st": "PROGRAM _CYCLIC\nblock();\nEND_PROGRAM",
        },
        ["Good", "Bad"],
    )
    found = surveyed(folder)
    good, bad = found.rows
    assert good.reasons == ()
    assert bad.reasons
    assert any("Logical/Lib/Lib.c:1" in text for text in found.common)


def test_what_maps_and_plc_toml_name_and_is_not_there_is_told(surveyed, write_project):
    folder = write_project(
        {
            "Logical/Package.pkg": ["Program:Good"],
            "Logical/Good/IEC.prg": ["File:Main.st"],
            "Logical/Good/Main.st": "PROGRAM _CYCLIC\nEND_PROGRAM",
            "Physical/C/CP/Cpu.pkg": ["File:Cpu.sw", "File:IoMap.iom"],
            "Physical/C/CP/IoMap.iom": 'VAR_CONFIG\n::gone AT %IX."M".C;\nEND_VAR',
            "plc.toml": '[operator.inputs]\n"IoMap.M.D" = true\n',
        },
        ["Good"],
    )
    found = surveyed(folder)
    (text,) = found.unmapped
    assert text.endswith('IoMap.iom:2: warning: there is no variable gone for %IX."M".C')
    (text,) = found.settings
    assert "operator.inputs: no tag 'IoMap.M.D': M has no member D" in text
    assert not found.is_right
    (folder / "plc.toml").write_text('[operator.inputs]\n"IoMap.M.C" = true\n')
    found = surveyed(folder)
    assert (found.settings, found.is_right) == ((), True)


COVERAGE = '#ifdef __cplusplus\nextern "C" {\n#endif\nint CovSave(const char *path, double x);\n'


@pytest.mark.usefixtures("_a_compiler")
def test_functions_of_c_that_only_compiled_code_holds_are_stubs(surveyed, write_project):
    main = '#include <AsDefault.h>\n#include "{}.h"\nvoid _CYCLIC run(void)\n{{\n\tsaved = {}\n}}\n'
    folder = write_project(
        {
            "Logical/Package.pkg": ["Library:Cov", "Program:Good", "Program:Own", "Program:Bad"],
            "Logical/Cov/ANSIC.lby": "<Library><Files><File>Cov.h</File></Files></Library>",
            "Logical/Cov/Cov.h": COVERAGE + "#ifdef __cplusplus\n}\n#endif\n",
            "Logical/Cov/SG4/cov.o": "",
            "Logical/Good/ANSIC.prg": ["File:Main.c", "File:V.var"],
            "Logical/Good/V.var": "VAR saved : DINT := 5; END_VAR",
            "Logical/Good/Main.c": main.format("Cov", 'CovSave("C:", 1) + CovSave("", 2);'),
            "Logical/Own/ANSIC.prg": ["File:Main.c", "File:V.var", "File:own.h"],
            "Logical/Own/V.var": "VAR saved : DINT := 5; END_VAR",
            "Logical/Own/own.h": "long long OwnRead(float x);\n",
            "Logical/Own/libown.a": "",
            "Logical/Own/Main.c": main.format("own", "OwnRead(1);"),
            "Logical/Bad/ANSIC.prg": ["File:Main.c", "File:V.var"],
            "Logical/Bad/V.var": "VAR saved : DINT; END_VAR",
            "Logical/Bad/Main.c": main.format("Cov", "CovLoad();"),
        },
        ["Good", "Own", "Bad"],
    )
    found = surveyed(folder)
    rows = {row.entry.name: row for row in found.rows}
    assert [name for name, row in rows.items() if row.reasons] == ["Bad"]
    (reason,) = rows["Bad"].reasons
    assert reason.endswith("Bad/Main.c:5: Bad uses function CovLoad, which is nowhere")
    (call,) = rows["Good"].stubs
    assert call[:3] == ("Cov", "CovSave", "Good")
    assert (call.location, call.times) == (f"{folder}/Logical/Good/Main.c:5", 2)
    assert [stub[:2] for stub in rows["Own"].stubs] == [("Own", "OwnRead")]
    controller = found.controller
    controller.boot()
    controller.run(cycles=3)
    tags = controller.tags
    assert [tags.read(tags.find(f"{name}.saved")) for name in ("Good", "Own")] == [0, 0]
