import pytest

from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text
from st_types.types.derived import ReferenceType


def scope_of(text: str) -> Scope:
    point = parse_text("TYPE Point : STRUCT x : INT; END_STRUCT; END_TYPE", "lib.typ")
    return Scope("test", [parse_text(text, "a.typ")], [Scope("lib", [point])])


@pytest.mark.parametrize(
    ("specification", "name", "size"),
    [
        ("int", "INT", 2),
        ("Tod", "TIME_OF_DAY", 4),
        ("STRING", "STRING[80]", 81),
        ("wstring", "WSTRING[80]", 162),
        ("WString", "WSTRING[80]", 162),
        ("WSTRING[3]", "WSTRING[3]", 8),
        ("Point", "Point", 2),
        ("ARRAY[1..2, 0..2] OF Point", "ARRAY[1..2, 0..2] OF Point", 12),
        ("REFERENCE TO Point", "REFERENCE TO Point", 4),
        ("USINT(1..5)", "x", 1),
        ("(a, b)", "x", 4),
        ("STRUCT a : BOOL; b : DINT; END_STRUCT", "x", 8),
    ],
)
def test_specifications(specification: str, name: str, size: int) -> None:
    (variable,) = scope_of(f"VAR x : {specification}; END_VAR").variables
    assert variable.data_type is not None
    assert (variable.data_type.name, variable.data_type.size) == (name, size)


def test_an_unknown_type_is_reported_once_in_a_file() -> None:
    scope = scope_of(
        "VAR x, y : Nowhere; z : ANY_NUM; END_VAR "
        "FUNCTION_BLOCK F VAR x : Nowhere; END_VAR END_FUNCTION_BLOCK"
    )
    scope.check()
    assert [variable.data_type for variable in scope.variables] == [None, None, None]
    assert [str(record) for record in scope.files[0].diagnostics.records] == [
        "a.typ:1:67: warning: no type is called Nowhere"
    ]


def test_a_pointer_of_another_vendor_is_a_reference() -> None:
    scope = scope_of("VAR x : POINTER TO Point; END_VAR")
    (variable,) = scope.variables
    assert isinstance(variable.data_type, ReferenceType)
    assert variable.data_type.name == "POINTER TO Point"
    assert variable.data_type.is_pointer
    assert variable.data_type.target is scope.find_type("Point")


def test_what_a_reference_refers_to_is_found_when_it_is_asked_for() -> None:
    scope = scope_of("VAR x : REFERENCE TO Nowhere; END_VAR")
    (variable,) = scope.variables
    assert scope.files[0].diagnostics.records == []
    scope.check()
    assert len(scope.files[0].diagnostics.records) == 1
    assert isinstance(variable.data_type, ReferenceType)
    assert variable.data_type.target is None


NESTED = "ARRAY[0..0] OF " * 45


@pytest.mark.parametrize("count", [1, 5, 60])
def test_any_nesting_is_resolved_or_reported(count: int) -> None:
    types = "".join(
        f"T{i} : STRUCT x : {NESTED} STRUCT y : {NESTED} T{i + 1}; END_STRUCT; END_STRUCT; "
        for i in range(count)
    )
    scope = scope_of(f"TYPE {types} T{count} : INT; END_TYPE")
    scope.check()
    found = [record.message for record in scope.files[0].diagnostics.records]
    assert found
    assert all("nested too deep" in text or "more than 50" in text for text in found)


def test_any_nesting_of_values_is_worked_out_or_reported() -> None:
    opened, closed = "1 + (" * 45, ")" * 45
    types = "".join(f"E{i} : (a{i} := {opened} a{i + 1} {closed}); " for i in range(60))
    scope = scope_of(f"TYPE {types} E60 : (a60 := 1); END_TYPE")
    scope.check()
    found = [record.message for record in scope.files[0].diagnostics.records]
    assert found
    assert all("too many declarations" in text for text in found)
