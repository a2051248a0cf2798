"""``plcsim types library``: interface.py of libraries."""

import pytest

from plcsim.cli.main import main

BLOCK = "FUNCTION_BLOCK {0} VAR x : {1}; END_VAR END_FUNCTION_BLOCK\n"


@pytest.fixture
def folder(project):
    """A project with two libraries, one of which uses a block of the other."""
    return project(
        {
            "plc.toml": '[task_class.1]\nprograms = ["main"]\n',
            "lib/ramps/ramps.fun": BLOCK.format("Ramp", "Add"),
            "adds/adds.fun": BLOCK.format("Add", "TON"),
        }
    )


def test_the_file_is_written_once(folder, capsys):
    ramps = folder / "lib" / "ramps"
    assert main(["types", "library", str(ramps)]) == 0
    file = ramps / "interface.py"
    assert capsys.readouterr().out == f"{file}\n"
    text = file.read_text()
    assert "class Ramp(FunctionBlock):" in text
    assert "    from ...adds import Add\n" in text
    assert main(["types", "library", str(ramps)]) == 0
    assert capsys.readouterr().out == ""


def test_whether_it_is_fresh_can_be_checked(folder, capsys):
    arguments = ["types", "library", "--check", str(folder / "adds")]
    assert main(arguments) == 1
    assert capsys.readouterr().err == f"{folder / 'adds' / 'interface.py'}: is not fresh\n"
    assert main(["types", "library", str(folder / "adds")]) == 0
    assert main(arguments) == 0
    (folder / "adds" / "adds.fun").write_text(BLOCK.format("Add", "TOF"))
    assert main(arguments) == 1


def test_a_library_that_lies_anywhere(tmp_path):
    (tmp_path / "a.fun").write_text(BLOCK.format("A", "TON"))
    assert main(["types", "library", str(tmp_path)]) == 0
    assert "from plcsim.library.standard import TON" in (tmp_path / "interface.py").read_text()


def test_what_is_wrong_is_told(tmp_path, capsys):
    assert main(["types", "library", str(tmp_path)]) == 1
    assert "no .typ, .var or .fun file was found" in capsys.readouterr().err
    (tmp_path / "a.fun").write_text("FUNCTION_BLOCK A VAR x : INT\n")
    assert main(["types", "library", str(tmp_path)]) == 1
    assert "a.fun:1" in capsys.readouterr().err
    assert not (tmp_path / "interface.py").exists()


def test_a_folder_that_cannot_be_written_is_named(tmp_path, capsys):
    (tmp_path / "a.fun").write_text(BLOCK.format("A", "TON"))
    (tmp_path / "interface.py").mkdir()
    assert main(["types", "library", str(tmp_path)]) == 1
    assert "interface.py: cannot be written: Is a directory" in capsys.readouterr().err


def test_a_project_and_its_programs_have_stubs(folder, capsys):
    (folder / "Global.typ").write_text("TYPE Mode : (OFF, ON); END_TYPE\n")
    (folder / "Global.var").write_text("VAR CONSTANT MOST : UINT := 5; END_VAR\n")
    program = folder / "main"
    program.mkdir()
    (program / "Types.typ").write_text(
        "TYPE Axis : STRUCT mode : Mode; ramp : Ramp; t : TON; END_STRUCT; END_TYPE\n"
    )
    assert main(["types", "library", str(folder), str(program)]) == 0
    stubs = [folder / "__init__.pyi", program / "__init__.pyi"]
    assert capsys.readouterr().out.split() == [str(stub) for stub in stubs]
    assert "class Mode(IntEnum):" in stubs[0].read_text()
    assert "MOST: Final = 5" in stubs[0].read_text()
    text = stubs[1].read_text()
    assert "class Axis(Struct):" in text
    assert "from .. import Mode\n" in text
    assert "from ..lib.ramps import Ramp\n" in text
    assert "from plcsim.library.standard import TON\n" in text
    assert "    mode: Mode\n" in text
    assert main(["types", "library", "--check", str(folder), str(program)]) == 0
    assert not (program / "interface.py").exists()
