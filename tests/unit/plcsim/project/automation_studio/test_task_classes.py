from plcsim.core.task import Policy
from plcsim.project.automation_studio.hardware import ClassTimes, Hardware
from plcsim.project.automation_studio.reader import ProgramTask, read_automation_studio
from plcsim.project.automation_studio.task_classes import task_classes, tasks_to_run, tick_ns
from plcsim.project.tables import ProgramEntry, TaskClassTable

MS = 1_000_000


def task(name, number):
    return ProgramTask(name, number, f"Pkg.{name}", None, (), 1)


def test_times_come_from_plc_toml_then_from_the_hardware_then_from_a_new_project():
    hardware = Hardware(classes={1: ClassTimes(800_000, 0), 2: ClassTimes(2 * MS, None)})
    table = TaskClassTable(cycle_ns=4 * MS, policy=Policy.LOG, programs=(ProgramEntry("p", "p"),))
    tasks = [task("c", 4), task("b", 2), task("a", 1), task("d", 1)]
    found = task_classes(tasks, hardware, {2: table, 3: TaskClassTable()})
    assert [(c.number, c.cycle_ns, c.tolerance_ns) for c in found] == [
        (1, 800_000, 0),
        (2, 4 * MS, 4 * MS),
        (4, 100 * MS, 100 * MS),
    ]
    assert [p.name for p in found[0].programs] == ["a", "d"]
    assert found[1].programs == (ProgramEntry("b", "Pkg.b"), ProgramEntry("p", "p"))
    assert found[1].policy is Policy.LOG
    assert tick_ns(hardware, found) == 200_000
    assert tick_ns(Hardware(tick_ns=400_000), found) == 400_000


def test_tasks_are_skipped_by_name(bottling):
    found = read_automation_studio(bottling)
    names = [each.name for each in tasks_to_run(found, ["valvea", "CLOCK"])]
    assert names == [
        "FillStatio",
        "ValveB",
        "Boiler",
        "Motor",
        "Mixer",
        "Washer",
        "Sorter",
        "Count",
    ]
