import pytest

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import INCLUDE
from plcsim.core.errors import ConfigurationError
from plcsim.machine import CodeCache
from plcsim.machine.opcodes import EMPTY, I32_LOAD8_U, LOOP
from plcsim.machine.placement import POLL, Placement, place
from plcsim.machine.shared_module import read_shared

UNIT = """
#include <bur/plctypes.h>
#include "part.h"
_LOCAL UDINT counter;
int part(int);
void _CYCLIC main_cyclic(void) { counter += part(STEP); }
"""


def test_several_files_become_one_module(each_toolchain, source):
    source("part.h", "#define STEP 2\n")
    files = [source("main.c", UNIT), source("part.c", "int part(int a) { return a + 1; }")]
    built = build(BuildOrder("p", files, [INCLUDE]), each_toolchain, CodeCache(None))
    module = read_shared(built.wasm)
    assert "_CYCLIC" in module.functions
    assert module.addresses == ["counter"]
    assert module.called == {}


def test_c_and_cpp_are_linked(each_toolchain, source):
    files = [
        source("main.c", "int twice(int); int run(void) { return twice(4); }"),
        source("twice.cpp", 'template <class T> T d(T a) { return a + a; }\n'
               'extern "C" int twice(int a) { return d(a); }'),
    ]  # fmt: skip
    built = build(BuildOrder("p", files, [INCLUDE]), each_toolchain, CodeCache(None))
    assert {"run", "twice"} <= set(read_shared(built.wasm).functions)


def test_every_error_of_every_file_is_told_with_its_place(each_toolchain, source):
    files = [
        source("a.c", "int f(void)\n{\n  return undeclared;\n}\nint g(void) { return 1 }\n"),
        source("b.c", "#include <nowhere.h>\n"),
    ]
    with pytest.raises(ConfigurationError) as caught:
        build(BuildOrder("p", files, [INCLUDE]), each_toolchain, CodeCache(None))
    first, second, third = caught.value.findings
    assert first.startswith(f"{files[0]}:3:10: use of undeclared identifier 'undeclared'")
    assert second.startswith(f"{files[0]}:5:23: expected ';'")
    assert third.startswith(f"{files[1]}:1:10: 'nowhere.h' file not found")


def test_two_definitions_of_a_function_are_told_with_their_files(each_toolchain, source):
    files = [source("a.c", "int f(void) { return 1; }"), source("b.c", "int f(void) { return 2; }")]
    with pytest.raises(ConfigurationError) as caught:
        build(BuildOrder("program main", files, []), each_toolchain, CodeCache(None))
    assert f"f is defined at {files[0]}:1 and at {files[1]}:1" in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        'unsigned long p(void) { return "127.0.0.1"; }',
        "void q(unsigned long *a) { unsigned long b = a; *a = b; }",
        "int f(void) { return undeclared_function(3); }",
        "long *g(short *a) { return a; }",
        "static inline int h(void) { return 1; } int i(void) { return h(); }",
        "const char *built(void) { return __DATE__ __TIME__; }",
    ],
)
def test_what_the_controller_s_compiler_takes_is_taken(each_toolchain, source, text):
    build(BuildOrder("p", [source("a.c", text)], []), each_toolchain, CodeCache(None))


UNDECLARED = """
static int compare(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }
int run(char *text)
{
  int list[] = {3, 1, 2};
  qsort(list, 3, sizeof(int), compare);
  later(list[0]);
  other(list[1]);
  sprintf(text, "%d %s", list[0], text);
  return (int)(2 * atof(text)) + twice(1);
}
void later(long x) { }
int twice(int x) { return 2 * x; }
"""


def test_functions_that_are_not_declared_have_the_result_that_they_have(each_toolchain, source):
    files = [source("a.c", UNDECLARED), source("b.c", "void other(int x) { }")]
    built = build(BuildOrder("p", files, [INCLUDE]), each_toolchain, CodeCache(None))
    called = read_shared(built.wasm).called
    assert {name: (len(type_.params), type_.results) for name, type_ in called.items()} == {
        "atof": (1, "d"),
        "qsort": (4, ""),
        "sprintf": (3, "i"),
    }
    assert any("'later'" in line for line in built.warnings)


def test_warnings_are_kept_with_their_places(source, toolchain, tmp_path):
    file = source("a.c", "int f(void) { return undeclared(); }")
    cache = CodeCache(tmp_path / "cache")
    for _ in range(2):
        (warning,) = build(BuildOrder("p", [file], []), toolchain, cache).warnings
        assert warning.startswith(f"{file}:1:22: ")
        assert "undeclared" in warning


def test_nothing_is_compiled_twice(source, toolchain, tmp_path, monkeypatch):
    source("part.h", "#define STEP 2\n")
    files = [source("main.c", UNIT), source("part.c", "int part(int a) { return a + 1; }")]
    cache, order = CodeCache(tmp_path / "cache"), BuildOrder("p", files, [INCLUDE])
    first = build(order, toolchain, cache)
    compiled = counted(monkeypatch)
    assert build(order, toolchain, cache).wasm == first.wasm
    assert compiled == []


