import pytest

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.static_library import StaticLibrary
from plcsim.core.errors import ConfigurationError
from plcsim.machine import CodeCache
from plcsim.machine.shared_module import read_shared

LIBRARY = {
    "lib.h": "int used(int); int other(int);",
    "used.c": '#include "lib.h"\nint deeper(int);\nint used(int x) { return deeper(x) + 1; }',
    "deeper.c": "int deeper(int x) { return 2 * x; }",
    "unused.c": "int nowhere(int);\nint other(int x) { return nowhere(x); }",
}


def module(source, toolchain, text, libraries=(), name="main.c"):
    order = BuildOrder("program", [source(name, text)], [INCLUDE], libraries=libraries)
    return read_shared(build(order, toolchain, CodeCache(None)).wasm)


def test_of_a_static_library_is_linked_what_is_needed(source, each_toolchain, tmp_path):
    folder = tmp_path / "lib"
    folder.mkdir()
    for name, text in LIBRARY.items():
        (folder / name).write_text(text)
    library = StaticLibrary(sorted(folder.glob("*.c")), (folder,))
    text = f'#include "{folder}/lib.h"\nint run(void) {{ return used(3); }}'
    linked = module(source, each_toolchain, text, [library])
    assert {"run", "used", "deeper"} <= set(linked.functions)
    assert "other" not in linked.functions
    assert linked.called == {}


def test_a_library_whose_headers_nobody_reads_is_not_compiled(source, toolchain, tmp_path):
    file = source("broken.c", "this is no C")
    library = StaticLibrary([file], (tmp_path / "elsewhere",))
    assert module(source, toolchain, "int run(void) { return 1; }", [library]).called == {}


def test_a_weak_function_is_the_modules_own(source, each_toolchain):
    text = (
        "__attribute__((weak)) int weak(int x) { return x; }\nint run(int x) { return weak(x); }\n"
    )
    linked = module(source, each_toolchain, text)
    assert linked.called == {}
    assert "weak" in linked.functions


def test_a_strong_function_is_taken_before_a_weak_one(source, toolchain, tmp_path):
    files = [
        source("a.c", "__attribute__((weak)) int f(void) { return 1; }\nint run(void);"),
        source("b.c", "int f(void) { return 2; }\nint run(void) { return f(); }"),
    ]
    order = BuildOrder("program", files, [INCLUDE])
    assert read_shared(build(order, toolchain, CodeCache(None)).wasm).called == {}


def test_a_variable_with_two_initial_values_is_refused_with_both_places(source, each_toolchain):
    head = "#include <bur/plctypes.h>\n"
    files = [
        source("a.c", f"{head}_GLOBAL UDINT speed = 1;\n"),
        source("b.c", f"{head}\n_GLOBAL UDINT speed = 2;\n"),
        source("c.c", f"{head}_GLOBAL UDINT speed;\nvoid _CYCLIC run(void) {{ speed++; }}\n"),
    ]
    with pytest.raises(ConfigurationError) as refused:
        build(BuildOrder("program", files, [INCLUDE]), each_toolchain, CodeCache(None))
    (finding,) = refused.value.args
    assert f"speed has an initial value at {files[0]}:2 and at {files[1]}:3" in finding
    build(BuildOrder("program", files[1:], [INCLUDE]), each_toolchain, CodeCache(None))
