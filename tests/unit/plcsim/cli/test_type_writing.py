import ast
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import st_types
from plcsim.cli import types
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import PlcError

Run = Callable[..., tuple[int, str, str]]

GLOBAL = """
TYPE Axis : STRUCT pos : LREAL; timer : TON; on : BOOL; END_STRUCT; Parameters : INT; END_TYPE
VAR CONSTANT MAX : USINT := 3; END_VAR
VAR gAxis : Axis; END_VAR
"""


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    def call(*arguments: object) -> tuple[int, str, str]:
        parser = CommandParser()
        types.register(parser.add_subparsers(required=True))
        options = parser.parse_args(["types", *map(str, arguments)])
        code = options.func(options)
        return code, *capsys.readouterr()

    return call


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "plant"
    for name, text in {
        "Global.typ": GLOBAL,
        "Belt/Types.typ": "TYPE Parameters : STRUCT a : ARRAY[0..MAX] OF Axis; END_STRUCT; "
        "END_TYPE",
        "Belt/Variables.var": "VAR x : Parameters; ramp : Ramp; END_VAR "
        "VAR RETAIN n : INT; END_VAR",
        "Pump/Variables.var": "VAR x : Parameters; END_VAR",
        "Motion/Motion.fun": "FUNCTION_BLOCK Ramp VAR_INPUT t : TON; x : INT; END_VAR "
        "END_FUNCTION_BLOCK FUNCTION Scale : REAL VAR_INPUT x : REAL; END_VAR END_FUNCTION",
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def test_a_single_scope_is_printed(run: Run, project: Path) -> None:
    code, out, err = run("header", "--name", "Cell", project / "Global.typ")
    assert (code, err) == (0, "")
    assert "#ifndef _CELL_H_" in out
    assert "typedef struct TON {" in out
    assert "typedef struct Axis {\n\tdouble pos;\n\tstruct TON timer;\n\tplcbit on;\n} Axis;" in out
    code, out, err = run("python", project / "Global.typ")
    assert (code, err) == (0, "")
    names = [node.name for node in ast.parse(out).body if isinstance(node, ast.ClassDef)]
    assert names == ["TON", "Axis", "Variables"]


def test_several_scopes_want_a_folder(run: Run, project: Path) -> None:
    for command in ("header", "python"):
        with pytest.raises(PlcError) as caught:
            run(command, project)
        assert str(caught.value) == (
            "4 scopes are declared there (Motion, plant, Belt, Pump): "
            "-o FOLDER writes a file for each; a path may name one of them."
        )
    (project / "Empty.typ").write_text("")
    with pytest.raises(PlcError, match="nothing is declared there"):
        run("header", project / "Empty.typ")


def test_a_header_for_each_scope(run: Run, project: Path, tmp_path: Path) -> None:
    code, out, err = run("header", "-o", tmp_path / "out", project)
    assert (code, err) == (0, "")
    names = [Path(line).name for line in out.splitlines()]
    assert names == ["standard.h", "Motion.h", "plant.h", "Belt.h", "Pump.h"]
    texts = {name: (tmp_path / "out" / name).read_text() for name in names}
    includes = {
        name: [line for line in text.splitlines() if line.startswith('#include "')]
        for name, text in texts.items()
    }
    assert includes == {
        "standard.h": [],
        "Motion.h": ['#include "standard.h"'],
        "plant.h": ['#include "standard.h"'],
        "Belt.h": ['#include "Motion.h"', '#include "plant.h"'],
        "Pump.h": ['#include "plant.h"'],
    }
    assert "_GLOBAL struct Axis gAxis;" in texts["plant.h"]
    assert "typedef struct Parameters_ {\n\tstruct Axis a[4];\n} Parameters_;" in texts["Belt.h"]
    assert "_BUR_LOCAL_RETAIN signed short n;" in texts["Belt.h"]
    assert "_BUR_LOCAL Parameters x;" in texts["Pump.h"]
    compiled = subprocess.run(
        ["gcc", "-m32", "-Wall", "-Werror", "-fsyntax-only", "-x", "c", "-I", _include(), *names],
        cwd=tmp_path / "out",
        capture_output=True,
        text=True,
        check=False,
    )
    if "bits/" not in compiled.stderr:  # gcc-multilib is not here
        assert compiled.stderr == ""


def _include() -> str:
    return str(Path(st_types.__file__).parent / "writers" / "include")


def test_a_module_for_each_scope(run: Run, project: Path, tmp_path: Path) -> None:
    code, out, err = run("python", "-o", tmp_path / "cell", project)
    assert (code, err) == (0, "")
    names = [Path(line).name for line in out.splitlines()]
    assert names == ["__init__.py", "standard.py", "Motion.py", "plant.py", "Belt.py", "Pump.py"]
    program = (
        "from cell.Belt import Parameters, Variables\n"
        "from cell.plant import MAX, Axis, Variables as Globals\n"
        "from cell import Belt, Motion, Pump, plant\n"
        "from plcsim.library.standard import TON\n"
        "belt: Belt.Variables = Variables()\n"
        "axis: Axis = belt.x.a[MAX]\n"
        "timer: TON = axis.timer\n"
        "ramp: Motion.Ramp = belt.ramp\n"
        "number: int = Pump.Variables().x\n"
    )
    (tmp_path / "use.py").write_text(program)
    root = str(Path(st_types.__file__).parents[1])
    for command in (
        [sys.executable, "use.py"],
        [sys.executable, "-m", "mypy", "--strict", "--config-file=", "use.py", "cell"],
    ):
        done = subprocess.run(
            command,
            cwd=tmp_path,
            env={"PYTHONPATH": root, "MYPYPATH": root},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr


def test_what_is_wrong_is_told_and_the_rest_is_written(
    run: Run, project: Path, tmp_path: Path
) -> None:
    (project / "Belt" / "Bad.typ").write_text(
        "TYPE Half : STRUCT x : Lib; END_STRUCT; Whole : INT; Wrong : INT := 'x'; END_TYPE "
        "VAR v : Half; END_VAR FUNCTION F : Lib END_FUNCTION "
        "FUNCTION_BLOCK B VAR x : Lib; END_VAR END_FUNCTION_BLOCK"
    )
    for command, suffix in (("header", "h"), ("python", "py")):
        code, _, err = run(command, "-o", tmp_path / "out", project)
        assert code == 1
        assert "warning: no type is called Lib" in err
        assert "error: 'x' is not a value of INT" in err
        assert err.endswith(
            "folder Belt: left out, for a type or a size is not known: type Half, "
            "function block B, variable v, function F\n"
        )
        text = (tmp_path / "out" / f"Belt.{suffix}").read_text()
        assert "Whole" in text
        assert "Half" not in text
        assert (tmp_path / "out" / f"Pump.{suffix}").exists()


def test_names_of_files_that_would_be_equal(run: Run, tmp_path: Path) -> None:
    for name in ("A/Main", "B/main", "class", "3 D"):
        (tmp_path / "p" / name).mkdir(parents=True)
        (tmp_path / "p" / name / "x.typ").write_text("TYPE T : INT; END_TYPE")
    out = run("python", "-o", tmp_path / "out", tmp_path / "p")[1]
    names = [Path(line).name for line in out.splitlines()]
    assert sorted(names) == ["A_Main.py", "B_main.py", "_3_D.py", "__init__.py", "_class.py"]


def test_a_folder_that_cannot_be_written(run: Run, project: Path) -> None:
    with pytest.raises(PlcError, match=r"Not a directory|File exists"):
        run("header", "-o", project / "Global.typ", project)
