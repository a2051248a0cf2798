"""Scopes of a project: what is declared where, and who sees it."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.program.declarations import Declarations
from plcsim.program.layout import folder_layout
from st_types.types.elementary import INT, UINT

BLOCK = "FUNCTION_BLOCK {} VAR_OUTPUT x : {}; END_VAR END_FUNCTION_BLOCK\n"


@pytest.fixture
def declare(project):
    """``declare(files, *programs, libraries=())``: the declarations of a project."""

    def declare(files, *programs, libraries=()):
        folder = project({"plc.toml": ""} | files)
        return Declarations(folder_layout(folder, programs, libraries), "cell")

    return declare


def names(scopes):
    return [scope.name for scope in scopes]


def test_a_program_sees_itself_the_folders_around_it_and_libraries(declare):
    files = {
        "Global.typ": "TYPE t : INT; u : INT; END_TYPE",
        "lines/Lines.typ": "TYPE t : UINT; v : UINT; END_TYPE",
        "lines/left/Local.typ": "TYPE v : BOOL; w : u; END_TYPE",
        "lines/right/Local.typ": "TYPE secret : BOOL; END_TYPE",
        "ramps/ramps.fun": BLOCK.format("Ramp", "t"),
        "ramps/ramps.typ": "TYPE t : LREAL; END_TYPE",
    }
    found = declare(files, "lines/left", "lines/right")
    scope = found.scope_of("lines/left")
    assert names(scope.chain)[:4] == ["left", "lines", "cell", "ramps"]
    assert "standard" in names(scope.chain)
    sizes = {name: scope.find_type(name).size for name in ("t", "u", "v", "w", "Ramp")}
    assert sizes == {"t": UINT.size, "u": INT.size, "v": 1, "w": INT.size, "Ramp": 8}
    assert scope.find_type("secret") is None
    assert found.scope_of("lines/left") is scope


def test_libraries_come_from_the_project_then_from_plc_toml_then_installed(declare, tmp_path):
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "other.fun").write_text(BLOCK.format("Other", "INT"))
    found = declare({"lib/ramps/ramps.fun": BLOCK.format("Ramp", "INT")}, libraries=[outside])
    own = [(library.name, library.package) for library in found.own_libraries]
    assert own == [("ramps", "cell.lib.ramps"), ("other", "cell.outside")]
    assert [each.name for each in found.catalogue.libraries][:2] == ["ramps", "other"]
    assert found.scope.find_type("Other") is found.own_libraries[1].scope.find_type("Other")


def test_a_library_of_the_project_takes_the_place_of_an_installed_one(declare):
    found = declare({"Standard/Standard.fun": BLOCK.format("TON", "INT")})
    assert [m.name for m in found.scope.find_type("TON").members] == ["x"]
    assert names(found.catalogue.scopes).count("standard") == 0


def test_two_libraries_of_one_name_are_refused(declare, tmp_path):
    files = {"a/ramps.fun": "", "b/Ramps.fun": ""}
    with pytest.raises(ConfigurationError, match=r"/b: library Ramps is in .*/a already"):
        declare(files)


def test_all_errors_are_told_at_once_with_file_line_and_caret(declare):
    files = {
        "Global.var": "VAR\n  a : Nothing;\nEND_VAR\n",
        "main/Variables.var": "VAR\n  b : INT := 'x';\nEND_VAR\n",
        "ramps/ramps.fun": "FUNCTION_BLOCK Ramp VAR x : INT END_VAR\n",
    }
    found = declare(files, "main")
    with pytest.raises(ConfigurationError) as raised:
        found.check()
    library, shared = raised.value.findings
    with pytest.raises(ConfigurationError) as raised:
        found.check_program("main")
    (local,) = raised.value.findings
    assert f"{found.folder}/ramps/ramps.fun:1" in library
    assert shared.splitlines()[0].endswith("Global.var:2:7: error: no type is called Nothing")
    assert local.splitlines()[0].endswith("Variables.var:2:14: error: 'x' is not a value of INT")
    assert local.splitlines()[2].endswith("^")


def test_a_type_that_nobody_declares_is_told_in_libraries_too(declare, tmp_path):
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "outside.fun").write_text(BLOCK.format("Far", "Nope"))
    found = declare({"ramps/ramps.fun": BLOCK.format("Ramp", "Nope")}, libraries=[outside])
    with pytest.raises(ConfigurationError) as raised:
        found.check()
    assert [text.splitlines()[0].partition(": ")[2] for text in raised.value.findings] == [
        "error: no type is called Nope",
        "error: no type is called Nope",
    ]


def test_warnings_do_not_stop_anything(declare):
    found = declare({"Global.typ": "TYPE Axis : INT; other : axis; END_TYPE"})
    (warning,) = found.check()
    assert "Global.typ:1:26: warning: " in warning


def test_global_variables_are_those_of_the_project_its_folders_and_its_libraries(declare):
    files = {
        "Global.var": "VAR a : INT; END_VAR VAR CONSTANT A : INT := 1; END_VAR",
        "lines/More.var": "VAR b : INT; END_VAR",
        "lines/left/Local.var": "VAR local : INT; END_VAR",
        "ramps/ramps.fun": "",
        "ramps/ramps.var": "VAR c : INT; END_VAR VAR CONSTANT C : INT := 1; END_VAR",
    }
    found = declare(files, "lines/left")
    assert [v.name for v in found.global_variables()] == ["a", "A", "b", "c"]


def test_a_global_variable_is_declared_once(declare):
    files = {"A.var": "VAR a : INT; END_VAR", "lines/B.var": "\nVAR a : INT; END_VAR"}
    files["lines/left/main.py"] = ""
    found = declare(files, "lines/left")
    assert [v.file.path for v in found.global_variables()] == [f"{found.folder}/A.var"]
    with pytest.raises(ConfigurationError) as raised:
        found.check()
    assert str(raised.value) == (
        f"{found.folder}/lines/B.var:2:5: error: the global variable a is declared in "
        f"{found.folder}/A.var:1:5 already"
    )
