import re
from collections.abc import Callable
from pathlib import Path

import pytest

from plcsim.cli import st
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import PlcError

Run = Callable[..., tuple[int, str]]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    def call(*arguments: object) -> tuple[int, str]:
        parser = CommandParser()
        st.register(parser.add_subparsers(required=True))
        options = parser.parse_args(["st", *map(str, arguments)])
        code = options.func(options)
        return code, capsys.readouterr().out

    return call


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "Main").mkdir()
    (tmp_path / "Main" / "Main.st").write_bytes(
        b"PROGRAM _CYCLIC\r\n\tspeed := 1; (* \xfcber *)\r\nEND_PROGRAM\r\n"
        b"ACTION go: END_ACTION\r\n#ifdef BROKEN\r\nPROGRAM\r\n#endif\r\n"
    )
    (tmp_path / "Main" / "notes.txt").write_text("no program")
    return tmp_path


def test_sound_files_are_counted(run: Run, project: Path) -> None:
    assert run("check", "--syntax", project) == (
        0,
        (
            "1 file, 7 lines: 1 program unit, 1 action, 0 functions, 0 function blocks; "
            "0 errors, 0 warnings\n"
        ),
    )


def test_findings_have_a_place_and_a_caret_and_make_the_exit_code(run: Run, project: Path) -> None:
    path = project / "Bad.ST"
    path.write_text("FUNCTION f\n\tf := 1\nEND_FUNCTION\nACTION a: x :=; END_ACTION\n")
    code, out = run("check", "--syntax", path)
    assert code == 1
    assert out.splitlines() == [
        f"{path}:2:8: error ST1001: expected ';' after the statement, found 'END_FUNCTION'",
        "     2 |  f := 1",
        "       |        ^",
        f"{path}:4:15: error ST1001: expected a value, found ';'",
        "     4 | ACTION a: x :=; END_ACTION",
        "       |               ^",
        (
            "1 file, 4 lines: 0 program units, 1 action, 1 function, 0 function blocks; "
            "2 errors, 0 warnings"
        ),
    ]


def test_macros_come_from_the_command_line(run: Run, project: Path) -> None:
    assert run("check", "--syntax", "-D", "BROKEN", project)[0] == 1
    assert run("check", "--syntax", "-DOTHER=3", project)[0] == 0
    with pytest.raises(PlcError, match="-D 5=1: no name"):
        run("check", "--syntax", "-D5=1", project)


def test_what_cannot_be_read_is_a_finding(run: Run, tmp_path: Path) -> None:
    (tmp_path / "loop.st").symlink_to("loop.st")
    code, out = run("check", "--syntax", tmp_path)
    assert (code, "loop.st: error: Too many levels of symbolic links" in out) == (1, True)


def test_a_folder_without_programs_is_an_error(run: Run, tmp_path: Path) -> None:
    with pytest.raises(PlcError, match=r"no \.st file was found"):
        run("check", "--syntax", tmp_path)
    with pytest.raises(PlcError, match="no such file or folder"):
        run("check", "--syntax", tmp_path / "nowhere")


UNUSED = "PROGRAM p VAR n, unused : INT; d : DINT; END_VAR n := d; RETURN; n := 1; END_PROGRAM\n"


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ((), ["ST5003"]),
        (("--show", "ST5002"), ["ST5002", "ST5003"]),
        (("--show", "st5002, ST5005"), ["ST5002", "ST5005", "ST5003"]),
        (("--hide", "ST5003"), []),
    ],
)
def test_warnings_are_chosen_by_their_codes(run, tmp_path, options, told):
    (tmp_path / "p.st").write_text(UNUSED)
    code, out = run("check", *options, tmp_path / "p.st")
    assert code == 0
    assert re.findall(r"warning (ST\d+)", out) == told


def test_only_warnings_can_be_hidden(run, project):
    with pytest.raises(PlcError, match="ST1001 is no warning; there are ST5001"):
        run("check", "--hide", "ST1001", project)


def test_the_webassembly_of_a_file_names_its_lines_and_variables(run, tmp_path):
    (tmp_path / "p.st").write_text("PROGRAM p VAR a, b : DINT; END_VAR\nb := 7;\nEND_PROGRAM\n")
    code, out = run("wat", tmp_path / "p.st")
    assert code == 0
    assert f"    i32.const 0  ;; variables+4  {tmp_path / 'p.st'}:2\n" in out
    assert out.startswith('(module\n  (import "env" "memory" (memory 0))\n')
