from plcsim.project.automation_studio.software import TaskLine, read_software


def software(write, *classes):
    text = "<SwConfiguration>\n" + "\n".join(classes) + "\n</SwConfiguration>"
    return read_software(write({"Cpu.sw": text}) / "Cpu.sw")


def task(name, source, more=""):
    return f'<Task Name="{name}" Source="{source}" Memory="UserROM" {more}/>'


def cyclic(number, *tasks):
    return f'<TaskClass Name="Cyclic#{number}">{"".join(tasks)}</TaskClass>'


def test_tasks_in_order_without_disabled_and_technology_packages(write):
    found, findings = software(
        write,
        cyclic(2, task("main", "Line.Main.prg"), task("", "Line.Other.PRG", 'BuildOptions="-O1"')),
        cyclic(1, task("off", "Off.prg", 'Disabled="TRUE"'), task("mapp", "")),
    )
    assert findings == []
    assert found.disabled == ("off",)
    assert found.tasks == (
        TaskLine("main", ("Line", "Main"), 2, 2),
        TaskLine("Other", ("Line", "Other"), 2, 2, "-O1"),
    )


def test_two_tasks_of_one_name_and_no_class(write):
    found, findings = software(
        write,
        cyclic(1, task("a", "A.prg")),
        cyclic(4, task("A", "B.prg")),
        cyclic(9, task("c", "C")),
    )
    assert [task.source for task in found.tasks] == [("A",)]  # the first one runs
    assert [(each.line, each.message) for each in findings] == [
        (4, "'Cyclic#9' is no task class; task c"),
        (3, "a task is called A in line 2 already"),
    ]


def test_a_file_that_is_no_xml(write):
    found, (finding,) = read_software(write({"Cpu.sw": "<SwConf"}) / "Cpu.sw")
    assert found.tasks == ()
    assert str(finding).endswith("Cpu.sw:1: error: it is no XML: unclosed token")


def test_a_file_saved_half_has_the_tasks_before_that(write):
    text = """<SwConfiguration>
<TaskClass Name="Cyclic#1"><Task Name="a" Source="a.prg"/><Task Name="b" Source="b.prg"/>
</TaskClass>
<TaskClass Name="Cyclic#2"><Task Name="c" Sou"""
    found, (finding,) = read_software(write({"Cpu.sw": text}) / "Cpu.sw")
    assert [(task.name, task.task_class) for task in found.tasks] == [("a", 1), ("b", 1)]
    assert (finding.line, finding.severity) == (4, "error")
