from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC
from st_types.resolve.index import ScopeIndex
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text


def scope_of(**texts: str) -> Scope:
    return Scope("test", [parse_text(text, path) for path, text in texts.items()])


def index_of(**texts: str) -> ScopeIndex:
    return scope_of(**texts).index


def test_what_is_indexed() -> None:
    index = index_of(
        a="TYPE T : INT; E : (red, green); END_TYPE VAR CONSTANT MAX : INT; END_VAR "
        "VAR x : INT; END_VAR FUNCTION_BLOCK F VAR y : INT; END_VAR END_FUNCTION_BLOCK "
        "FUNCTION G : INT END_FUNCTION"
    )
    assert list(index.names("types")) == ["T", "E", "F"]
    assert list(index.names("constants")) == ["MAX", "red", "green"]
    assert list(index.names("variables")) == ["MAX", "x"]
    assert list(index.names("functions")) == ["G"]
    assert [entry.is_constant for entry in index.variables] == [True, False]


def test_of_equal_names_the_first_is_meant_and_a_constant_before_an_enumeration_value() -> None:
    index = index_of(
        a="TYPE T : (red); T : INT; END_TYPE VAR CONSTANT red : INT := 4; END_VAR",
        b="TYPE T : BOOL; END_TYPE",
    )
    assert index.names("types")["T"] is index.types[0]
    assert index.names("constants")["red"] is index.variables[0]


def test_declared_twice_in_a_file_is_an_error_and_in_two_files_a_warning() -> None:
    text = "TYPE T : INT; END_TYPE"
    scope = scope_of(a=text + "\nTYPE T : BOOL; t : INT; END_TYPE", b=text)
    assert scope.index.report_duplicates(AUTOMATION_STUDIO)
    assert [str(d) for file in scope.files for d in file.diagnostics.records] == [
        "a:2:6: error: T is declared twice; first at a:1:6",
        "b:1:6: warning: T is declared twice; first at a:1:6",
    ]


def test_only_in_a_case_blind_dialect_is_another_case_the_same_name() -> None:
    scope = scope_of(a="VAR x : INT; X : INT; END_VAR")
    assert not scope.index.report_duplicates(AUTOMATION_STUDIO)
    assert scope.index.report_duplicates(IEC)
    assert [str(d) for d in scope.files[0].diagnostics.records] == [
        "a:1:14: error: X is declared twice; first at a:1:5"
    ]
