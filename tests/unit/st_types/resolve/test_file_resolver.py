import pytest

from st_types.resolve.file_resolver import FileResolver
from st_types.resolve.name_index import SourceFile
from st_types.resolve.table import resolve
from st_types.syntax.declarations import parse_text
from st_types.syntax.tree import DeclarationFile, VariableBlock


def resolver(text: str) -> tuple[FileResolver, DeclarationFile]:
    file = parse_text(text, "a.typ")
    table = resolve([parse_text("TYPE Point : STRUCT x : INT; END_STRUCT; END_TYPE", "lib.typ")])
    return FileResolver(table, SourceFile(file)), file


@pytest.mark.parametrize(
    ("specification", "name", "size"),
    [
        ("int", "INT", 2),
        ("Tod", "TIME_OF_DAY", 4),
        ("STRING", "STRING[80]", 81),
        ("wstring", "WSTRING[80]", 162),
        ("WSTRING[3]", "WSTRING[3]", 8),
        ("POINT", "Point", 2),
        ("ARRAY[1..2, 0..2] OF Point", "ARRAY[1..2, 0..2] OF Point", 12),
        ("REFERENCE TO Point", "REFERENCE TO Point", 4),
        ("USINT(1..5)", "here", 1),
        ("(a, b)", "here", 4),
        ("STRUCT a : BOOL; b : DINT; END_STRUCT", "here", 8),
    ],
)
def test_specifications(specification: str, name: str, size: int) -> None:
    found, file = resolver(f"VAR x : {specification}; END_VAR")
    block = file.items[0]
    assert isinstance(block, VariableBlock)
    data_type = found.data_type(block.declarations[0].specification, "here")
    assert data_type is not None
    assert (data_type.name, data_type.size) == (name, size)


def test_an_unknown_type_is_reported_once_in_a_file() -> None:
    found, file = resolver("VAR x, y : Nowhere; z : ANY_NUM; END_VAR")
    variables = found.file_variables()
    assert [variable.data_type for variable in variables] == [None, None, None]
    assert len(file.diagnostics.records) == 1


def test_a_pointer_of_another_vendor_is_a_reference() -> None:
    found, file = resolver("VAR x : POINTER TO Point; END_VAR")
    (variable,) = found.file_variables()
    assert str(variable.data_type) == "REFERENCE TO Point"
    assert file.diagnostics.records == []
