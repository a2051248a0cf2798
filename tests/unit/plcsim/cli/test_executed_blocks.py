from plcsim.cli.executed_blocks import executed_blocks
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text

R_TRIG = """
FUNCTION_BLOCK R_TRIG
    VAR_INPUT CLK : BOOL; END_VAR VAR_OUTPUT Q : BOOL; END_VAR VAR M : {}; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Other END_FUNCTION_BLOCK
"""


def found_for(internal: str) -> dict[str, tuple[str, str]]:
    scope = Scope("lib", [parse_text(R_TRIG.format(internal))])
    return {data_type.name: place for data_type, place in executed_blocks([scope]).items()}


def test_a_class_executes_the_block_of_its_name_with_the_same_members() -> None:
    assert found_for("BOOL") == {"R_TRIG": ("plcsim.library.standard", "R_TRIG")}
    assert found_for("USINT") == found_for("Unknown") == {}
