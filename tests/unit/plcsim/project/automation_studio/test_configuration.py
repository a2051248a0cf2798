import pytest

from plcsim.project.automation_studio.configuration import Configurations
from plcsim.project.automation_studio.names import FileNames

HARDWARE = (
    '<Hardware><Module Name="C" Type="{}"><Parameter ID="ConfigurationID" Value="x"/></Module>'
    "</Hardware>"
)
SOFTWARE = '<Sw><TaskClass Name="Cyclic#1"><Task Name="a" Source="A"/></TaskClass></Sw>'


def listing(*objects):
    return f"<Package><Objects>{''.join(objects)}</Objects></Package>"


def entry(kind, name, more=""):
    return f'<Object Type="{kind}" {more}>{name}</Object>\n'


FILES = {
    "Physical/Physical.pkg": listing(entry("Configuration", "real"), entry("Configuration", "Sim")),
    "Physical/Real/Config.pkg": listing(entry("File", "Hardware.hw"), entry("Cpu", "CP")),
    "Physical/Real/Hardware.hw": HARDWARE.format("X20CP"),
    "Physical/Real/CP/Cpu.pkg": listing(entry("File", "cpu.SW"), entry("File", "gone.iom")),
    "Physical/Real/CP/Cpu.sw": SOFTWARE,
    "Physical/Sim/Config.pkg": listing(
        entry("File", "\\Physical\\Real\\Hardware.hw", 'Reference="true"'), entry("Cpu", "PC")
    ),
    "Physical/Sim/PC/Cpu.sw": "<Sw/>",
}


def configurations(folder):
    return Configurations(FileNames(folder))


def test_the_files_of_a_configuration(write):
    found = configurations(write(FILES))
    assert list(found.folders) == ["real", "Sim"]
    real = found.read("real")
    assert (real.hardware.cpu_type, [t.name for t in real.software.tasks]) == ("X20CP", ["a"])
    assert [file.name for file in real.files_of_kind(".sw")] == ["Cpu.sw"]
    (finding,) = found.findings
    assert (finding.message, finding.missing) == (
        "File gone.iom is listed and not there",
        "gone.iom",
    )


def test_hardware_of_another_configuration_and_no_list_of_the_cpu(write):
    found = configurations(write(FILES))
    simulation = found.read("Sim")
    assert (simulation.hardware.cpu_type, simulation.software_file.name) == ("X20CP", "Cpu.sw")
    assert found.findings == []


def test_the_cpu_of_another_configuration(write):
    reference = entry("Cpu", "\\Physical\\Real\\CP\\Cpu.pkg", 'Reference="true"')
    found = configurations(write({**FILES, "Physical/Sim/Config.pkg": listing(reference)}))
    assert [task.name for task in found.read("Sim").software.tasks] == ["a"]


def test_the_active_one_is_preferred_then_one_for_simulation_then_the_one_that_runs_most(write):
    folder = write({**FILES, "Physical/Sim/PC/Cpu.sw": SOFTWARE})
    assert configurations(folder).preferred() == "real"
    more = '<Task Name="more" Source="more.prg"/></TaskClass>'
    write({"Physical/Sim/PC/Cpu.sw": SOFTWARE.replace("</TaskClass>", more, 1)})
    assert configurations(folder).preferred() == "Sim"
    write({"Physical/Sim/PC/Cpu.sw": SOFTWARE})
    write({"Physical/Sim/Hardware.hw": HARDWARE.format("PC_any")})
    assert configurations(folder).preferred() == "Sim"
    text = '<P><ConfigurationManager ActiveConfigurationName="{}"/></P>'
    write({"LastUser.set": text.format("real")})
    assert configurations(folder).preferred() == "real"
    write({"LastUser.set": text.format("gone")})
    assert configurations(folder).preferred() == "Sim"
    write({"LastUser.set": "<P"})
    assert configurations(folder).preferred() == "Sim"


def test_one_that_runs_something_is_preferred_to_the_active_one(write):
    folder = write(FILES)
    write({"LastUser.set": '<P><ConfigurationManager ActiveConfigurationName="Sim"/></P>'})
    found = configurations(folder)
    assert (found.active(), found.preferred()) == ("Sim", "real")
    assert found.findings == []
    write({"Physical/Real/CP/Cpu.sw": "<Sw/>"})
    assert configurations(folder).preferred() == "Sim"


@pytest.mark.parametrize(
    ("software", "severity", "message"),
    [
        ("<Sw>", "error", "it is no XML: no element found"),
        (None, "warning", "the active configuration has no Cpu.sw, and so no task"),
    ],
)
def test_why_the_active_one_does_not_run_is_told(write, software, severity, message):
    folder = write(FILES)
    write({"LastUser.set": '<P><ConfigurationManager ActiveConfigurationName="Sim"/></P>'})
    file = folder / "Physical/Sim/PC/Cpu.sw"
    if software is None:
        file.unlink()
    else:
        file.write_text(software)
    found = configurations(folder)
    assert found.preferred() == "real"
    assert [(each.severity, each.message) for each in found.findings] == [(severity, message)]


def test_a_broken_last_user_is_a_warning_where_it_would_choose(write):
    folder = write({**FILES, "LastUser.set": "<P"})
    found = configurations(folder)
    assert found.preferred() == "real"
    (finding,) = found.findings
    assert (finding.severity, finding.location) == ("warning", f"{folder}/LastUser.set:1")
    (found := configurations(folder)).read("Sim")
    assert found.findings == []


def test_a_project_saved_half(write):
    found = configurations(write({"Physical/A/notes.txt": ""}))
    assert list(found.folders) == ["A"]
    found.read("A")
    assert [each.message for each in found.findings] == [
        "there is no Physical.pkg: every folder here is taken for a configuration",
        "there is no Hardware.hw",
        "there is no Cpu.sw",
    ]


def test_no_physical_view(write):
    found = configurations(write({"x": ""}))
    assert (found.preferred(), [each.message for each in found.findings]) == (
        None,
        ["there is no folder Physical"],
    )


def test_how_c_is_built(bottling):
    build = configurations(bottling).read("Machine").build
    assert (build.gcc_version, build.options) == ("6.3.0", "-D BOTTLING")
    assert [folder.name for folder in build.include_folders] == ["Docs"]
