import subprocess

import pytest

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import (
    INCLUDE,
    body_headers,
    identity_of,
    library_headers,
    program_headers,
    written_headers,
)
from plcsim.machine import CodeCache
from plcsim.machine.shared_module import read_shared
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text

LIBRARY = """
FUNCTION_BLOCK Ramp
    VAR_INPUT enable : BOOL; target : LREAL; END_VAR
    VAR_OUTPUT value : REAL; count : LINT; END_VAR
END_FUNCTION_BLOCK
FUNCTION scale : REAL VAR_INPUT x : REAL; END_VAR END_FUNCTION
TYPE Mode : (OFF, ON := 5); END_TYPE
VAR CONSTANT rampMAX : UINT := 7; END_VAR
"""
PROGRAM = """
TYPE Part : STRUCT flag : BOOL; weight : LREAL; long_ : LINT; ramp : Ramp; END_STRUCT; END_TYPE
VAR part : Part; parts : ARRAY[1..3] OF Part; mode : Mode; name : STRING[10]; END_VAR
"""
CHECK = """
#include <AsDefault.h>
#define SAME(a, b) _Static_assert((a) == (b), #a)
SAME(sizeof(struct Ramp), 24);
SAME(__builtin_offsetof(Ramp_typ, value), 8);
SAME(__builtin_offsetof(Part, weight), 4);
SAME(__builtin_offsetof(struct Part, long_), 12);
SAME(sizeof(Part), 44);
SAME(sizeof(parts), 3 * 44);
SAME(sizeof(mode), 4);
SAME(sizeof(name), 11);
SAME(ON, 5);
SAME(rampMAX, 7);
void _CYCLIC run(void) { part.ramp.target = scale(gain); Ramp(&part.ramp); parts[2].flag = 1; }
"""


def scope(name, text, *outer):
    return Scope(name, [parse_text(text)], outer)


def all_headers(scopes, libraries):
    return {**library_headers(libraries), **program_headers(scopes, libraries)}


@pytest.fixture
def headers():
    library = scope("Motion", LIBRARY)
    project = scope("cell", "VAR gain : REAL; END_VAR", library)
    return all_headers([scope("conveyor", PROGRAM, project, library), project], [library])


def test_a_program_finds_what_is_declared_around_it(headers, each_toolchain, source, tmp_path):
    folder = written_headers("x", lambda: headers, tmp_path / "include")
    file = source("main.c", CHECK)
    built = build(BuildOrder("p", [file], [folder, INCLUDE]), each_toolchain, CodeCache(None))
    assert built.warnings == []


def test_each_library_has_its_header(headers):
    assert {"Motion.h", "AsDefault.h"} <= set(headers)
    assert "conveyor" not in headers["Motion.h"]


def test_headers_are_made_once_for_an_identity(headers, tmp_path):
    one = written_headers("x", lambda: headers, tmp_path)
    assert written_headers("x", dict, tmp_path) == one
    assert written_headers("y", lambda: headers, tmp_path) != one
    assert sorted(f.name for f in one.iterdir()) == sorted(headers)
    assert len(list(tmp_path.iterdir())) == 2


def test_an_identity_is_that_of_the_declarations():
    one, other = scope("a", PROGRAM), scope("a", PROGRAM.replace("weight", "mass"))
    assert identity_of("program", [one]) == identity_of("program", [scope("a", PROGRAM)])
    assert identity_of("program", [one]) != identity_of("program", [other])
    assert identity_of("program", [one]) != identity_of("library", [one])
    assert identity_of("program", [one, other]) != identity_of("program", [other, one])


def test_a_folder_that_cannot_be_written_is_replaced(headers):
    folder = written_headers("unwritable", lambda: headers, INCLUDE / "bur" / "plctypes.h")
    assert (folder / "AsDefault.h").is_file()


def test_what_c_has_itself_a_library_does_not_declare_again(each_toolchain, source, tmp_path):
    text = """
    FUNCTION strcpy : UDINT VAR_INPUT pDest : UDINT; pSrc : UDINT; END_VAR END_FUNCTION
    FUNCTION mine : UDINT VAR_INPUT pDest : UDINT; END_VAR END_FUNCTION
    """
    library = scope("asstring", text)
    headers = all_headers([scope("p", "")], [library])
    assert "mine(" in headers["asstring.h"]
    assert "UDINT strcpy(" not in headers["asstring.h"]
    folder = written_headers("x", lambda: headers, tmp_path / "include")
    file = source("main.c", "#include <AsDefault.h>\nchar *f(char *a) { return strcpy(a, a); }")
    built = build(BuildOrder("p", [file], [folder, INCLUDE]), each_toolchain, CodeCache(None))
    assert built.warnings == []


@pytest.mark.parametrize("more", ["", "#include <stdlib.h>\n"])
def test_itoa_is_that_of_asstring_or_that_of_c(each_toolchain, source, tmp_path, more):
    text = "FUNCTION itoa : UINT VAR_INPUT value : DINT; pDest : UDINT; END_VAR END_FUNCTION"
    headers = all_headers([scope("p", "")], [scope("asstring", text)])
    folder = written_headers("x", lambda: headers, tmp_path / "include")
    calls = {"f": "itoa(a, (UDINT)b)", "g": "itoa(a, b)", "h": "itoa(a, b, 10)[0]"}
    for name, call in calls.items():
        c = f"{more}#include <AsDefault.h>\nint {name}(int a, char *b) {{ return {call}; }}"
        order = BuildOrder("p", [source(f"{name}.c", c)], [folder, INCLUDE])
        built = build(order, each_toolchain, CodeCache(None))
        called = read_shared(built.wasm).called["itoa"]
        assert (built.warnings, len(called.params)) == ([], 3 if name == "h" else 2)


