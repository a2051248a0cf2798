"""``plcsim logbook`` of a running project."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from plcsim import Program
from plcsim.cli import logbook
from plcsim.cli.main import main
from plcsim.core.controller import Controller
from plcsim.core.logbook import Severity
from plcsim.process.run_file import Run

from .runs import run_of


@pytest.fixture
def plc(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Controller]:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    with run_of(tmp_path, Program) as plc:
        plc.log(Severity.WARNING, "cell", "it is warm")
        plc.log(Severity.ERROR, "cell", "it is \x1b[31mhot")
        yield plc


def printed(capsys: pytest.CaptureFixture[str]) -> list[str]:
    return capsys.readouterr().out.splitlines()


def test_what_is_kept_is_printed_the_oldest_first(
    plc: Controller, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["logbook", str(tmp_path)]) == 0
    assert [line.split(maxsplit=1)[1] for line in printed(capsys)] == [
        "information system: RUN: all INIT units have run",
        "warning     cell: it is warm",
        "error       cell: it is \\x1b[31mhot",
    ]


def test_only_the_last_entries(
    plc: Controller, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for count, lines in (("1", 1), ("0", 0), ("99", 3)):
        assert main(["logbook", str(tmp_path), "-n", count]) == 0
        assert len(printed(capsys)) == lines
    with pytest.raises(SystemExit):
        main(["logbook", str(tmp_path), "-n", "many"])


def test_it_is_followed_until_the_run_ends(
    plc: Controller,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    looks = iter(range(4))
    monkeypatch.setattr(logbook.time, "sleep", lambda _: None)

    def is_alive(_: Run) -> bool:
        number = next(looks)
        plc.log(Severity.INFORMATION, "cell", f"look {number}")
        return number < 3

    folder = str(tmp_path)
    run = logbook.find_running(Path(folder))
    monkeypatch.setattr(logbook, "find_running", lambda _: run)
    monkeypatch.setattr(Run, "is_alive", property(is_alive))
    assert main(["logbook", folder, "-n", "0", "--follow"]) == 0
    assert [line.rpartition(": ")[2] for line in printed(capsys)] == [f"look {n}" for n in range(4)]


def test_entries_that_are_gone_are_counted(
    plc: Controller, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for number in range(20_000):
        plc.log(Severity.WARNING, "cell", f"entry {number}")
    assert main(["logbook", str(tmp_path)]) == 0
    captured = capsys.readouterr()
    lines = captured.out.splitlines()
    assert lines[-1].endswith("entry 19999")
    assert captured.err == f"{20_003 - len(lines)} earlier entries are no longer kept\n"
