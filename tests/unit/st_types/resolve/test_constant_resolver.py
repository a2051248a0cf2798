from st_types.resolve.constant_resolver import ConstantResolver
from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC, Dialect
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text
from st_types.syntax.expressions import Name
from st_types.syntax.literals import Constant
from st_types.types.derived import EnumerationType


def resolver(text: str, dialect: Dialect = AUTOMATION_STUDIO) -> ConstantResolver:
    file = parse_text(text, "P/a.var")
    return ConstantResolver(Scope("P", [file], dialect=dialect), file)


COLOUR = EnumerationType[int]("Colour", {"red": 3})


def test_the_expected_enumeration_comes_before_constants() -> None:
    found = resolver("VAR CONSTANT red : INT := 1; RED : INT := 2; END_VAR")
    assert found.evaluate(Name(0, "red"), COLOUR) == Constant("Colour", 3)
    assert found.evaluate(Name(0, "red")) == Constant("INT", 1)
    assert found.evaluate(Name(0, "RED"), COLOUR) == Constant("INT", 2)


def test_a_case_blind_dialect_sees_the_expected_enumeration_in_any_case() -> None:
    found = resolver("VAR CONSTANT x : INT; END_VAR", IEC)
    assert found.evaluate(Name(0, "Red"), COLOUR) == Constant("Colour", 3)
    assert found.file.diagnostics.records == []


def test_another_case_is_a_warning_that_names_both() -> None:
    found = resolver("VAR CONSTANT Max : INT := 1; END_VAR TYPE E : (On); END_TYPE")
    assert found.evaluate(Name(1, "MAX")) == Constant("INT", 1)
    assert found.constant("E.ON", 1) == Constant("E", 0)
    assert [str(record) for record in found.file.diagnostics.records] == [
        "P/a.var:1:5: warning: MAX is declared as Max; names differ in case",
        "P/a.var:1:5: warning: ON is declared as On; names differ in case",
    ]


def test_whole_numbers_only() -> None:
    found = resolver("VAR CONSTANT r : REAL := 1.5; n : INT := 3; END_VAR")
    assert found.integer(Name(0, "n")) == 3
    assert found.integer(Name(0, "r")) is None
    assert "expected a whole number, found 1.5" in str(found.file.diagnostics.records[-1])
