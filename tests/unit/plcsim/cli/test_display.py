"""What `plcsim run` shows: the live table and the summary."""

import io

import pytest
from rich.console import Console

from plcsim.cli.display import LiveTable, print_summary, source_line
from plcsim.core.heap_use import Heaps, HeapUse
from plcsim.core.task import Policy
from plcsim.process.report import report
from plcsim.project.plc_toml import read_project
from plcsim.shared_image.status_page import ServiceState, StatusPage

MS = 1_000_000


@pytest.fixture
def summary(make_controller, capsys, monkeypatch):
    """``summary(class, ...)``: the summary of a run of 100 ms, on 80 columns."""
    monkeypatch.setenv("COLUMNS", "80")

    def summary(*classes, name="cell", heaps=()):
        controller = make_controller(*classes)
        for owner, use in heaps:
            Heaps.of(controller.context).add(owner, lambda use=use: use)
        controller.boot()
        controller.run_for(100 * MS)
        controller.shutdown()
        print_summary(report(controller, name, 100 * MS, []))
        return capsys.readouterr().err

    return summary


def test_a_run_that_stopped(summary, task_class, program_of, clock):
    program = program_of(lambda _: clock.spend_ns(2_500_000))
    head, columns, row, names = summary(task_class(1, 10, a=program, b=program_of())).splitlines()
    assert head == "cell  STOPPED  after 100 ms  (virtual clock)"
    assert columns.split()[:5] == ["class", "cycle", "cycles", "missed", "viol."]
    assert " ".join(row.split()) == "#1 10 ms 10 0 0 2.5 ms / 2.5 ms 0 ns / 0 ns"
    assert names == "#1: a, b"


def test_names_do_nothing_to_the_terminal(summary, task_class, program_of):
    name = "\x1b[2Jcell\x9b31m"
    shown = summary(task_class(1, 10, **{name: program_of()}), name=name)
    assert shown.count("\\x1b[2Jcell\\x9b31m") == 2
    assert not {"\x1b", "\x9b"} & set(shown)


def test_what_is_left_on_a_heap_and_what_found_no_room_is_told(summary, task_class, program_of):
    heaps = [
        ("clean", HeapUse(9000, 0, 800, 0, 0)),
        ("leaky", HeapUse(9000, 24, 800, 1, 0)),
        ("library L", HeapUse(1 << 20, 2400, 900_000, 30, 2)),
    ]
    lines = summary(task_class(1, 10, a=program_of()), heaps=heaps).splitlines()[4:]
    assert lines == [
        "leaky: heap of 9,000 bytes: 1 area with 24 bytes not freed at the end",
        "library L: heap of 1,048,576 bytes: 30 areas with 2,400 bytes not freed at the end",
        "library L: heap of 1,048,576 bytes: no room for 2 requests; most in use: 900,000 bytes",
    ]


def test_violations_are_shown_with_their_causes(summary, task_class, program_of, clock):
    settings = {"policy": Policy.LOG}
    shown = summary(task_class(1, 10, settings, p=program_of(lambda _: clock.spend_ns(25 * MS))))
    assert "violations by cause: program 4, host 0, preempted 0" in shown
    assert shown.count("cycle time violation in cycle") == 4


def test_of_many_entries_the_latest_are_shown(summary, task_class, program_of, clock):
    settings = {"policy": Policy.LOG}
    shown = summary(task_class(1, 1, settings, p=program_of(lambda _: clock.spend_ns(2 * MS))))
    assert shown.count("cycle time violation in cycle") == 10
    assert "... and 40 earlier entries; --report FILE keeps them" in shown


def test_a_fault_is_shown_in_one_line_however_long(summary, task_class, program_of):
    def fail(_):
        raise ValueError("a long text " * 20)

    shown = summary(task_class(1, 10, p=program_of(fail)))
    (line,) = [line for line in shown.splitlines() if line.startswith("SERVICE: p CYCLIC:")]
    assert __file__ in line
    assert shown.count("p CYCLIC:") == 1  # not once more from the logbook


def test_the_line_that_failed_is_shown(tmp_path):
    file = tmp_path / "main.py"
    file.write_text("first\n        self.cuont = 1\n")
    assert source_line(f"{file}:2") == "     2 |         self.cuont = 1\n"
    assert source_line(f"{file}:3") == source_line("/nowhere:1") == source_line("") == ""


def test_a_violation_that_led_to_service_names_its_class(summary, task_class, program_of, clock):
    shown = summary(task_class(3, 10, p=program_of(lambda _: clock.spend_ns(25 * MS))))
    assert "SERVICE: task class 3: cycle time violation in cycle 1, cause program" in shown


@pytest.mark.parametrize("name", ["[/b]", "[red]"])
def test_any_name_is_shown_as_it_is(summary, task_class, program_of, name):
    shown = summary(task_class(1, 10, p=program_of()), name=name)
    assert shown.startswith(f"{name}  STOPPED")


@pytest.fixture
def live(project_of):
    """The live table of a project of one program, and its status page."""
    folder = project_of("")
    page = StatusPage()
    yield LiveTable(read_project(folder), page, 60_000 * MS, hint="what to do"), page
    page.close()


def test_the_live_table_shows_the_status_page(live, make_controller, task_class, program_of, clock):
    table, page = live
    program = program_of(lambda _: clock.spend_ns(11 * MS))
    controller = make_controller(
        task_class(1, 10, {"policy": Policy.LOG}, main=program), heartbeat=page
    )
    controller.boot()
    controller.run(cycles=4)
    page.ticked(12_340 * MS)
    out = io.StringIO()
    Console(file=out, width=80).print(table.picture())
    head, _, row, names, hint = out.getvalue().splitlines()
    assert " ".join(head.split()) == "cell RUN 12.3 s of 60 s"
    assert " ".join(row.split()) == "#1 10 ms 4 4 4 11 ms / 11 ms 0 ns / 0 ns"
    assert names == "#1: main"
    assert hint == "what to do"


def test_the_live_table_shows_how_services_do_and_where_they_are(project_of):
    folder = project_of("", plc="[modbus]\nport = 1502\nauto = true")
    states = {"modbus": ServiceState.STARTING}
    page = StatusPage()
    table = LiveTable(read_project(folder), page, services=lambda: states)

    def line():
        out = io.StringIO()
        Console(file=out, width=80).print(table.picture())
        return out.getvalue().splitlines()[4]

    assert line() == "[modbus] starting  127.0.0.1:1502"
    states["modbus"] = ServiceState.FAILING
    assert line() == "[modbus] failing  127.0.0.1:1502"
    page.close()
