"""Names and types of files wherever their declarations lie."""

import pytest

from plcsim.cli.st_check import check_files
from plcsim.program.structured_text.sources import read_files

PACKAGE = '<?xml version="1.0"?><Package><Objects>{}</Objects></Package>'
PROGRAM = '<?xml version="1.0"?><Program><Files>{}</Files></Program>'
ADD = "a := b + 1;"


@pytest.fixture
def check(project):
    """``check(files)``: what is found in the .st files of a tree, ``file:line:column CODE``."""

    def check(files, *names):
        folder = project(files)
        paths = [folder / name for name in names] or sorted(folder.rglob("*.st"))
        parsed = [file.parsed for file in read_files(paths)]
        told = check_files(paths if names else [folder], parsed)
        found = [line.replace(f"{folder}/", "") for line in told]
        for file in parsed:
            name = file.path.removeprefix(f"{folder}/")
            found += [f"{name}:{r.line}:{r.column} {r.code}" for r in file.diagnostics.records]
        return found

    return check


def unit(text, name="_CYCLIC"):
    return f"PROGRAM {name}\n{text}\nEND_PROGRAM\n"


def test_files_of_a_folder_are_one_program(check):
    files = {
        "main/Main.st": unit("Calc; c := 1;"),
        "main/Calc.st": f"ACTION Calc:\n{ADD}\nEND_ACTION\n",
        "main/actions/More.st": "ACTION More:\nd := 1;\nEND_ACTION\n",
        "main/Init.st": unit("More;", "_INIT"),
        "main/Main.var": "VAR a : INT; b : INT; END_VAR\n",
    }
    assert check(files) == ["main/Main.st:2:7 ST2001", "main/actions/More.st:2:1 ST2001"]


def test_programs_of_a_project_see_its_variables_and_libraries(check):
    files = {
        "plc.toml": "",
        "Global.var": "VAR a : INT; END_VAR\n",
        "lib/lib.fun": "FUNCTION half : INT VAR_INPUT n : INT; END_VAR END_FUNCTION\n",
        "lib/half.st": "FUNCTION half\nhalf := m / 2;\nEND_FUNCTION\n",
        "main/Main.st": unit("a := half(b); t(IN := TRUE);"),
        "main/Main.var": "VAR b : INT; t : TON; END_VAR\n",
    }
    assert check(files) == ["lib/half.st:2:9 ST2001"]


def test_the_lists_of_a_logical_view_say_what_is_a_program(check):
    listed = PROGRAM.format("<File>Main.st</File><File>Main.var</File>")
    objects = '<Object Type="Program" Language="IEC">Main</Object>'
    files = {
        "cell.apj": "",
        "Logical/Package.pkg": PACKAGE.format(f'{objects}<Object Type="File">G.var</Object>'),
        "Logical/G.var": "VAR a : INT; END_VAR\n",
        "Logical/Main/IEC.prg": listed,
        "Logical/Main/Main.st": unit(ADD),
        "Logical/Main/Main.var": "VAR b : INT; END_VAR\n",
        "Logical/Main/Old.st": unit(ADD),
    }
    assert check(files) == ["Logical/Main/Old.st:1:1 ST1002"]


def test_standard_files_stand_alone_and_see_functions_beside_them(check):
    files = {
        "half.st": "FUNCTION Half : INT VAR_INPUT n : INT; END_VAR Half := n / 2; END_FUNCTION\n",
        "a.st": "PROGRAM main\nVAR x : INT; END_VAR\nX := HALF(x);\nEND_PROGRAM\n",
        "b.st": "PROGRAM main\nVAR y : INT; END_VAR\nx := 1;\nEND_PROGRAM\n",
    }
    assert check(files) == ["b.st:3:1 ST2001"]


def test_errors_in_declarations_are_told(check):
    files = {
        "main/Main.st": unit("a.x := 1;"),
        "main/Main.var": "VAR a : Missing; END_VAR\n",
    }
    found = check(files)
    assert found[0].startswith("main/Main.var:1:9: error")
    assert found[1:] == ["main/Main.st:2:1 ST2003"]


def test_what_has_errors_in_its_syntax_is_left_out(check):
    files = {"main/Main.st": unit("a := ;"), "main/Other.st": unit("a := 1;", "_INIT")}
    assert check(files) == ["main/Main.st:2:6 ST1001", "main/Other.st:2:1 ST2001"]


def test_a_file_alone_sees_its_folder_and_none_below(check):
    files = {
        "a.st": unit("x := y;"),
        "a.var": "VAR x : INT; END_VAR\n",
        "below/b.var": "VAR y : Nonsense; END_VAR\n",
    }
    assert check(files, "a.st") == ["a.st:2:6 ST2001"]
    assert check(files | {"plc.toml": ""}, "a.st") == ["a.st:2:6 ST2001"]


def test_several_programs_in_a_file_are_checked_each_for_itself(check):
    text = (
        "FUNCTION_BLOCK F VAR a : INT; END_VAR a := nothing; END_FUNCTION_BLOCK\n"
        "PROGRAM one VAR a : INT; f : F; END_VAR a := 1; f(); END_PROGRAM\n"
        "PROGRAM two VAR b : INT; END_VAR a := 1; END_PROGRAM\n"
        "CONFIGURATION c VAR_CONFIG one.a AT %IW1 : INT; END_VAR END_CONFIGURATION\n"
    )
    found = check({"main.st": text})
    places = ["1:44 ST2001", "3:34 ST2001", "4:17 ST1001"]
    assert sorted(set(found)) == [f"main.st:{place}" for place in places]


def test_programs_in_files_of_their_own_name_each_other(check):
    files = {
        "main.st": unit("VAR n : INT; END_VAR sub(k := 2);\nn := sub.m + sub.o;", "main"),
        "sub.st": "PROGRAM sub VAR_INPUT k : INT; END_VAR VAR m : INT; END_VAR END_PROGRAM",
    }
    assert check(files) == ["main.st:3:18 ST2002"]
