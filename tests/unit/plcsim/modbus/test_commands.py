import json
from pathlib import Path

import pytest

from plcsim.cli.main import main

PROGRAM = """
from plcsim import Program
from st_types import BOOL, INT, var

class P(Program):
    number = var(INT)
    flag = var(BOOL)
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "main.py").write_text(PROGRAM)
    (tmp_path / "plc.toml").write_text('[task_class.1]\nprograms = ["p"]\n[modbus]\n')
    (tmp_path / "tags.csv").write_text("tag,area,offset\np.number,hr,5\n")
    return tmp_path


def automatic(project: Path) -> Path:
    with (project / "plc.toml").open("a") as file:
        file.write("auto = true\n")
    return project


def test_check_counts_the_tags(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["tags", "check", str(project)]) == 0
    assert capsys.readouterr().out == f"{project.name}: 1 tags (hr 1)\n"


def test_check_names_the_line_that_is_wrong(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (project / "tags.csv").write_text("tag,area,offset\np.number,hr,5\np.numbre,hr,6\n")
    assert main(["tags", "check", str(project)]) == 1
    error = capsys.readouterr().err
    assert f"{project / 'tags.csv'}:3: p.numbre: no tag" in error
    assert "did you mean p.number?" in error


def test_automatic_addresses_are_locked_by_command(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    automatic(project)
    main(["tags", "check", str(project)])
    assert "tags.lock lacks some addresses" in capsys.readouterr().out
    assert not (project / "tags.lock").exists()
    assert main(["tags", "lock", str(project)]) == 0
    assert capsys.readouterr().out.endswith("tags.lock: 1 addresses\n")
    main(["tags", "check", str(project)])
    assert capsys.readouterr().out == f"{project.name}: 2 tags (co 1, hr 1)\n"


def test_the_project_may_be_named_by_its_file(project: Path) -> None:
    assert main(["tags", "lock", str(automatic(project) / "plc.toml")]) == 0
    assert (project / "tags.lock").exists()


def test_there_is_nothing_to_lock_without_automatic_addresses(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["tags", "lock", str(project)]) == 1
    assert "nothing to lock" in capsys.readouterr().err


def test_list_prints_a_line_for_each_tag(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["tags", "list", str(project)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split() == ["p.number", "hr", "5", "400006", "int16", "rw"]


def test_export_prints_or_writes_a_file(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = project / "out.json"
    assert main(["tags", "export", str(project), "--format", "json", "-o", str(file)]) == 0
    assert capsys.readouterr().out == ""
    assert json.loads(file.read_text())["tags"][0]["modicon6"] == "400006"
    assert main(["tags", "export", str(project)]) == 0
    assert capsys.readouterr().out.splitlines()[1].startswith("p.number,hr,5,6,40006,400006")
    assert main(["tags", "export", str(project), "--output", "/nowhere/x"]) == 1


def test_a_project_without_modbus_says_so(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (project / "plc.toml").write_text('[task_class.1]\nprograms = ["p"]\n')
    assert main(["tags", "check", str(project)]) == 1
    assert "there is no table [modbus]" in capsys.readouterr().err
