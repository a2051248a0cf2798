"""Functions that take arrays of any bounds."""

from plcsim.program.structured_text.check.open_arrays import OpenFunction, takes_any_bounds
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from st_types.resolve.dialect import IEC
from st_types.resolve.scope import Scope
from st_types.syntax.source import Source
from st_types.types.derived import ArrayType
from st_types.types.elementary import INT

TEXT = """FUNCTION f : INT VAR_IN_OUT a, b : ARRAY[*] OF INT; END_VAR f := a[1]; END_FUNCTION
FUNCTION g : INT VAR_INPUT a : ARRAY[1..2] OF INT; END_VAR VAR n : INT; END_VAR END_FUNCTION
"""


def test_the_function_is_made_once_for_bounds():
    file = parse_structured_text(Source("a.st", TEXT))
    first, second = file.units
    assert [takes_any_bounds(each.declaration) for each in (first, second)] == [True, False]
    function = OpenFunction(first, file, Scope("p", [], dialect=IEC))
    small, large = ArrayType(INT, [(1, 2)]), ArrayType(INT, [(-5, 20)])
    made = function.made_for({"a": small, "b": large})
    assert made is not None
    assert made.name == "f[1..2; -5..20]"
    assert [str(each.data_type) for each in made.variables] == [str(small), str(large)]
    assert function.made_for({"a": ArrayType(INT, [(1, 2)]), "b": large}) is made
    assert function.made_for({"a": large, "b": small}) is not made
