"""``plcsim replay``, ``why`` and ``bag``, as they are typed."""

import sys
from pathlib import Path

import pytest

from plcsim.cli.main import main
from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from plcsim.recorder.bag.files import create
from plcsim.recorder.bag.types import text_message

MAIN = """
from plcsim import Program
from st_types import BOOL, UDINT, var

class Cell(Program):
    count = var(UDINT)
    even = var(BOOL)

    def cyclic(self):
        self.count += 1
        self.even = self.count % 2 == 0
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "cell"
    (folder / "cell").mkdir(parents=True)
    (folder / "cell" / "main.py").write_text(MAIN)
    (folder / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["cell"]\n')
    return folder


@pytest.fixture
def bag(project: Path) -> str:
    given = {"record": {"file": "run.bag"}}
    with Supervisor(read_project(project, given), virtual=True, cycles=20, quiet=True) as run:
        run.wait()
    return str(project / "run.bag")


def change(project: Path, old: str, new: str) -> None:
    main_py = project / "cell" / "main.py"
    main_py.write_text(main_py.read_text().replace(old, new))


def test_replay_says_how_much_was_repeated(
    project: Path, bag: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["replay", bag, str(project)]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("20 cycles repeated exactly: ")
    assert err == ""


def test_replay_names_the_first_difference_and_what_has_changed(
    project: Path, bag: str, capsys: pytest.CaptureFixture[str]
) -> None:
    change(project, "% 2", "% 3")

    assert main(["replay", bag, str(project)]) == 4
    out, err = capsys.readouterr()
    assert out == "it differs in cycle 2 of task class 1: cell.even is FALSE, and was TRUE\n"
    assert err == "changed since it was recorded: cell/main.py\n"


def test_replay_shows_the_tags_of_a_cycle(
    project: Path, bag: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["replay", bag, str(project), "--to-cycle", "7"]) == 0
    assert capsys.readouterr().out == "cell.count = 7\ncell.even = FALSE\n"
    assert main(["replay", bag, str(project), "--to-cycle", "70"]) == 1
    assert "ends with cycle 20" in capsys.readouterr().err
    assert main(["replay", bag, str(project), "--to-cycle", "7", "--class", "3"]) == 1
    assert "no task class 3; there are 1" in capsys.readouterr().err


def test_why_names_the_writer(project: Path, bag: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["why", bag, "cell.even", "--project", str(project), "--cycle", "4"]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    assert last == "cycle 4 of task class 1: cell, cell/main.py:11: TRUE"


def test_info_lists_topics(bag: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bag", "info", bag]) == 0
    out = capsys.readouterr().out
    assert "project cell, virtual clock, task classes #1 every 10 ms" in out
    assert "none lost" in out
    assert "plcsim_msgs/Cycle" in out


def test_diff_tells_the_first_cycle_that_differs(
    project: Path, bag: str, capsys: pytest.CaptureFixture[str]
) -> None:
    change(project, "+= 1", "+= 2")
    given = {"record": {"file": "other.bag"}}
    with Supervisor(read_project(project, given), virtual=True, cycles=20, quiet=True) as run:
        run.wait()

    assert main(["bag", "diff", bag, bag]) == 0
    assert capsys.readouterr().out == "the recordings are the same\n"
    assert main(["bag", "diff", bag, str(project / "other.bag")]) == 4
    assert capsys.readouterr().out == (
        "cycle 1 of task class 1: cell.count is 1 against 2, cell.even is FALSE against TRUE\n"
    )


@pytest.mark.parametrize("name", ["p.svg", "p.html"])
def test_plot_draws(bag: str, tmp_path: Path, name: str) -> None:
    assert main(["bag", "plot", bag, "cell.count", "-o", str(tmp_path / name)]) == 0
    assert "cell.count" in (tmp_path / name).read_text()


def test_plot_draws_a_png(bag: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    picture = tmp_path / "p.png"
    words = ["bag", "plot", bag, "cell.count", "cell.even", "-o", str(picture)]
    assert main(words) == 0
    assert picture.read_bytes().startswith(b"\x89PNG\r\n")
    first = picture.read_bytes()
    assert main(words) == 0
    assert picture.read_bytes() == first

    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    assert main(words) == 1


@pytest.mark.parametrize("name", ["p.pdf", "p"])
def test_other_pictures_are_refused(
    bag: str, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bag", "plot", bag, "cell.count", "-o", str(tmp_path / name)]) == 1
    assert "a picture ends in .png, .svg or .html" in capsys.readouterr().err


def test_export_writes_a_row_for_every_cycle(bag: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bag", "export", bag, "cell.even", "cell.count"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:3] == [
        "time_s,task_class,cycle,cell.even,cell.count",
        "0.0,1,1,False,1",
        "0.01,1,2,True,2",
    ]
    assert len(lines) == 21
    assert main(["bag", "export", bag, "cell.cuont"]) == 1
    assert "did you mean cell.count" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words", [["replay"], ["bag", "info"], ["bag", "plot", "cell.count", "-o", "x.svg"]]
)
def test_a_bag_that_is_none_is_one_line(
    tmp_path: Path, words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "no.bag").write_text("no bag\n")
    at = 2 if words[0] == "bag" else 1

    assert main([*words[:at], str(tmp_path / "no.bag"), *words[at:]]) == 1
    err = capsys.readouterr().err
    assert err.startswith("plcsim: ")
    assert len(err.splitlines()) == 1


def test_run_records_into_the_file_that_is_named(
    project: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.bag"
    words = ["run", str(project), "--virtual", "--cycles", "5", "--quiet", "--record", str(file)]

    assert main(words) == 0
    assert file.exists()
    assert main(words) == 1
    assert "exists already" in capsys.readouterr().err


def test_replay_refuses_options_of_the_other_kind_of_bag(
    project: Path, bag: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    field = create(tmp_path / "field.bag")
    field.write(1, [(field.add("/chatter", "std_msgs/msg/String"), text_message("hello"))])
    field.close()

    assert main(["replay", bag, str(project), "--clock"]) == 1
    assert "--clock is for a bag of others, which is played" in capsys.readouterr().err
    assert main(["replay", str(tmp_path / "field.bag"), str(project), "--to-cycle", "5"]) == 1
    assert "--to-cycle is for a recording of plcsim" in capsys.readouterr().err
