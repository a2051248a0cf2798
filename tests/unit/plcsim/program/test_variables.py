import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.core.memory import PAGE, Memory
from plcsim.core.tag import Tag
from plcsim.program.variables import variables_of
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text

TEXT = """
VAR
    a : UINT := 7;
    gone : Nothing;
END_VAR
VAR CONSTANT
    LIMIT : UDINT := 9;
END_VAR
VAR
    b : BOOL;
END_VAR
"""


def declared(text=TEXT):
    return Scope("p", [parse_text(text)]).variables


def test_variables_and_constants_lie_apart():
    variables, constants = variables_of("p", declared())
    assert [member.name for member in variables.members] == ["a", "b"]
    assert [member.name for member in constants.members] == ["LIMIT"]
    assert variables.name == "p"


def test_memory_is_reserved_and_has_the_initial_values():
    memory = Memory(4 * PAGE)
    variables, constants = variables_of("p", declared()).allocate(memory, "p")
    assert (variables.path, variables.is_constant) == ("p", False)
    assert (constants.path, constants.is_constant) == ("p", True)
    assert memory.get(variables.data_type, variables.address) == {"a": 7, "b": False}
    assert memory.get(constants.data_type, constants.address) == {"LIMIT": 9}


def test_without_constants_there_is_no_tag_of_them():
    found = variables_of("p", declared("VAR a : UINT; END_VAR"))
    tag, constants = found.allocate(Memory(4 * PAGE), "")
    assert isinstance(tag, Tag)
    assert constants is None


def test_variables_larger_than_an_address_space_are_told():
    arrays = "".join(f"a{n} : ARRAY[0..400000000] OF DINT; " for n in range(3))
    with pytest.raises(ConfigurationError, match="the variables of p: 4800000012 bytes"):
        variables_of("p", declared(f"VAR {arrays} END_VAR"))
