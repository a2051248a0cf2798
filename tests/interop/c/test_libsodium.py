"""A C library that was not written for a controller, libsodium, and its own tests, inside a unit.

Its 36,000 lines and its tests (ISC licence) are part of the source distribution of PyNaCl, which is
taken from the package index. Each of its tests prints what it has computed into a file and compares
that with the file that comes with it; its main returns 0 where both are equal.

Left out are tests that need an operating system: ``randombytes`` (its generator), ``sodium_core``,
``sodium_utils2`` and ``sodium_utils3`` (signals for pages without access). Random numbers come from
rand() by the interface that libsodium has for that.
"""

import shutil

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.system import State
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

PACKAGE = "pynacl==1.5.0"
NEEDS_A_SYSTEM = {"randombytes", "sodium_core", "sodium_utils2", "sodium_utils3"}
LEAST_TESTS = 70
FAULT = -2
VERSION = {
    "@VERSION@": "1.0.18",
    "@SODIUM_LIBRARY_VERSION_MAJOR@": "10",
    "@SODIUM_LIBRARY_VERSION_MINOR@": "3",
    "@SODIUM_LIBRARY_MINIMAL_DEF@": "",
}
PLC = """
[plc]
memory = "128MiB"
init_timeout = "300s"
[task_class.1]
cycle = "1ms"
programs = ["main"]
[c]
heap = "96MiB"
include = ["include", "include/sodium", "quirks", "test"]
options = ["-DCONFIGURED=1", "-DRANDOMBYTES_CUSTOM_IMPLEMENTATION",
    "-DRANDOMBYTES_DEFAULT_IMPLEMENTATION=NULL", "-Wno-macro-redefined"]
[library.FileIO.devices]
"F:" = "files"
"""
UNIT = """
#include <bur/plctypes.h>
#include <randombytes.h>
#include <stdlib.h>

DINT wanted = -1;
DINT result = -1;

static uint32_t number(void) { return (uint32_t)rand() << 1 ^ (uint32_t)rand(); }
static void fill(void *const area, const size_t size)
{
	for (size_t i = 0; i < size; i++)
		((unsigned char *)area)[i] = (unsigned char)(rand() >> 8);
}
static const char *name(void) { return "rand"; }
static randombytes_implementation own = {name, number, NULL, NULL, fill, NULL};

void _INIT begin(void) { randombytes_set_implementation(&own); }
"""


@pytest.fixture(scope="session")
def libsodium(sources_of):
    """The folder of its sources."""
    folder = sources_of(PACKAGE)
    (found,) = folder.glob("*/src/libsodium")
    return found


@pytest.fixture(scope="session")
def unit(libsodium, tmp_path_factory):
    """A controller whose unit runs one of the tests in each cycle, and the tests' names."""
    cell = tmp_path_factory.mktemp("cell")
    names = [f.stem for f in sorted((libsodium / "test" / "default").glob("*.c"))]
    names = [name for name in names if name not in NEEDS_A_SYSTEM]
    sources = libsodium / "src" / "libsodium"
    without = shutil.ignore_patterns("sysrandom", "internal", "include")
    shutil.copytree(sources, cell / "main" / "libsodium", ignore=without)
    shutil.copytree(sources / "include", cell / "include")
    shutil.copytree(libsodium / "test" / "quirks", cell / "quirks")
    shutil.copytree(libsodium / "test" / "default", cell / "test")
    (cell / "files").mkdir()
    for file in (cell / "test").glob("*.exp"):
        shutil.copy(file, cell / "files")
    version = (cell / "include" / "sodium" / "version.h.in").read_text()
    for key, value in VERSION.items():
        version = version.replace(key, value)
    (cell / "include" / "sodium" / "version.h").write_text(version)
    for name in names:  # each has a main, which is the test, and one around it
        own = f'#define main {name}_test\n#define xmain {name}_inner\n#include "{name}.c"\n'
        (cell / "main" / f"test_{name}.c").write_text(own)
    declared = "".join(f"int {name}_test(void);\n" for name in names)
    cases = "".join(f"\tcase {i}: result = {name}_test(); break;\n" for i, name in enumerate(names))
    cases += f"\tcase {FAULT}: abort();\n"
    cyclic = f"void _CYCLIC run(void)\n{{\n\tswitch (wanted) {{\n{cases}\t}}\n\twanted = -1;\n}}\n"
    (cell / "main" / "unit.c").write_text(UNIT + declared + cyclic)
    (cell / "plc.toml").write_text(PLC)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("plcsim.machine.machine.UNIT_FUEL", 1 << 40)
        controller = assemble(load(read_project(cell)), clock=VirtualClock(), network=None)
        controller.boot()
        yield controller, names


@pytest.mark.timeout(900)  # the download may take 400 s, and 36,000 lines are compiled
def test_its_own_tests_pass(unit, subtests):
    controller, names = unit
    assert len(names) >= LEAST_TESTS
    wanted, result = (controller.tags.find(f"main.{name}") for name in ("wanted", "result"))
    for number, name in enumerate(names):
        with subtests.test(name):
            controller.tags.write(result, value=-1)
            controller.tags.write(wanted, value=number)
            controller.run(cycles=1)
            assert controller.state is State.RUN, controller.fault
            assert controller.tags.read(result) == 0
        controller.tags.write(wanted, value=FAULT)
        controller.run(cycles=1)
        assert controller.state is State.SERVICE
        controller.boot()  # each test finds the library as it was before its first call
