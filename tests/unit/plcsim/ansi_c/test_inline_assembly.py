import pytest

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.inline_assembly import without_rdtsc
from plcsim.ansi_c.rewriting import Rewriting
from plcsim.core.errors import ConfigurationError
from plcsim.machine import CodeCache

SOURCE = """
unsigned low, high;
unsigned long long now(void)
{
	__asm__ __volatile__(
		"rdtsc"
		: "=a" (low),
		"=d" (high)
	);
	return ((unsigned long long)high << 32) | low;
}
"""


@pytest.mark.parametrize(
    "text",
    [
        '__asm__ __volatile__("rdtsc" : "=a" (low), "=d" (high));',
        'asm volatile ("rdtsc\\n" : "=A"(ticks));',
        '__asm("rdtsc" : "=a"(low), "=d"(high) : : "memory");',
    ],
)
def test_reading_the_processors_clock_reads_the_controllers(text):
    changed = without_rdtsc(text.encode())
    assert b"asm" not in changed
    assert changed.count(b" = ") == text.count('"=') + 1


def test_lines_stay_where_they_are():
    assert without_rdtsc(SOURCE.encode()).count(b"\n") == SOURCE.count("\n")


def test_a_source_that_reads_it_compiles_and_keeps_its_name(source, each_toolchain):
    file = source("main.c", SOURCE + "int wrong(void) { return missing; }")
    with pytest.raises(ConfigurationError) as refused:
        build(BuildOrder("program", [file], [INCLUDE]), each_toolchain, CodeCache(None))
    (finding,) = refused.value.args
    assert finding.startswith(f"{file}:12:")
    assert "missing" in finding


def test_other_assembler_is_told_as_such(source, toolchain):
    file = source("main.c", 'int f(void) { int x; __asm__("cpuid" : "=a"(x)); return x; }')
    with pytest.raises(ConfigurationError, match="assembler of the controller's processor"):
        build(BuildOrder("program", [file], [INCLUDE]), toolchain, CodeCache(None))


def test_nothing_is_written_for_other_sources(tmp_path):
    file = tmp_path / "a.c"
    file.write_text("int rdtsc;")
    assert Rewriting(file, lambda: tmp_path / "0.o").options() == []
    assert list(tmp_path.iterdir()) == [file]