@pytest.mark.parametrize(
    ("changed", "text", "again"),
    [
        ("part.h", "#define STEP 3\n", ["main.c"]),
        ("part.c", "int part(int a) { return a + 9; }", ["part.c"]),
        ("main.c", UNIT + "\n", ["main.c"]),
    ],
)
def test_what_has_changed_is_compiled_again(
    source, toolchain, tmp_path, monkeypatch, changed, text, again
):
    source("part.h", "#define STEP 2\n")
    files = [source("main.c", UNIT), source("part.c", "int part(int a) { return a + 1; }")]
    cache, order = CodeCache(tmp_path / "cache"), BuildOrder("p", files, [INCLUDE])
    first = build(order, toolchain, cache).wasm
    source(changed, text)
    compiled = counted(monkeypatch)
    assert (build(order, toolchain, cache).wasm != first) == (changed != "main.c")
    assert compiled == again


def test_a_header_that_is_gone_is_missed(source, toolchain, tmp_path):
    header = source("part.h", "#define STEP 2\n")
    files = [source("main.c", UNIT), source("part.c", "int part(int a) { return a + 1; }")]
    cache, order = CodeCache(tmp_path / "cache"), BuildOrder("p", files, [INCLUDE])
    build(order, toolchain, cache)
    header.unlink()
    with pytest.raises(ConfigurationError, match=r"'part\.h' file not found"):
        build(order, toolchain, cache)


def test_headers_whose_folder_names_their_content_are_not_read_again(source, toolchain, tmp_path):
    source("part.h", "#define STEP 2\n")
    made = tmp_path / "made"
    made.mkdir()
    (made / "made.h").write_text("#define MADE 1\n")
    file = source(
        "main.c", '#include "part.h"\n#include <made.h>\nint f(void) { return MADE + STEP; }'
    )
    cache, order = CodeCache(tmp_path / "cache"), BuildOrder("p", [file], [made], made=made)
    first = build(order, toolchain, cache).wasm
    (made / "made.h").write_text("#define MADE 8\n")
    assert build(order, toolchain, cache).wasm == first
    source("part.h", "#define STEP 3\n")
    assert build(order, toolchain, cache).wasm != first


def test_other_options_make_another_module(source, toolchain, tmp_path):
    file, cache = source("a.c", "int f(void) { return X; }"), CodeCache(tmp_path / "cache")
    one, two = (
        build(BuildOrder("p", [file], [], [f"-DX={n}"]), toolchain, cache).wasm for n in (1, 2)
    )
    assert one != two


def test_names_with_blanks_and_signs_are_files_like_others(source, toolchain, tmp_path):
    source("my $ #1.h", "#define X 5\n")
    file = source("a b.c", '#include "my $ #1.h"\nint f(void) { return X; }')
    cache = CodeCache(tmp_path / "cache")
    first = build(BuildOrder("p", [file], []), toolchain, cache).wasm
    source("my $ #1.h", "#define X 6\n")
    assert build(BuildOrder("p", [file], []), toolchain, cache).wasm != first


def test_what_is_found_wrong_when_code_is_made_has_its_place(each_toolchain, source):
    file = source("main.c", 'void f(void)\n{\n\t__asm__ volatile("cli");\n}\n')
    with pytest.raises(ConfigurationError) as refused:
        build(BuildOrder("p", [file], []), each_toolchain, CodeCache(None))
    (finding,) = refused.value.args
    assert finding.startswith(f"{file}:3:")


NEWLIB = """
#ifndef _STDLIB_H_
#define _STDLIB_H_
#include "_ansi.h"
#include <sys/reent.h>
#include <machine/stdlib.h>
_BEGIN_STD_C
#define RAND_MAX __RAND_MAX
extern __IMPORT int __mb_cur_max;
typedef struct { int quot, rem; } div_t;
int _EXFUN(abs,(int));
_PTR _EXFUN(bsearch,(_CONST _PTR, _CONST _PTR, size_t, size_t,
	int _EXPARM(_compare,(_CONST _PTR, _CONST _PTR))));
_VOID _EXFUN(abort,(_VOID) _ATTRIBUTE ((noreturn)));
int _EXFUN(_mblen_r,(struct _reent *, const char *, size_t, _mbstate_t *));
_END_STD_C
#endif
"""


def test_a_copy_of_newlib_s_header_takes_the_place_of_ours(each_toolchain, source):
    source("AnsiCFunc.h", NEWLIB)
    text = "#include <AnsiCFunc.h>\n#include <stdlib.h>\nint f(void) { return abs(RAND_MAX); }\n"
    file = source("main.c", text)
    order = BuildOrder("p", [file], [file.parent, INCLUDE])
    assert build(order, each_toolchain, CodeCache(None)).warnings == []


LOOPS = """
float a[4], b[4];
float sum(void) { float s = 0; for (int i = 0; i < 4; i++) s += a[i] * b[i]; return s; }
int length(const char *text) { int n = 0; while (text[n] != '*') n++; return n; }
"""


def test_fixed_rounds_are_written_out_and_others_poll_every_second_time(each_toolchain, source):
    file = source("loops.c", LOOPS)
    module = read_shared(build(BuildOrder("p", [file], []), each_toolchain, CodeCache(None)).wasm)
    addresses = dict.fromkeys(module.addresses, 0)
    placed = place(module, Placement(0, 0, addresses, dict.fromkeys(module.pointers, 0)), "p")
    assert placed.wasm.count(LOOP + EMPTY + POLL) == 1
    assert placed.wasm.count(I32_LOAD8_U + b"\0") >= 2


def counted(monkeypatch):
    """Return a list of the files that are compiled from now on."""
    from plcsim.ansi_c.build import _Object

    compiled = []
    command = _Object.first_command

    def count(an_object):
        compiled.append(an_object.source.name)
        return command(an_object)

    monkeypatch.setattr(_Object, "first_command", count)
    return compiled
