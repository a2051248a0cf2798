import shutil

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.project.automation_studio.reader import read_automation_studio


def test_everything_that_a_project_says(bottling):
    found = read_automation_studio(bottling)
    assert (found.name, found.configuration.name) == ("Bottling", "Machine")
    assert found.configurations == ("Simulation", "Machine")
    assert [(each.name, each.task_class, each.source) for each in found.tasks] == [
        ("Clock", 1, "Clock"),
        ("FillStatio", 2, "line.Filler.Station.FillStation"),
        ("ValveA", 2, "Line.Valves.Valve"),
        ("ValveB", 2, "Line.Valves.Valve"),
        ("Boiler", 2, "Plant.Boiler"),
        ("Motor", 2, "Plant.Motor"),
        ("Mixer", 2, "Plant.Mixer"),
        ("Washer", 2, "Plant.Washer"),
        ("Sorter", 2, "Plant.Sorter"),
        ("Count", 4, "Line.Valves.Count"),
    ]
    assert [(each.name, each.data_type) for each in found.mapp_variables] == [
        ("gAlarmCore", "MpComIdentType")
    ]
    assert (len(found.maps.channels), len(found.maps.copies), len(found.maps.permanent)) == (
        5,
        2,
        1,
    )
    assert [each.missing for each in found.findings] == ["Manual.pdf"]
    station = found.tasks[1].program
    assert [file.name for file in station.files] == [
        *("Init.st", "Cyclic.st", "Variables.var", "Fill.st", "Cap.st", "Exit.st")
    ]
    libraries = {each.name: each for each in found.view.libraries}
    assert [name for name, each in libraries.items() if each.is_binary] == [
        *("standard", "MpBase", "MpAlarm")
    ]
    assert [each.name for each in libraries["MpAlarm"].dependencies] == ["MPBASE"]
    assert libraries["Sums"].folder.parts[-2:] == ("shared", "Sums")


def test_a_configuration_by_name_in_any_case(bottling):
    found = read_automation_studio(bottling, "simulation")
    assert found.configuration.name == "Simulation"
    assert [task.name for task in found.tasks][-1] == "Panel"
    with pytest.raises(ConfigurationError, match="no configuration Simulaton; did you mean Simu"):
        read_automation_studio(bottling, "Simulaton")


def test_what_is_no_project(write):
    folder = write({"notes.txt": ""})
    with pytest.raises(ConfigurationError, match="there is no project file"):
        read_automation_studio(folder)
    write({"x.APJ": "<Project/>"})
    with pytest.raises(ConfigurationError, match="there is no folder Logical"):
        read_automation_studio(folder)


def test_without_a_configuration_all_programs_run(write):
    program = '<Object Type="Program">{}</Object>'.format
    package = '<Object Type="Package">Inner</Object>'
    folder = write(
        {
            "LOGICAL/Package.pkg": f"<P>{program('Main')}{package}{program('Other')}</P>",
            "LOGICAL/Inner/Package.pkg": f"<P>{program('Main')}</P>",
            "LOGICAL/Main/IEC.prg": "<P/>",
            "LOGICAL/Other/IEC.prg": "<P/>",
            "LOGICAL/Inner/Main/IEC.prg": "<P/>",
        }
    )
    found = read_automation_studio(folder)
    assert found.name == folder.name
    assert [(each.name, each.source, each.task_class) for each in found.tasks] == [
        ("Main", "Main", 4),
        ("Other", "Other", 4),
        ("Main1", "Inner.Main", 4),
    ]
    assert [(each.severity, each.message) for each in found.findings] == [
        ("warning", "there is no configuration: all programs run in Cyclic#4")
    ]
    with pytest.raises(ConfigurationError, match="there is no configuration Real"):
        read_automation_studio(folder, "Real")


def test_links_that_nothing_declares_are_assumed_where_there_is_no_configuration(write):
    files = {
        "Logical/Package.pkg": '<P><Object Type="Program">Main</Object></P>',
        "Logical/Main/IEC.prg": "<P/>",
        "Logical/Main/Main.st": USES,
        "Logical/Main/Main.var": "VAR declared : INT; END_VAR",
    }
    found = read_automation_studio(write(files))
    assert [(each.name, each.data_type, each.line) for each in found.mapp_variables] == [
        ("gCore", "MpComIdentType", 2),
        ("gRecipe", "MpComIdentType", 3),
        ("gAlarms", "MpComIdentType", 4),
    ]
    _, told = found.findings
    assert (told.file.name, told.line, told.severity) == ("Main.st", 2, "warning")
    assert told.message.startswith("gCore and 2 more are declared nowhere")


def test_where_a_configuration_is_nothing_is_assumed(bottling, tmp_path):
    copy = shutil.copytree(bottling, tmp_path / "Bottling")
    (copy / "Logical" / "more.st").write_text(USES)
    found = read_automation_studio(copy)
    assert [each.name for each in found.mapp_variables] == ["gAlarmCore"]


USES = """(* gComment := ADR(gComment); *)
a.MpLink := ADR( gCore ); b.MpLink := ADR(gcore); c := ADR(declared);
d := MpAlarmXCheckReaction(MpLink := gRecipe, Name := 'Stop'); // ADR(gLine)
MpAlarmXSet(gAlarms, 'Hot'); e := ADR(gRead); f := gRead; g := ADR(gMember); gMember.x := 1;
h.MpLink := other.link; i := ADR(gArray[1]);
"""


def test_all_that_is_wrong_is_found_in_one_go(write):
    sw = '<Sw><TaskClass Name="Cyclic#1">\n<Task Name="a" Source="A.prg"/></TaskClass></Sw>'
    folder = write(
        {
            "x.apj": "<Project",
            "Logical/Package.pkg": "<Package>\n<Objects>",
            "Physical/Physical.pkg": '<P><Object Type="Configuration">C</Object></P>',
            "Physical/C/CP/Cpu.sw": sw,
            "Physical/C/CP/IoMap.iom": "VAR_CONFIG\nnonsense;\nEND_VAR",
            "Physical/C/CP/mappView/a.mpx": "<",
            "Physical/C/Hardware.hw": "<Hardware/>",
        }
    )
    found = read_automation_studio(folder)
    places = [str(each.location).replace(f"{folder}/", "") for each in found.findings]
    assert places == [
        "x.apj:1",
        "Logical/Package.pkg:2",
        "Physical/C/Hardware.hw:1",
        "Physical/C/CP/Cpu.sw:2",
        "Physical/C/CP/mappView/a.mpx:1",
        "Physical/C/CP/IoMap.iom:2",
    ]
    assert found.tasks[0].program is None
