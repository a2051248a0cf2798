import argparse
from collections.abc import Callable
from pathlib import Path

import pytest

from plcsim.cli import types
from plcsim.cli.declaration_scopes import LIBRARY
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import PlcError
from plcsim.library.installed import dialect_of
from st_types.resolve.dialect import AUTOMATION_STUDIO
from st_types.syntax.declarations import parse_text

Run = Callable[..., tuple[int, str, str]]


def parse(*arguments: str) -> argparse.Namespace:
    parser = CommandParser()
    types.register(parser.add_subparsers(required=True))
    return parser.parse_args(["types", *arguments])


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    def call(*arguments: object) -> tuple[int, str, str]:
        options = parse(*map(str, arguments))
        code = options.func(options)
        return code, *capsys.readouterr()

    return call


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "Global.TYP").write_bytes(
        b"TYPE\r\n\tAxis : STRUCT (*Achse f\xfcr X*)\r\n\t\tpos : LREAL; (*mm*)\r\n"
        b"\t\ttimer : TON;\r\n\t\ton : BOOL;\r\n\tEND_STRUCT;\r\nEND_TYPE\r\n"
    )
    (tmp_path / "Main").mkdir()
    (tmp_path / "Main" / "Variables.var").write_text(
        "VAR CONSTANT MAX : USINT := 3; END_VAR VAR axes : ARRAY[0..MAX] OF Axis; END_VAR\n"
    )
    (tmp_path / "Main" / "notes.txt").write_text("no declarations")
    return tmp_path


def test_check_of_sound_files(run: Run, project: Path) -> None:
    code, out, err = run("check", project)
    assert (code, err) == (0, "")
    assert out == (
        "2 files, 8 lines: 1 type, 0 function blocks, 0 functions, 2 variables; 0 errors, "
        "0 warnings\n"
    )


def test_check_shows_findings_in_order_and_their_number(run: Run, project: Path) -> None:
    (project / "Bad.typ").write_text("TYPE\n\tA : Lib;\n\tB : INT := 'x';\n\tC INT;\nEND_TYPE\n")
    code, out, err = run("check", project)
    assert (code, err) == (1, "")
    places = [line.removeprefix(f"{project}/") for line in out.splitlines() if "Bad.typ" in line]
    assert [place[:18] for place in places] == [
        "Bad.typ:2:6: warni",
        "Bad.typ:3:13: erro",
        "Bad.typ:4:4: error",
    ]
    assert "     4 |  C INT;\n       |    ^\n" in out
    assert out.endswith("2 errors, 1 warning\n")


def test_an_unknown_name_is_an_error_if_told_so(run: Run, project: Path) -> None:
    (project / "Lib.typ").write_text("TYPE A : Lib; END_TYPE")
    assert run("check", project)[0] == 0
    assert run("check", "--strict", project)[0] == 1


def test_check_reports_a_file_that_cannot_be_read(run: Run, project: Path) -> None:
    (project / "Dead.typ").symlink_to(project / "nowhere")
    code, out, _ = run("check", project)
    assert code == 1
    assert "Dead.typ: error: No such file or directory" in out


def test_check_of_nothing_is_an_error(run: Run, tmp_path: Path) -> None:
    with pytest.raises(PlcError, match=r"no \.typ, \.var or \.fun file was found"):
        run("check", tmp_path)
    with pytest.raises(PlcError, match="nope: no such file or folder"):
        run("check", tmp_path / "nope")
    (tmp_path / "a.txt").touch()
    with pytest.raises(PlcError, match=r"a\.txt: not a \.fun, \.typ or \.var file"):
        run("check", tmp_path / "a.txt")


def test_layout(run: Run, project: Path) -> None:
    assert run("layout", "Axis", project)[1] == (
        "Axis: 32 bytes, alignment 4\n"
        "  offset     bytes  member  type\n"
        "       0         8  pos     LREAL\n"
        "       8        20  timer   TON\n"
        "      28         1  on      BOOL\n"
    )
    assert (
        "      24         1  timer.IN         BOOL\n" in run("layout", "--deep", "Axis", project)[1]
    )


def test_layout_of_a_library_block_needs_no_path(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("layout", "TcpOpen")[1].startswith("TcpOpen: 32 bytes, alignment 4\n")
    with pytest.raises(PlcError, match="no type with a layout is called Nothing"):
        run("layout", "Nothing")


def test_errors_in_other_types_do_not_keep_a_layout_back(run: Run, project: Path) -> None:
    (project / "Bad.typ").write_text("TYPE A : Lib; B : INT := 'x'; END_TYPE")
    assert run("layout", "Axis", project)[0] == 0
    with pytest.raises(PlcError, match="no type with a layout is called A"):
        run("layout", "A", project)


def test_types_of_one_name_are_all_shown(run: Run, project: Path) -> None:
    for name in ("Belt", "Pump"):
        (project / name).mkdir()
        (project / name / "x.typ").write_text(f"TYPE T : STRING[{len(name)}]; {name} : T; END_TYPE")
    (project / "Pump" / "x.typ").write_text("TYPE T : INT; END_TYPE")
    assert run("layout", "T", project)[1] == (
        "T in folder Belt: 5 bytes, alignment 1\nT in folder Pump: 2 bytes, alignment 2\n"
    )
    assert run("layout", "T", project / "Pump")[1] == "T: 2 bytes, alignment 2\n"


def test_print_gives_the_same_declarations(run: Run, project: Path) -> None:
    code, out, _ = run("print", project / "Main", project / "Global.TYP")
    assert code == 0
    assert [type(item).__name__ for item in parse_text(out).items] == [
        *["VariableBlock", "VariableBlock", "TypeBlock"],
    ]
    assert "(*Achse für X*)" in out
    (project / "Bad.typ").write_text("TYPE A INT; END_TYPE")
    code, _, err = run("print", project / "Bad.typ")
    assert code == 1
    assert "expected ':' after the name A" in err


def test_print_writes_files_as_they_are_encoded(run: Run, project: Path) -> None:
    (project / "Bad.typ").write_text("TYPE   A INT; END_TYPE")
    data = (project / "Global.TYP").read_bytes()
    (project / "Global.TYP").write_bytes(data.replace(b"pos : ", b"pos  :"))
    (project / "Done.typ").write_text("TYPE\n\tA : INT;\nEND_TYPE\n")
    code, out, _ = run("print", "--write", project)
    assert code == 1
    assert out.splitlines() == [f"{project}/Global.TYP", f"{project}/Main/Variables.var"]
    assert (project / "Bad.typ").read_text() == "TYPE   A INT; END_TYPE"
    assert (project / "Global.TYP").read_bytes() == data
    assert run("print", "--write", project)[1] == ""


def test_our_own_library_is_sound(run: Run) -> None:
    folders = [f for f in LIBRARY.iterdir() if f.is_dir() and dialect_of(f) is AUTOMATION_STUDIO]
    assert run("check", "--strict", *folders)[0] == 0
