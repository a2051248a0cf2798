import pytest

from st_types.resolve.constant_resolver import MAX_NESTING, ConstantResolver, constant_of
from st_types.resolve.constants import ScopeError
from st_types.resolve.name_index import SourceFile
from st_types.resolve.table import resolve
from st_types.syntax.declarations import parse_text
from st_types.syntax.expressions import Name
from st_types.syntax.literals import Constant
from st_types.syntax.tree import VariableBlock
from st_types.types.derived import EnumerationType
from st_types.types.elementary import INT, REAL


def resolver(text: str, other: str = "") -> ConstantResolver:
    file, second = parse_text(text, "P/a.var"), parse_text(other, "P/b.var")
    return ConstantResolver(resolve([file, second]), SourceFile(file))


def test_names_are_looked_up_from_the_inside_out() -> None:
    found = resolver(
        "VAR CONSTANT red : INT := 1; END_VAR", "TYPE Colour : (green, red := 7); END_TYPE"
    )
    assert found.constant("RED") == Constant("INT", 1)
    assert found.constant("green") == Constant("Colour", 0)
    assert found.constant("Colour.Red") == Constant("Colour", 7)
    assert found.constant("Colour.blue") is None
    assert found.constant("Nothing.red") is None
    found.local["RED"] = Constant("INT", 5)
    assert found.constant("red") == Constant("INT", 5)


def test_the_expected_enumeration_comes_before_constants() -> None:
    found = resolver("VAR CONSTANT red : INT := 1; END_VAR")
    colour = EnumerationType[int]("Colour", {"red": 3})
    assert found.evaluate(Name(0, "red"), colour) == Constant("Colour", 3)
    assert found.evaluate(Name(0, "red")) == Constant("INT", 1)


@pytest.mark.parametrize(
    "text",
    [
        "VAR CONSTANT x : Lib := 1; END_VAR",
        "VAR CONSTANT x : ARRAY[0..1] OF INT := [1, 2]; END_VAR",
        "VAR CONSTANT x : INT := SIZEOF(y); END_VAR",
    ],
)
def test_a_known_name_without_a_value(text: str) -> None:
    with pytest.raises(ScopeError):
        resolver(text).constant("x")


def test_reversed_constants_are_followed_up_to_a_depth() -> None:
    constants = "".join(f"C{i} : DINT := C{i + 1} + 1; " for i in range(MAX_NESTING + 20))
    text = f"VAR CONSTANT {constants} C{MAX_NESTING + 20} : DINT := 0; END_VAR"
    file = parse_text(text)
    table = resolve([file])
    assert f"more than {MAX_NESTING} declarations" in file.diagnostics.records[0].message
    assert table.variables[-5].initial == 4


def test_whole_numbers_only() -> None:
    found = resolver("VAR CONSTANT r : REAL := 1.5; n : INT := 3; END_VAR")
    assert found.integer(Name(0, "n")) == 3
    assert found.integer(Name(0, "r")) is None
    assert "expected a whole number, found 1.5" in str(found.owner.file.diagnostics.records[-1])


def test_what_is_a_constant() -> None:
    file = parse_text("VAR CONSTANT given : INT := 5; empty : REAL; END_VAR")
    block = file.items[0]
    assert isinstance(block, VariableBlock)
    given, empty = block.declarations
    assert constant_of(given, INT, 5) == Constant("INT", 5)
    assert constant_of(given, INT, [5]) is None
    assert constant_of(given, None, 5) is None
    assert constant_of(empty, REAL, None) == Constant("REAL", 0.0)
    assert constant_of(empty, None, None) is None
