from st_types.syntax.declarations import parse_text
from st_types.syntax.tree import Declaration, NamedType


def test_nodes_compare_without_place_comments_and_blanks() -> None:
    first = parse_text("TYPE (* a *) A : STRUCT (* b *) x : INT := 5; END_STRUCT; END_TYPE")
    second = parse_text("\n\ntype\nA : struct x:INT:=5 END_STRUCT (* c *); END_TYPE (* d *)")
    assert first == second
    assert first != parse_text("TYPE A : STRUCT x : INT := 6; END_STRUCT; END_TYPE")
    assert first != parse_text("TYPE B : STRUCT x : INT := 5; END_STRUCT; END_TYPE")


def test_a_declaration_may_be_made_by_hand() -> None:
    node = Declaration(0, "x", NamedType(0, "INT"))
    assert node == parse_text("VAR x : INT; END_VAR").items[0].declarations[0]


def test_a_file_knows_its_name() -> None:
    assert parse_text("", "Types.typ").path == "Types.typ"
