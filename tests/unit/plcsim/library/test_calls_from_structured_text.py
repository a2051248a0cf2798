"""Functions and blocks of the libraries, called by a program in Structured Text."""

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.system import State
from plcsim.network import VirtualNetwork
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

PATIENT = '[plc]\ninit_timeout = "10m"\n'
"""Of plc.toml: the time limit of loading is no subject here, whatever else the machine does."""

CALLS = [
    ("n : INT", "n := LEN(CONCAT('abc', 'de'));", 5),
    ("s : STRING[80]", "s := CONCAT(CONCAT('a', 'b'), MID('xyz', 1, 2));", "aby"),
    ("s : STRING[80]", "s := REAL_TO_STRING(115.4);", "115.4"),
    ("s : STRING[80]", "s := INT_TO_STRING(INT#-7);", "-7"),
    ("s : STRING[80]", "s := MID(DT_TO_STRING(DT#2026-03-31-06:00:00), 10, 4);", "2026-03-31"),
    ("w : WSTRING[80]", "w := UINT_TO_WSTRING(7);", "7"),
    ("r : REAL", "r := STRING_TO_REAL('1.5e3');", 1500.0),
    ("u : UINT", "u := STRING_TO_UINT('70000');", 4464),
    ("u : UINT", "u := swapUINT(16#1234);", 0x3412),
    ("s : STRING[80]", "brsstrcat(brsstrcpy(ADR(s), ADR('x')), ADR('yz'));", "xyz"),
    ("s : STRING[80]", "strcpy(ADR(s), ADR('x')); strcat(ADR(s), ADR('y'));", "xy"),
    ("s : STRING[80]", "brsitoa(-42, ADR(s));", "-42"),
    ("u : UINT", "u := strlen(ADR('hello'));", 5),
    ("r : REAL", "r := pow(2.0, 10.0);", 1024.0),
    ("r : REAL", "r := brmfloor(-0.5);", -1.0),
    ("u : UDINT; w : WSTRING[9]", "w := UINT_TO_WSTRING(123); u := brwcslen(ADR(w));", 3),
    ("t : TIME", "t := clock_ms();", 1005),
    ("d : DATE_AND_TIME; g : DTGetTime", "g(enable := TRUE); d := g.DT1;", 946_684_800),
    ("s : STRING[80]; g : USINT", "ST_name(0, ADR(s), ADR(g));", "main"),
    ("n : UDINT; a, l : UDINT", "PV_xgetadr(ADR('main:n'), ADR(a), ADR(l)); n := l;", 4),
    (
        "p : UDINT; ok : BOOL",
        "ok := TMP_alloc(100, ADR(p)) = 0 AND p <> 0; p := BOOL_TO_UDINT(ok);",
        1,
    ),
    ("c : UDINT; i : RTInfo", "i(enable := TRUE); c := i.cycle_time;", 10_000),
    ("b : BOOL", "b := DiagCpuIsSimulated();", True),
]


@pytest.fixture(scope="module")
def values(tmp_path_factory):
    """What each call of `CALLS` gives: one program for each, all on one controller."""
    folder = tmp_path_factory.mktemp("project")
    names = ["main", *(f"p{number}" for number in range(1, len(CALLS)))]
    for name, (declared, text, _) in zip(names, CALLS, strict=True):
        (folder / name).mkdir()
        body = text.replace("'main:n'", f"'{name}:n'")
        (folder / name / "Main.st").write_text(f"PROGRAM _CYCLIC\n{body}\nEND_PROGRAM\n")
        (folder / name / "Main.var").write_text(f"VAR\n{declared};\nEND_VAR\n")
    programs = ", ".join(f'"{name}"' for name in names)
    (folder / "plc.toml").write_text(
        f'{PATIENT}[task_class.1]\ncycle = "10ms"\nprograms = [{programs}]\n'
    )
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    controller = assemble(load(read_project(folder)), clock=clock, network=network)
    controller.boot()
    assert controller.run_for(10_000_000) is State.RUN, controller.fault
    tags = controller.tags
    found = {}
    for number, (name, (declared, _, _)) in enumerate(zip(names, CALLS, strict=True)):
        variable = declared.split()[0].rstrip(",")
        found[number] = tags.read(tags.find(f"{name}.{variable}"))
        if found[number] == name and name != "main":
            found[number] = "main"  # ST_name gives the task's own
    return found


@pytest.mark.parametrize("number", range(len(CALLS)), ids=[text for _, text, _ in CALLS])
def test_a_call_gives_its_value(values, number):
    assert values[number] == CALLS[number][2]


WRITER = """
PROGRAM _CYCLIC
CASE step OF
    0:
        create(enable := TRUE, pDevice := ADR('USER'), pFile := ADR('log.txt'));
        IF create.status = ERR_OK THEN
            step := 1;
        ELSIF create.status <> ERR_FUB_BUSY THEN
            failed := create.status;
        END_IF
    1:
        text := CONCAT(DT_TO_STRING(DT#2026-03-31-06:00:00), ' started');
        size := brsstrlen(ADR(text));
        write(enable := TRUE, ident := create.ident, pSrc := ADR(text), len := size);
        IF write.status = ERR_OK THEN
            step := 2;
        END_IF
    2:
        close(enable := TRUE, ident := create.ident);
        IF close.status = ERR_OK THEN
            step := 3;
        END_IF
    END_CASE
END_PROGRAM
"""

WRITER_VARIABLES = """
VAR
    step : USINT;
    create : FileCreate;
    write : FileWrite;
    close : FileClose;
    text : STRING[80];
    size : UDINT;
    failed : UINT;
END_VAR
"""


@pytest.fixture
def writer(tmp_path):
    """``writer(devices)``: a controller whose program writes a file on device USER."""
    (tmp_path / "main").mkdir()
    (tmp_path / "main" / "Main.st").write_text(WRITER)
    (tmp_path / "main" / "Main.var").write_text(WRITER_VARIABLES)
    (tmp_path / "files").mkdir()

    def writer(devices):
        plc_toml = f'{PATIENT}[task_class.1]\ncycle = "10ms"\nprograms = ["main"]\n{devices}'
        (tmp_path / "plc.toml").write_text(plc_toml)
        clock = VirtualClock()
        network = VirtualNetwork(clock.now_ns).host("192.168.0.10")
        controller = assemble(load(read_project(tmp_path)), clock=clock, network=network)
        controller.boot()
        assert controller.run_for(100_000_000) is State.RUN, controller.fault
        return controller

    return writer


def test_a_program_writes_a_file_on_a_device_of_plc_toml(writer, tmp_path):
    controller = writer('[library.FileIO.devices]\nUSER = "files"\n')
    assert controller.tags.read(controller.tags.find("main.step")) == 3
    assert (tmp_path / "files" / "log.txt").read_text() == "DT#2026-03-31-06:00:00 started"


def test_a_device_that_plc_toml_does_not_name(writer, tmp_path):
    controller = writer("")
    assert controller.tags.read(controller.tags.find("main.failed")) == 20709
    assert not [*(tmp_path / "files").iterdir()]
