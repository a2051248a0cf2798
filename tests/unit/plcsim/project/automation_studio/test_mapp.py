from plcsim.project.automation_studio.mapp import read_mapp_variables

ELEMENT = '<Configuration>\n<Element ID="{}" Type="x"/></Configuration>'


def test_elements_of_configurations_are_variables(write):
    folder = write(
        {
            "Cpu/mappServices/Alarms.mpalarmxcore": ELEMENT.format("gAlarm"),
            "Cpu/mappMotion/Deep/X.axis": ELEMENT.format("gAxis"),
            "Cpu/mappMotion/X.axesgroup": ELEMENT.format("gGroup"),
            "Cpu/mappServices/again.mprecipexml": ELEMENT.format("gAlarm"),
            "Cpu/other/X.axis": ELEMENT.format("gOther"),
            "Cpu/mappServices/notes.txt": ELEMENT.format("gNotes"),
            "Cpu/mappServices/broken.mpdatarecorder": "<Conf",
        }
    )
    found, findings = read_mapp_variables(folder)
    assert [(each.name, each.data_type, each.line) for each in found] == [
        ("gGroup", "McAxesGroupType", 2),
        ("gAxis", "McAxisType", 2),
        ("gAlarm", "MpComIdentType", 2),
    ]
    assert [each.file.name for each in findings] == ["broken.mpdatarecorder"]
