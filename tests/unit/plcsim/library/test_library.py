"""Libraries: their names, their declarations, what is wrong in them."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.library.installed import Scopes
from plcsim.library.library import (
    Library,
    check_scope,
    declarations_of,
    files_in,
    read_declarations,
)
from st_types.resolve.scope import Scope


def test_a_library_has_the_name_of_its_only_interface(library):
    assert library.name == "ramps"
    assert repr(library) == "Library(ramps)"
    assert library.scope.name == "ramps"


@pytest.mark.parametrize("names", [("a.fun", "b.fun"), ("a.var",)])
def test_else_it_has_that_of_its_folder(tmp_path, names):
    for name in names:
        (tmp_path / name).write_text("")
    assert Library(tmp_path, "x").name == tmp_path.name


def test_its_scope_sees_the_libraries_around_it(library):
    block = library.scope.find_function_block("Ramp")
    assert [m.name for m in block.data_type.members][-3:] == ["timer", "name", "level"]


def test_declaration_files_are_found_in_any_case_and_in_order(tmp_path):
    for name in ("b.VAR", "a.typ", "c.Fun", "d.st", "e.txt"):
        (tmp_path / name).write_text("")
    found = declarations_of(files_in(tmp_path))
    assert [file.name for file in found] == [
        "a.typ",
        "b.VAR",
        "c.Fun",
    ]


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(ConfigurationError, match=r"Gone\.typ"):
        read_declarations([tmp_path / "Gone.typ"])


def test_a_folder_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(ConfigurationError, match="gone: cannot be read: No such file"):
        files_in(tmp_path / "gone")


def test_errors_are_told_with_a_caret_and_warnings_are_given_back(tmp_path):
    file = tmp_path / "A.typ"
    file.write_text("TYPE\n  a : STRUCT x : Nothing; END_STRUCT;\nEND_TYPE\n")
    files = read_declarations([file])
    (warning,) = check_scope(Scope("a", files))
    assert warning.startswith(f"{file}:2:18: warning: no type is called Nothing")
    with pytest.raises(ConfigurationError) as raised:
        check_scope(Scope("a", read_declarations([file]), strict=True))
    (error,) = raised.value.findings
    assert error.splitlines() == [
        f"{file}:2:18: error: no type is called Nothing",
        "     2 |   a : STRUCT x : Nothing; END_STRUCT;",
        "       |                  ^",
    ]


def test_beside_a_library_of_plcsim_it_declares_the_rest(tmp_path):
    texts = {"ours": ("A", "B"), "theirs": ("B", "C")}
    for name, types in texts.items():
        (tmp_path / name).mkdir()
        text = "".join(f"TYPE {each} : STRUCT x : INT; END_STRUCT; END_TYPE\n" for each in types)
        (tmp_path / name / "lib.typ").write_text(text)
    ours = Library(tmp_path / "ours", "ours", name="Lib")
    theirs = Library(tmp_path / "theirs", "theirs", [ours.scope], name="Lib", beside=ours)
    assert theirs.scope.name == "Lib_more"
    assert [each.name for each in theirs.scope.types] == ["C"]
    assert theirs.scope.find_type("B") is ours.scope.find_type("B")


def test_libraries_come_behind_those_that_they_need(tmp_path):
    def library(name, *needs, strict=False):
        return Library(tmp_path, name, name=name, dependencies=needs, strict=strict, files=())

    libraries = [library("own", "VENDOR", strict=True), library("vendor", "Base"), library("base")]
    libraries += [library("round", "Trip"), library("trip", "ROUND")]
    names = [scope.name for scope in Scopes(libraries).by_dependency()]
    assert names == ["base", "vendor", "trip", "round", "own"]
    needed = [[scope.name for scope in Scopes(libraries).needed_by(each)] for each in libraries]
    assert needed[0] == ["vendor", "base"]
    assert needed[1] == ["base"]
    assert needed[2] == ["own", "vendor", "round", "trip"]  # it says nothing: all of them
    assert needed[3] == ["trip"]
