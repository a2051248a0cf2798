from plcsim.project.automation_studio.mapp import read_mapp_variables
from plcsim.project.automation_studio.names import FileNames

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
    found, findings = read_mapp_variables(folder, FileNames(folder))
    assert [(each.name, each.data_type, each.line) for each in found] == [
        ("gGroup", "McAxesGroupType", 2),
        ("gAxis", "McAxisType", 2),
        ("gAlarm", "MpComIdentType", 2),
    ]
    assert [each.file.name for each in findings] == ["broken.mpdatarecorder"]


def test_every_kind_of_axis_is_one(write):
    folder = write({f"Cpu/mappMotion/x.{kind}": ELEMENT.format(kind) for kind in KINDS})
    found, _ = read_mapp_variables(folder, FileNames(folder))
    assert {each.name: each.data_type for each in found} == dict.fromkeys(KINDS, "McAxisType")


KINDS = ("axis", "purevaxis", "extencaxis", "stpaxis")


def test_files_of_another_configuration_are_there_by_reference(write):
    folder = write(
        {
            "Physical/One/Cpu/mappMotion/X.axis": ELEMENT.format("gAxis"),
            "Physical/One/Cpu/mappServices/A.mpalarmxcore": ELEMENT.format("gAlarm"),
            "Physical/One/Cpu/mappServices/B.mprecipexml": ELEMENT.format("gRecipe"),
            "Physical/Two/Cpu/mappMotion/Package.pkg": LIST.format(
                "File", r"\Physical\One\Cpu\mappMotion\x.axis"
            ),
            "Physical/Two/Cpu/Cpu.pkg": LIST.format(
                "Package", r"\Physical\One\Cpu\mappServices\Package.pkg"
            ),
            "Physical/One/Cpu/mappServices/Package.pkg": LIST.format("Package", "..\\.."),
        }
    )
    found, findings = read_mapp_variables(folder / "Physical/Two", FileNames(folder))
    assert {each.name for each in found} == {"gAxis", "gAlarm", "gRecipe"}
    assert findings == []


def test_what_is_not_there_and_a_broken_list_make_nothing(write):
    folder = write(
        {
            "Cpu/Cpu.pkg": "<Cpu",
            "Cpu/mappMotion/Package.pkg": LIST.format("File", r"\Elsewhere\X.axis"),
        }
    )
    assert read_mapp_variables(folder, FileNames(folder)) == ([], [])


LIST = '<Package><Objects><Object Type="{}" Reference="true">{}</Object></Objects></Package>'
