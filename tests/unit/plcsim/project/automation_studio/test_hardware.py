import pytest

from plcsim.project.automation_studio.hardware import ClassTimes, read_hardware

CPU = (
    '<Hardware><Module Name="IO" Type="X20DI"/>\n<Module Name="CPU" Type="{type}">\n{inside}'
    "</Module></Hardware>"
)


def parameter(name, value):
    return f'<Parameter ID="{name}" Value="{value}" />\n'


def hardware(write, values, cpu_type="X20CP1586"):
    inside = "".join(parameter(*item) for item in values.items())
    text = CPU.format(type=cpu_type, inside=inside)
    return read_hardware(write({"Hardware.hw": text}) / "Hardware.hw")


def test_times_are_microseconds_and_what_is_not_there_is_none(write):
    values = {"ConfigurationID": "x", "SystemTick": "400", "Cyclic1Duration": "800"}
    values |= {"Cyclic1Tolerance": "0", "Cyclic4Duration": "100000"}
    found, findings = hardware(write, values)
    assert findings == []
    assert (found.cpu_type, found.tick_ns, found.is_simulation) == ("X20CP1586", 400_000, False)
    assert found.times(1) == ClassTimes(800_000, 0)
    assert found.times(4) == ClassTimes(100_000_000, None)
    assert found.times(8) == ClassTimes()
    assert found.modules == {"IO": "X20DI", "CPU": "X20CP1586"}


def test_file_devices_and_simulation(write):
    values = {"ConfigurationID": "x", "FileDeviceName1": "USER", "FileDevicePath1": "F:\\USER"}
    found, _ = hardware(write, values | {"Simulation": "1"})
    assert found.file_devices == {"USER": "F:\\USER"}
    assert found.is_simulation
    assert hardware(write, values, "PC_any")[0].is_simulation


def test_parameters_of_connectors_are_not_those_of_the_cpu(write):
    inside = parameter("ConfigurationID", "x")
    inside += f"<Connector>{parameter('Cyclic1Duration', '5')}</Connector>"
    text = CPU.format(type="X", inside=inside)
    found, _ = read_hardware(write({"Hardware.hw": text}) / "Hardware.hw")
    assert found.times(1).cycle_ns is None


def test_what_is_wrong_is_found_and_the_rest_is_read(write):
    values = {"ConfigurationID": "x", "Cyclic1Duration": "fast", "SystemTick": "-1"}
    found, findings = hardware(write, values | {"Cyclic2Duration": "2000"})
    assert found.times(2).cycle_ns == 2_000_000
    assert [(each.line, each.message) for each in findings] == [
        (5, "SystemTick: '-1' is no number"),
        (4, "Cyclic1Duration: 'fast' is no number"),
    ]


def test_a_file_that_does_not_say_which_module_is_the_cpu(write):
    found, findings = hardware(write, {"Supervision": "on"})
    assert (found.cpu_type, found.times(1).cycle_ns, findings) == ("X20CP1586", None, [])
    _, (finding,) = read_hardware(write({"x.hw": "<Hardware/>"}) / "x.hw")
    assert finding.message == "there is no module, and so no CPU"
    _, (finding,) = read_hardware(write({"x.hw": "<Hard"}) / "x.hw")
    assert finding.message.startswith("it is no XML")


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        ("<?AutomationStudio Version=4.8.4.50?>{}", []),
        ('<?AutomationStudio WorkingVersion="6.5" FileVersion="4.9"?>{}', []),
        (
            '<?AutomationStudio FileVersion="9.1"?>{}',
            ["file version 9.1 is not known, 4.9 is: read as that"],
        ),
        (
            "<Machine>{}</Machine>",
            ["the root is Machine, and Hardware is known: it is read as that"],
        ),
    ],
)
def test_a_file_of_an_unknown_version_is_read_and_told(write, text, messages):
    inside = CPU.format(type="X", inside=parameter("Cyclic1Duration", "5000"))
    if "Machine" in text:
        inside = inside.removeprefix("<Hardware>").removesuffix("</Hardware>")
    found, findings = read_hardware(write({"Hardware.hw": text.format(inside)}) / "Hardware.hw")
    assert found.times(1).cycle_ns == 5_000_000
    assert [(each.severity, each.message) for each in findings] == [
        ("warning", message) for message in messages
    ]
