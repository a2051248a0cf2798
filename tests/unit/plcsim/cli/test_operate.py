"""``plcsim set``, ``force`` and ``release`` on a running project."""

from collections.abc import Iterator
from enum import IntEnum
from pathlib import Path

import pytest

from plcsim import Program
from plcsim.cli import running
from plcsim.cli.main import main
from plcsim.core.controller import Controller
from st_types import ARRAY, BOOL, ENUM, REAL, STRING, TIME, UINT, Struct, var

from .runs import cycling, run_of


class Mode(IntEnum):
    OFF = 0
    AUTO = 5


class Point(Struct):
    x = var(REAL)
    y = var(REAL, 1.5)


class Cell(Program):
    count = var(UINT)
    setpoint = var(REAL, 5.0)
    mode = var(ENUM(Mode), Mode.OFF)
    delay = var(TIME, 20)
    name = var(STRING(9), "cell")
    point = var(Point)
    on = var(BOOL)
    many = var(ARRAY(UINT, (1, 3)))

    def cyclic(self) -> None:
        self.count += 1


@pytest.fixture
def plc(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Controller]:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    with run_of(tmp_path, Cell) as plc, cycling(plc):
        yield plc


@pytest.fixture
def still(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Controller]:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setattr(running, "PATIENCE_S", 0.05)
    with run_of(tmp_path, Cell) as plc:
        yield plc


def plcsim(command: str, folder: Path, *words: str) -> int:
    return main([command, str(folder), *words])


@pytest.mark.parametrize(
    ("tag", "text", "told"),
    [
        ("cell.setpoint", "6.5", "cell.setpoint: 5.0 -> 6.5"),
        ("cell.setpoint", "-1", "cell.setpoint: 5.0 -> -1.0"),
        ("CELL.mode", "AUTO", "CELL.mode: OFF -> AUTO"),
        ("cell.delay", "T#1m30s", "cell.delay: T#20ms -> T#1m30s"),
        ("cell.name", "press", "cell.name: 'cell' -> 'press'"),
        (
            "cell.point",
            "(x := 1, y := 2)",
            "cell.point: (x := 0.0, y := 1.5) -> (x := 1.0, y := 2.0)",
        ),
        ("cell.many", "[1, 2(7)]", "cell.many: [3(0)] -> [1, 2(7)]"),
    ],
)
def test_set_writes_a_tag_and_tells_the_value_before(
    plc: Controller, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    tag: str, text: str, told: str,
) -> None:  # fmt: skip
    assert plcsim("set", tmp_path, tag, text) == 0
    assert capsys.readouterr().out == f"{told}\n"
    written = plc.tags.read(plc.tags.find(tag))
    assert plcsim("watch", tmp_path, tag) == 0
    assert written is not None


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ([], "a TAG and a VALUE are needed"),
        (["cell.setpoint"], "a TAG and a VALUE are needed"),
        (["cell.setpiont", "1"], "did you mean cell.setpoint"),
        (["cell.setpoint", "fast"], "cell.setpoint: "),
        (["cell.mode", "ON"], "cell.mode: .*there are OFF, AUTO"),
        (["cell.count", "70000"], "cell.count: 70000"),
        (["cell.point", "(x := 1)"], "the member y of Point is missing"),
    ],
)
def test_what_cannot_be_set_says_why(
    plc: Controller, tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str], why: str
) -> None:
    assert plcsim("set", tmp_path, *words) == 1
    captured = capsys.readouterr()
    assert captured.out == ""
    with pytest.raises(AssertionError, match=why):
        raise AssertionError(captured.err)


def test_force_keeps_a_tag_until_it_is_released(
    plc: Controller, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert plcsim("force", tmp_path) == 0
    assert capsys.readouterr().out == "no tag is forced\n"
    assert plcsim("force", tmp_path, "cell.count", "7") == 0
    assert capsys.readouterr().out == "cell.count is forced to 7; plcsim release lets it go\n"
    assert plcsim("set", tmp_path, "cell.count", "9") == 0
    assert capsys.readouterr().out.splitlines()[1] == ("but cell.count is forced; release it first")
    assert plcsim("force", tmp_path) == 0
    assert [line.split() for line in capsys.readouterr().out.splitlines()[1:]] == [
        ["cell.count", "7", "plcsim"]
    ]
    assert plcsim("release", tmp_path, "cell.count") == 0
    assert len(plc.forces) == 0
    assert plcsim("release", tmp_path, "cell.count") == 1
    assert "release cell.count: it is not forced" in capsys.readouterr().err


def test_all_are_released_at_once(plc: Controller, tmp_path: Path) -> None:
    for tag in ("cell.on", "cell.count"):
        assert plcsim("force", tmp_path, tag, "1") == 0
    assert plcsim("release", tmp_path, "--all") == 0
    assert len(plc.forces) == 0


def test_release_needs_tags_or_all_but_not_both(
    plc: Controller, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for words in ([], ["cell.on", "--all"]):
        assert plcsim("release", tmp_path, *words) == 1
        assert "name the tags to release, or give --all" in capsys.readouterr().err


def test_a_scan_that_stands_still_takes_nothing_and_that_is_told(
    still: Controller, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert plcsim("set", tmp_path, "cell.count", "9") == 1
    assert "set cell.count: the scan stands still, nothing was done" in capsys.readouterr().err
    still.shutdown()
    assert plcsim("force", tmp_path, "cell.count", "9") == 1
    assert "force cell.count: it is in STOPPED, nothing was done" in capsys.readouterr().err


def test_a_project_that_does_not_run_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    (tmp_path / "plc.toml").touch()
    for command in ("set", "force", "release", "logbook"):
        words = [] if command == "logbook" else ["a.b", "1"]
        assert plcsim(command, tmp_path, *words) == 1
        assert "is not running; start it with plcsim run" in capsys.readouterr().err