def test_what_c_has_and_a_library_does_not_name_is_free(each_toolchain, source, tmp_path):
    text = "FUNCTION atoi : DINT VAR_INPUT pText : UDINT; END_VAR END_FUNCTION"
    headers = all_headers([scope("p", "")], [scope("asstring", text)])
    folder = written_headers("x", lambda: headers, tmp_path / "include")
    c = '#include <AsDefault.h>\nsigned short random(void) { return atoi("4"); }\nint rand_r;'
    file = source("main.c", c)
    built = build(BuildOrder("p", [file], [folder, INCLUDE]), each_toolchain, CodeCache(None))
    assert built.warnings == []


def test_a_library_declares_what_one_that_it_does_not_need_has_as_well():
    other = scope("drives", LIBRARY)
    own = scope("filters", LIBRARY, other)
    assert "typedef struct Ramp {" in body_headers(own, [other], [])["filters.h"]
    assert "typedef struct Ramp {" not in body_headers(own, [other], [other])["filters.h"]


def test_cpp_passes_pointers_as_numbers(each_toolchain, source, tmp_path):
    text = """
    FUNCTION TMP_alloc : UINT VAR_INPUT size : UDINT; place : UDINT; END_VAR END_FUNCTION
    """
    headers = all_headers([scope("p", "")], [scope("sys_lib", text)])
    folder = written_headers("x", lambda: headers, tmp_path / "include")
    cpp = """extern "C" {
#include <AsDefault.h>
}
static char *area;
int f() { return TMP_alloc(sizeof(area), (void **)&area) + TMP_alloc(4, (UDINT)&area); }
"""
    build(
        BuildOrder("p", [source("main.cpp", cpp)], [folder, INCLUDE]),
        each_toolchain,
        CodeCache(None),
    )


def test_a_library_that_declares_nothing_is_brought_by_asdefault_alone():
    empty, other = (
        Scope("UnitTest", ()),
        scope("Motion", "TYPE A : STRUCT x : INT; END_STRUCT; END_TYPE"),
    )
    last = scope("Last", "TYPE B : STRUCT y : INT; END_STRUCT; END_TYPE")
    headers = all_headers([scope("p", "")], [empty, other, last])
    assert "Motion.h" in headers["Last.h"]
    assert "UnitTest.h" not in headers["Last.h"]
    assert "UnitTest.h" in headers["AsDefault.h"]


def test_types_are_those_of_the_32_bit_target(each_toolchain, source):
    """The same assertions hold for gcc -m32, where that is installed."""
    text = """
    #include <bur/plctypes.h>
    #define SAME(a, b) _Static_assert((a) == (b), #a)
    struct l { char a; LREAL b; }; struct i { char a; LINT b; }; struct p { char a; void *b; };
    SAME(sizeof(struct l), 12); SAME(sizeof(struct i), 12); SAME(sizeof(struct p), 8);
    SAME(sizeof(long), 4); SAME(sizeof(DINT), 4); SAME(sizeof(BOOL), 1); SAME(sizeof(WSTRING), 2);
    struct bits { unsigned a : 20; unsigned b : 20; unsigned char c : 3; };
    SAME(sizeof(struct bits), 8);
    enum e { A, B }; SAME(sizeof(enum e), 4);
    """
    file = source("a.c", text)
    build(BuildOrder("p", [file], [INCLUDE]), each_toolchain, CodeCache(None))
    command = ["gcc", "-m32", "-ffreestanding", "-fsyntax-only", f"-I{INCLUDE}", str(file)]
    native = subprocess.run(command, capture_output=True, text=True, check=False)
    assert "static assertion" not in native.stderr


def test_the_sources_of_a_library_see_what_it_needs_and_find_the_rest(
    each_toolchain, source, tmp_path
):
    needed = scope("Timing", "TYPE Pace : (SLOW, FAST); END_TYPE")
    other = scope("Motion", "TYPE Step : (INIT := 5, MOVE); END_TYPE")
    library = scope(
        "Bus", "FUNCTION_BLOCK Talk VAR pace : Pace; END_VAR END_FUNCTION_BLOCK", needed
    )
    headers = body_headers(library, [needed, other, library], [needed])
    folder = written_headers("bus", lambda: headers, tmp_path)
    own_names = '#include "Bus.h"\n#include <AsDefault.h>\nenum { INIT = 1 };\n'
    body = "void Talk(struct Talk* inst) { inst->pace = FAST + INIT - 1; }\n"
    for text in (own_names + body, "#include <Bus.h>\n#include <Motion.h>\nint moving = MOVE;\n"):
        order = BuildOrder("bus", [source("bus.c", text)], [folder, INCLUDE])
        assert build(order, each_toolchain, CodeCache(None)).warnings == []
