import pytest

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.variables import own_variables
from plcsim.machine import CodeCache
from plcsim.machine.shared_module import read_shared
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text

TEXT = """
#include <bur/plctypes.h>
typedef struct Pair { BOOL on; LREAL x; } Pair;
typedef struct { char a; double x; int bits : 3; union { int i; float f; } u; void *p; } own;
UINT plain; static DINT hidden; Pair pair; own mine; char name[8]; TIME wait; const int fixed = 5;
void (*function)(void); DINT none[1];
int *_CYCLIC use(void) { static BYTE inner; return &hidden + inner++; }
"""
EXPECTED = {
    "plain": "UINT",
    "hidden": "DINT",
    "pair": "Pair",
    "mine": "own",
    "name": "STRING[7]",
    "wait": "TIME",
    "fixed": "DINT",
    "none": "ARRAY[0..0] OF DINT",
    "inner": "BYTE",
}


@pytest.fixture
def found(each_toolchain, source):
    wasm = build(
        BuildOrder("p", [source("a.c", TEXT)], [INCLUDE]), each_toolchain, CodeCache(None)
    ).wasm
    declared = parse_text("TYPE Pair : STRUCT on : BOOL; x : LREAL; END_STRUCT; END_TYPE")
    scope = Scope("p", [declared])
    module = read_shared(wasm)
    return module, scope, own_variables(module, scope, ["function"], "p")


def test_variables_have_types_of_the_controller(found):
    _, scope, variables = found
    types = {member.name: member.data_type.name for member in variables.members}
    types["mine"] = "own"  # a struct without a tag has no name
    assert types == EXPECTED
    assert variables.find("pair")[0].data_type is scope.find_type("Pair")


def test_plain_ones_lie_where_the_module_exports_them(found):
    module, _, variables = found
    for name in ("plain", "pair", "mine", "name"):
        assert variables.find(name)[1] == module.variables[name]
    assert variables.size == module.memory_size


def test_members_lie_where_the_compiler_has_put_them(found):
    _, _, variables = found
    mine = variables.find("mine")[0].data_type
    assert [(m.name, o) for m, o in zip(mine.members, mine.offsets, strict=True)] == [
        *(("a", 0), ("x", 8), ("u", 20), ("p", 24))
    ]
    assert mine.size == 32


def test_a_module_without_variables_has_none(each_toolchain, source):
    file = source("a.c", "int f(void) { return 1; }")
    module = read_shared(build(BuildOrder("p", [file]), each_toolchain, CodeCache(None)).wasm)
    assert own_variables(module, Scope("p", []), [], "p") is None
