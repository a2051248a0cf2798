"""Which files of C go through the compiler once."""

import pytest

from plcsim.ansi_c import build as build_module
from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.loops import may_have_loops, seems_without_loops
from plcsim.machine import CodeCache

WITHOUT = {
    "none": "int f(int x) { return x + 1; }",
    "a few rounds": "int f(int *x) { int s = 0; for (int i = 0; i < 4; i++) s += x[i]; return s; }",
    "in words": '/* do it\n while */ int f(void) { return 1; } // goto\nchar *t = "for (;;)";',
}
WITH = {
    "rounds nobody knows": "int f(int *x, int n) { for (int i = 0; i < n; i++) x[i]++; return n; }",
    "many rounds": "int f(int *x) { for (int i = 0; i < 99; i++) x[i] *= x[i + 1]; return 0; }",
    "while": "int f(char *x) { int n = 0; while (x[n]) n++; return n; }",
    "one behind a short one": WITHOUT["a few rounds"] + "int g(void) { for (;;) f(0); }",
}
HIDDEN = {
    "in a header": '#include "each.h"\nint f(int *x, int n) { EACH(n) x[i]++; return n; }',
    "a call of itself at its end": "int f(int x, int n) { return n ? f(x * 3 + n, n - 1) : x; }",
    "rounds that grow": "int f(int *x) { for (int i = 0; i < 9; i += x[i]) x[i]++; return 0; }",
}


@pytest.mark.parametrize("text", WITHOUT.values(), ids=WITHOUT)
def test_a_text_without_loops(text):
    assert seems_without_loops(text)


@pytest.mark.parametrize("text", WITH.values(), ids=WITH)
def test_a_text_with_loops(text):
    assert not seems_without_loops(text)


@pytest.mark.parametrize(
    "text", ["/*" * 100_000, "for (" * 100_000, '"\\' * 100_000, "/" * 200_000]
)
def test_a_text_of_any_kind_is_looked_through_in_proportion(text):
    seems_without_loops(text)


@pytest.fixture
def runs(monkeypatch):
    """How the compiler was run: True where it made bitcode."""
    found = []
    started = build_module._started

    def note(toolchain, command):
        found.append("-emit-llvm-bc" in command)
        return started(toolchain, command)

    monkeypatch.setattr(build_module, "_started", note)
    return found


def compiled(toolchain, tmp_path, text):
    (tmp_path / "each.h").write_text("#define EACH(n) for (int i = 0; i < n; i++)\n")
    file = tmp_path / "unit.c"
    file.write_text(text)
    return build(BuildOrder("unit", [file]), toolchain, CodeCache(None))


@pytest.mark.parametrize("text", WITHOUT.values(), ids=WITHOUT)
def test_a_file_without_loops_is_compiled_once_and_is_the_same(
    each_toolchain, tmp_path, runs, monkeypatch, text
):
    once = compiled(each_toolchain, tmp_path, text)
    assert runs == [False]
    assert not may_have_loops(once.wasm)
    monkeypatch.setattr(build_module, "seems_without_loops", lambda _text: False)
    assert compiled(each_toolchain, tmp_path, text).wasm == once.wasm
    assert runs == [False, True, False]


@pytest.mark.parametrize("text", HIDDEN.values(), ids=HIDDEN)
def test_a_loop_that_the_text_does_not_show_is_found_in_the_object(
    each_toolchain, tmp_path, runs, monkeypatch, text
):
    found = compiled(each_toolchain, tmp_path, f"{text}\nint g(void) {{ int unused; return h(); }}")
    assert runs[:1] == [False]
    assert runs[-2:] == [True, False]
    assert sum("'h'" in each for each in found.warnings) <= 1
    monkeypatch.setattr(build_module, "seems_without_loops", lambda _text: False)
    again = compiled(each_toolchain, tmp_path, f"{text}\nint g(void) {{ int unused; return h(); }}")
    assert (again.wasm, again.warnings) == (found.wasm, found.warnings)
