"""``plcsim check``: a table of what would run; nothing runs."""

import re

import pytest

from plcsim.cli.main import main

PROGRAM = """
    from plcsim import Program
    from st_types import LREAL, UINT, var

    class Main(Program):
        count = var(UINT)
        way = var(LREAL)

        def init(self) -> None:
            raise RuntimeError("nothing runs")

        cyclic = exit = init
"""

PLC = """
    [task_class.1]
    cycle = "2ms"
    tolerance = "16.5ms"
    programs = ["main", {name = "second", source = "main"}]

    [task_class.4]
    programs = ["other"]
"""


@pytest.fixture
def cell(project):
    return project({"plc.toml": PLC, "main/main.py": PROGRAM, "other/main.py": PROGRAM})


def test_classes_programs_and_memory_are_shown(cell, capsys):
    assert main(["check", str(cell)]) == 0
    shown = capsys.readouterr()
    assert shown.err == ""
    head, *rows, last = shown.out.splitlines()
    assert head.split() == ["class", "cycle", "tolerance", "program", "address", "bytes", "tags"]
    assert [row.split() for row in rows] == [
        ["#1", "2", "ms", "16.5", "ms", "main", "16#00120000", "12", "2"],
        ["#1", "2", "ms", "16.5", "ms", "second", "16#0012000C", "12", "2"],
        ["#4", "100", "ms", "100", "ms", "other", "16#00120018", "12", "2"],
    ]
    assert re.fullmatch(r"cell: 3 programs, 36 of 16777216 bytes .*, tick 1 ms", last)


def test_a_single_program_is_no_plural_and_no_line_is_cut(project, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "20")
    name = "a_name_that_is_longer_than_the_terminal"
    folder = project({"plc.toml": f"""
        [plc]
        name = "lonely"
        [task_class.1]
        programs = ["{name}"]
    """, f"{name}/main.py": PROGRAM})  # fmt: skip
    assert main(["check", str(folder)]) == 0
    _, row, last = capsys.readouterr().out.splitlines()
    assert name in row
    assert re.fullmatch(r"lonely: 1 program, 12 of 16777216 bytes .*, tick 1 ms", last)


@pytest.mark.parametrize("name", ["[/b]", "[red]", "cell[1]"])
def test_any_name_is_shown_as_it_is(cell, capsys, name):
    plc = cell / "plc.toml"
    plc.write_text(f'[plc]\nname = "{name}"\n' + plc.read_text())
    assert main(["check", str(cell)]) == 0
    assert f"{name}: 3 programs" in capsys.readouterr().out


def test_a_wrong_project_is_exit_code_1(cell, capsys):
    (cell / "other" / "main.py").write_text("import nonsense_\n")
    assert main(["check", str(cell)]) == 1
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith(f"plcsim: {cell / 'other' / 'main.py'}:1: ModuleNotFoundError")


@pytest.mark.parametrize(("rights", "noted"), [("auto", True), ("off", False)])
def test_a_processor_that_is_not_there_is_noted(cell, capsys, rights, noted):
    plc = cell / "plc.toml"
    plc.write_text(f'[plc]\ncpu = 1023\nrealtime = "{rights}"\n' + plc.read_text())
    assert main(["check", str(cell)]) == 0
    shown = capsys.readouterr().out
    assert ("on this host: plc.cpu: there is no processor 1023 for the scan" in shown) is noted


def test_too_little_memory_is_found(cell, capsys):
    (cell / "main" / "main.py").write_text(
        "from plcsim import Program\nfrom st_types import ARRAY, UINT, var\n"
        "class Main(Program):\n    big = var(ARRAY(UINT, (1, 100_000)))\n"
    )
    plc = cell / "plc.toml"
    plc.write_text('[plc]\nmemory = "64KiB"\n' + plc.read_text())
    assert main(["check", str(cell)]) == 1
    assert "the PLC memory of 65536 bytes is full" in capsys.readouterr().err


def test_global_variables_are_shown_and_warnings_told(project, capsys):
    folder = project(
        {
            "plc.toml": '[task_class.1]\nprograms = ["main"]\n',
            "main/main.py": PROGRAM,
            "Global.var": "VAR a, b : UINT; END_VAR\nVAR CONSTANT C : DINT := 1; END_VAR\n",
            "lamps/lamps.fun": "FUNCTION_BLOCK Lamp\nEND_FUNCTION_BLOCK\n",
        }
    )
    assert main(["check", str(folder)]) == 0
    shown = capsys.readouterr()
    assert [row.split() for row in shown.out.splitlines()[1:3]] == [
        ["global", "variables", "16#00120004", "4", "2"],
        ["global", "constants", "16#00120000", "4", "1"],
    ]
    assert shown.err == f"plcsim: {folder}/lamps/lamps.fun:1:16: warning: Lamp has no body\n"


def test_a_program_that_does_not_return_when_it_is_loaded_is_told(project, capsys):
    folder = project(
        {
            "plc.toml": '[plc]\ninit_timeout = "500ms"\n[task_class.1]\nprograms = ["main"]\n',
            "main/main.py": "while True:\n    pass\n",
        }
    )
    assert main(["check", str(folder)]) == 1
    assert re.fullmatch(
        r"plcsim: .*/main/main\.py:[12]: the programs were not loaded within 500 ms\n",
        capsys.readouterr().err,
    )


def test_what_a_map_names_and_is_not_there_is_a_warning(project, capsys):
    folder = project(
        {
            "plc.toml": '[task_class.1]\nprograms = ["main"]\n[io]\nchannels = ["io.iom"]\n',
            "main/main.py": PROGRAM,
            "io.iom": 'VAR_CONFIG ::main:gone AT %IX."M".C; END_VAR',
        }
    )
    assert main(["check", str(folder)]) == 0
    assert "io.iom:1: warning: there is no variable main.gone" in capsys.readouterr().err
