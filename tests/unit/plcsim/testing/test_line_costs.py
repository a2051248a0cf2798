"""Costs of lines: exact, and those of the code that runs without counters."""

import pytest

from plcsim.program.structured_text.coverage import MEASURING
from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project
from plcsim.project.structured_text_file import load_file
from plcsim.testing.plc import Plc

MAIN = """\
PROGRAM conveyor
VAR
    position, speed, i : DINT;
    t : TON;
END_VAR
    t(IN := TRUE, PT := T#20ms);
    position := position + speed;
    IF position > 100 THEN
        position := 0;
    END_IF
    FOR i := 0 TO 9 DO speed := speed + i; END_FOR
END_PROGRAM
"""


@pytest.fixture
def ran(tmp_path, monkeypatch):
    """``ran(counted)``: the costs of some cycles of the program."""
    file = tmp_path / "Main.st"
    file.write_text(MAIN)
    monkeypatch.chdir(tmp_path)

    def ran(*, counted):
        monkeypatch.setattr(MEASURING, "is_on", counted)
        plc = Plc(load_file(file, 10_000_000))
        plc.boot()
        plc.cycles(30)
        (name,) = plc.costs.instructions
        return name, plc.costs

    return ran


def test_counting_changes_no_cost_of_a_cycle(ran):
    (name, plain), (_, counted) = ran(counted=False), ran(counted=True)
    assert counted.instructions == plain.instructions
    assert counted.instructions[name][0] > 0
    assert plain.lines.of_task(name) == {}


def test_lines_are_told_with_their_texts(ran):
    name, costs = ran(counted=True)
    (file, rows), *_ = costs.lines.of_task(name).items()
    assert file == "Main.st"
    texts = {line: text for line, _, text in rows}
    assert texts[7] == "position := position + speed;"
    assert {6, 7, 8, 9, 11} <= texts.keys() <= {1, *range(6, 13)}
    lines = MAIN.splitlines()
    assert all(text == lines[line - 1].strip() for line, text in texts.items())


def test_the_lines_are_all_that_a_program_costs_but_for_what_it_calls(ran):
    """The body of TON is a function of the C library, which has no lines."""
    name, costs = ran(counted=True)
    lines = sum(cost for rows in costs.lines.of_task(name).values() for _, cost, _ in rows)
    rest = sum(costs.instructions[name]) - lines
    assert rest >= 30
    assert rest < lines / 4


def test_init_is_left_out(tmp_path, monkeypatch):
    (tmp_path / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["one"]\n')
    (tmp_path / "one").mkdir()
    (tmp_path / "one" / "Main.var").write_text("VAR n, i : DINT; END_VAR\n")
    loop = "FOR i := 0 TO 99 DO\nn := n + 1;\nEND_FOR\n"
    bodies = {"_INIT": loop, "_CYCLIC": "n := 5;\n"}
    units = [f"PROGRAM {name}\n{body}END_PROGRAM\n" for name, body in bodies.items()]
    (tmp_path / "one" / "Main.st").write_text("".join(units))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(MEASURING, "is_on", True)
    plc = Plc(load(read_project(tmp_path / "plc.toml")))
    plc.boot()
    plc.cycles(3)
    plc.restart()
    plc.cycles(3)
    (rows,) = plc.costs.lines.of_task("one").values()
    assert [line for line, *_ in rows] == [6, 7]
    assert sum(cost for _, cost, _ in rows) == sum(plc.costs.instructions["one"])


def test_programs_in_python_have_none(tmp_path, monkeypatch):
    (tmp_path / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["one"]\n')
    (tmp_path / "one").mkdir()
    text = "from plcsim import Program\n\n\nclass One(Program):\n    def cyclic(self): ...\n"
    (tmp_path / "one" / "main.py").write_text(text)
    monkeypatch.setattr(MEASURING, "is_on", True)
    plc = Plc(load(read_project(tmp_path / "plc.toml")))
    plc.boot()
    plc.cycles(1)
    assert plc.costs.lines.of_task("one") == plc.costs.lines.of_libraries() == {}
