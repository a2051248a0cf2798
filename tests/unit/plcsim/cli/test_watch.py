import os
import subprocess
import sys
from collections.abc import Iterator
from enum import IntEnum
from pathlib import Path

import pytest

from plcsim import Program
from plcsim.cli import watch
from plcsim.cli.main import main
from plcsim.library.standard import TON
from plcsim.process.run_file import Run, announce
from st_types import ARRAY, BOOL, BYTE, ENUM, LREAL, REAL, STRING, UINT, Struct, var
from st_types.types.derived import Section
from st_types.types.views import type_of

from .runs import cycling, run_of


class Mode(IntEnum):
    OFF = 0
    ON = 5


class Axis(Struct):
    speed = var(REAL, 1.5)
    ready = var(BOOL, initial=True)


class Cell(Program):
    count = var(UINT)
    axes = var(ARRAY(Axis, (1, 2)))
    name = var(STRING(9), "cell")
    mode = var(ENUM(Mode), Mode.ON)

    def cyclic(self) -> None:
        self.count += 1


class Huge(Program):
    waste = var(ARRAY(BYTE, (0, 100_000)))
    last = var(UINT, 4711)

    def init(self) -> None:
        for place in range(100_000):
            self.waste[place] = place % 256


class Vast(Program):
    waste = var(ARRAY(LREAL, (0, 140_000)))


class Timed(Program):
    timer = var(TON)

    def cyclic(self) -> None:
        self.timer(IN=True, PT=1500)


@pytest.fixture(autouse=True)
def runtime_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))


@pytest.fixture
def project(tmp_path: Path) -> Iterator[Path]:
    with run_of(tmp_path, Cell):
        yield tmp_path


def shown(capsys: pytest.CaptureFixture[str]) -> list[list[str]]:
    return [line.split() for line in capsys.readouterr().out.splitlines()]


def test_all_variables_are_shown(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["watch", str(project), "--once"]) == 0
    assert shown(capsys)[1:] == [
        ["cell.count", "7", "UINT"],
        ["cell.axes[1].speed", "1.5", "REAL"],
        ["cell.axes[1].ready", "TRUE", "BOOL"],
        ["cell.axes[2].speed", "1.5", "REAL"],
        ["cell.axes[2].ready", "TRUE", "BOOL"],
        ["cell.name", "'cell'", "STRING[9]"],
        ["cell.mode", "ON", "Mode"],
    ]


def test_of_several_runs_the_one_started_last_is_shown(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as other:
        folder = next(project.glob("plcsim-*"))
        (first,) = folder.iterdir()
        announce(project, Run(other.pid, 0, 0))
        os.utime(first, ns=(2**62, 2**62))
        assert main(["watch", str(project), "cell.count", "--once"]) == 0
        other.communicate(b"\n")
    shown = capsys.readouterr()
    assert shown.out.split()[-3:] == ["cell.count", "7", "UINT"]
    assert shown.err == (
        "2 runs of this project; this is the one that was started last, process "
        f"{os.getpid()}; others: {other.pid}\n"
    )


def test_named_variables_are_shown_in_their_order(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["watch", str(project / "plc.toml"), "cell.axes[2]", "CELL.COUNT"]) == 0
    assert [line[0] for line in shown(capsys)[1:]] == [
        "cell.axes[2].speed",
        "cell.axes[2].ready",
        "CELL.COUNT",
    ]


def test_text_is_shown_as_it_is_however_narrow(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    class Marked(Program):
        a_name_that_is_longer_than_the_terminal = var(STRING(30), "[red] and :smile:")

    monkeypatch.setenv("COLUMNS", "20")
    with run_of(tmp_path, Marked):
        assert main(["watch", str(tmp_path)]) == 0
    row = capsys.readouterr().out.splitlines()[1]
    assert "cell.a_name_that_is_longer_than_the_terminal" in row
    assert "'[red] and :smile:'  STRING[30]" in row


def test_an_unknown_variable_is_named(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["watch", str(project), "cell.cuont", "--once"]) == 1
    shown = capsys.readouterr().err
    assert "no tag 'cell.cuont'" in shown
    assert "did you mean cell.count" in shown


def test_a_project_that_does_not_run_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["watch", str(tmp_path / "none")]) == 1
    assert "none/plc.toml: there is no such file" in capsys.readouterr().err
    (tmp_path / "plc.toml").touch()
    assert main(["watch", str(tmp_path)]) == 1
    assert "is not running; start it with plcsim run" in capsys.readouterr().err


def test_what_the_snapshot_does_not_hold_is_sampled(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with run_of(tmp_path, Huge, lambda plc: [plc.tags.find("cell.last")]) as plc, cycling(plc):
        for tags in (["cell.waste[5]", "cell.last", "cell.waste[99999]"], ["cell.last"]):
            assert main(["watch", str(tmp_path), *tags]) == 0
            values = {"cell.waste[5]": "5", "cell.last": "4711", "cell.waste[99999]": "159"}
            assert [line[:2] for line in shown(capsys)[1:]] == [[t, values[t]] for t in tags]


def test_more_than_can_be_sampled_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with run_of(tmp_path, Vast) as plc, cycling(plc):
        assert main(["watch", str(tmp_path)]) == 1
    assert "too many tags are not in the snapshot; name fewer" in capsys.readouterr().err


def test_a_scan_that_stands_still_gives_no_samples(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(watch, "PATIENCE_S", 0.05)
    with run_of(tmp_path, Huge):
        assert main(["watch", str(tmp_path), "cell.last"]) == 0
    assert shown(capsys)[1:] == [["cell.last", "...", "UINT"]]


def test_times_are_written_as_times_and_blocks_show_their_interface(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with run_of(tmp_path, Timed):
        assert main(["watch", str(tmp_path)]) == 0
        assert shown(capsys)[1:] == [
            ["cell.timer.IN", "TRUE", "BOOL"],
            ["cell.timer.PT", "T#1s500ms", "TIME"],
            ["cell.timer.Q", "FALSE", "BOOL"],
            ["cell.timer.ET", "T#6ms", "TIME"],
        ]
        inner = [m.name for m in type_of(TON).members if m.section is Section.INTERNAL]
        assert main(["watch", str(tmp_path), f"cell.timer.{inner[0]}"]) == 0
        assert shown(capsys)[1][0] == f"cell.timer.{inner[0]}"


def test_forced_values_are_marked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with run_of(tmp_path, Cell) as plc:
        plc.forces.force(plc.tags.find("cell.axes[2].speed"), b"\0\0\0\0", "test")
        plc.run(cycles=1)
        assert main(["watch", str(tmp_path), "cell.axes"]) == 0
    assert [line[1:-1] for line in shown(capsys)[1:]] == [
        ["1.5"],
        ["TRUE"],
        ["0", "forced"],
        ["TRUE"],
    ]


def test_on_a_terminal_values_are_drawn_until_the_run_ends(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    looks = iter([True, True, True, False])
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    monkeypatch.setattr(Run, "is_alive", property(lambda _: next(looks)))
    assert main(["watch", str(project), "cell.count"]) == 0
    shown_text = capsys.readouterr().out
    assert shown_text.count("cell.count") >= 2
    assert "The run has ended." in shown_text
