import pytest

from st_types.resolve.constant_lookup import ConstantLookup, constant_of
from st_types.resolve.constants import UnknownValueError, names_in
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text
from st_types.syntax.literals import Constant
from st_types.syntax.tree import VariableBlock

from ..checked import checked


def lookup(text: str, outer: str = "") -> ConstantLookup:
    around = Scope("outer", [parse_text(outer, "b.var")])
    return ConstantLookup(Scope("inner", [parse_text(text, "a.var")], [around]))


def test_names_are_looked_up_from_the_inside_out() -> None:
    found = lookup(
        "VAR CONSTANT red : INT := 1; END_VAR", "TYPE Colour : (green, red := 7); END_TYPE"
    )
    assert found.constant("red", 0) == Constant("INT", 1)
    assert found.constant("green", 0) == Constant("Colour", 0)
    assert found.constant("Colour.red", 0) == Constant("Colour", 7)
    assert found.constant("Colour.blue", 0) is None
    assert found.constant("Nothing.red", 0) is None
    found = lookup("TYPE Colour : (red := 7); END_TYPE", "VAR CONSTANT red : INT := 1; END_VAR")
    assert found.constant("red", 0) == Constant("Colour", 7)


@pytest.mark.parametrize(
    "text",
    [
        "VAR CONSTANT x : Lib := 1; END_VAR",
        "VAR CONSTANT x : ARRAY[0..1] OF INT := [1, 2]; END_VAR",
        "VAR CONSTANT x : INT := SIZEOF(y); END_VAR",
    ],
)
def test_a_known_name_without_a_value(text: str) -> None:
    with pytest.raises(UnknownValueError):
        lookup(text).constant("x", 0)


@pytest.mark.parametrize("direction", [1, -1])
def test_a_long_chain_of_constants_is_no_nesting(direction: int) -> None:
    constants = [f"C{i} : DINT := -(C{i + 1}) + 1;" for i in range(2000)][::direction]
    text = f"VAR CONSTANT {' '.join(constants)} C2000 : DINT := 5; END_VAR"
    scope = Scope("test", [parse_text(text)])
    assert scope.constant("C0") == Constant("DINT", 5)
    assert scope.constant("C1") == Constant("DINT", -4)
    assert scope.files[0].diagnostics.records == []


def test_a_chain_through_bounds_is_followed_up_to_a_depth() -> None:
    constants = "".join(
        f"C{i} : ARRAY[0..D{i + 1}] OF INT; D{i} : DINT(0..D{i + 1}); " for i in range(200)
    )
    scope = checked([parse_text(f"VAR CONSTANT {constants} D200 : DINT := 5; END_VAR")])
    messages = {record.message for record in scope.files[0].diagnostics.records}
    assert "too many declarations depend one on the other" in messages


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("1", []),
        ("-(a + b) * c", ["a", "b", "c"]),
        ("[a, 2(b), n(c, 1)]", ["a", "b", "n", "c"]),
        ("(x := a, y := [(z := b)], w := Colour.red)", ["a", "b"]),
    ],
)
def test_names_in_values(text: str, names: list[str]) -> None:
    (block,) = parse_text(f"VAR v : INT := {text}; END_VAR").items
    assert isinstance(block, VariableBlock)
    initial = block.declarations[0].initial
    assert initial is not None
    assert list(names_in(initial)) == names


def test_what_is_a_constant() -> None:
    scope = checked(
        [
            parse_text(
                "VAR CONSTANT given : INT := 5; empty : REAL; list : ARRAY[0..1] OF INT := [5]; "
                "unknown : Lib; END_VAR"
            )
        ]
    )
    given, empty, a_list, unknown = scope.index.variables
    assert constant_of(given) == Constant("INT", 5)
    assert constant_of(empty) == Constant("REAL", 0.0)
    for entry in (a_list, unknown):
        with pytest.raises(UnknownValueError):
            constant_of(entry)
