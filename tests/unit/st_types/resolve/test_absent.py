"""What is missing where a type has no layout."""

import pytest

from st_types.resolve.absent import absent_type
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text

TYPES = """TYPE
    Motor : STRUCT
        speed : REAL;
        drive : Drive;
    END_STRUCT;
    Line : STRUCT motors : ARRAY[0..3] OF Motor; END_STRUCT;
    Bad : ARRAY[0..LAST] OF INT;
    Ring : STRUCT other : Ring2; END_STRUCT;
    Ring2 : STRUCT other : Ring; END_STRUCT;
END_TYPE
"""
BLOCKS = """FUNCTION_BLOCK Mover
    VAR_INPUT
        count : INT;
        line : Line;
    END_VAR
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("Motor", ": no type is called Drive (Machine.typ:4)"),
        ("Line", ": no type is called Drive (Machine.typ:4)"),
        ("Mover", ": no type is called Drive (Machine.typ:4)"),
        ("Bad", ""),
        ("Ring", ""),
    ],
)
def test_the_name_that_nothing_declares_is_told_with_its_place(name, reason):
    files = [parse_text(TYPES, "a/Machine.typ"), parse_text(BLOCKS, "Lib.fun")]
    scope = Scope("project", files)
    assert scope.find_type(name) is None
    hit = scope.lookup("types", name)
    assert absent_type(hit.entry) == reason
