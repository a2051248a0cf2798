"""Test cases of the library UnitTest, as their sources name them, and what became of them."""

from pathlib import Path

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError
from plcsim.testing.unit_test import ProgramUnderTest, cases_of

from ..program.c.test_unit_test import BLOCK, HEADER, TYPES

pytest_plugins = ["pytester"]

PLACE = ProgramUnderTest("UnitTests", "ut", "Tests.ut")

SOURCE = """
_TEST adds(void)
{
\tTEST_DONE;
}
/* new_TestFixture("in a comment", adds),
*/
_TEST   subtracts( void ) { TEST_DONE; }
UNITTEST_FIXTURES(first)
{
\tnew_TestFixture("adds", adds), // new_TestFixture("no", adds)
\tnew_TestFixture("takes away // one", subtracts),
};
UNITTEST_FIXTURES(second)
{
\tnew_TestFixture("elsewhere", declared_in_another_file),
};
UNITTEST_CALLER_COMPLETE_EXPLICIT(set1, "Set one", 0, 0, first, 0, 0, 0);
UNITTEST_CALLER_TEST(set2, "Set two", second);
"""


def cases(text):
    return [(c.set, c.name, c.line) for c in cases_of(PLACE, Path("calc.c"), text)]


def test_cases_have_the_line_of_their_function():
    assert cases(SOURCE) == [
        ("Set one", "adds", 2),
        ("Set one", "takes away // one", 8),
        ("Set two", "elsewhere", 16),
    ]


def test_a_set_in_another_file_has_the_name_of_this_one():
    assert cases('TestFixture t[] = { new_TestFixture("a", f) };') == [("calc", "a", 1)]


def test_nothing_is_made_of_other_sources():
    assert cases("void _CYCLIC run(void) {}") == []


UNIT_TEST_H = f"""{HEADER}
#define new_TestFixture(name, function) {{name, 1, function}}
#define UNITTEST_FIXTURES(name) static TestFixture name[] =
#define UNITTEST_CALLER_TEST(name, text, list) TestCaller name = \\
\t{{0, text, stateStart, 0, 0, 0, sizeof list / sizeof *list, list, 0, 0, 0, 1}}
"""
TESTS_C = """
#include "UnitTest.h"
static testStatusEnum adds(void)
{
\tassertImplementationInt(7, 3 + 4, __LINE__, __FILE__);
\treturn ut_DONE;
}
static testStatusEnum subtracts(void)
{
\tassertImplementationInt(1, 3 - 4, __LINE__, __FILE__);
\treturn ut_DONE;
}
UNITTEST_FIXTURES(cases)
{
\tnew_TestFixture("adds", adds),
\tnew_TestFixture("subtracts", subtracts),
};
UNITTEST_CALLER_TEST(calculations, "calculations", cases);
static TestSetActive sets[] = {{1, &calculations}};
TestSetList setList = {1, 0, sets};
"""
UNUSED_C = """
#include "UnitTest.h"
static testStatusEnum never(void) { return ut_DONE; }
UNITTEST_FIXTURES(others)
{
\tnew_TestFixture("never", never),
};
UNITTEST_CALLER_TEST(forgotten, "forgotten", others);
"""
MAIN_C = """
#include <AsDefault.h>
#include "UnitTest.h"
void _INIT init(void) { utInit(&suite); }
void _CYCLIC run(void) { utCyclic(&suite); }
void _EXIT end(void) { utExit(&suite); }
"""


def objects(*entries):
    lines = (f'<Object Type="{kind}">{name}</Object>' for kind, name in entries)
    return f"<List><Objects>{''.join(lines)}</Objects></List>"


FILES = {
    "Machine.apj": "<Project/>",
    "Physical/Physical.pkg": objects(("Configuration", "Real"), ("Configuration", "UnitTests")),
    "Physical/Real/Cpu.sw": '<Sw><TaskClass Name="Cyclic#1"/></Sw>',
    "Physical/UnitTests/Hardware.hw": '<Hardware><Module Name="PC" Type="PC_any"/></Hardware>',
    "Physical/UnitTests/Cpu.sw": '<Sw><TaskClass Name="Cyclic#4">'
    '<Task Name="ut_calc" Source="ut_calc.prg"/></TaskClass></Sw>',
    "Logical/Package.pkg": objects(("Program", "ut_calc"), ("Library", "UtMgr")),
    "Logical/UtMgr/Binary.lby": objects(("File", "UtMgr.fun"), ("File", "UtMgr.typ")),
    "Logical/UtMgr/UtMgr.fun": BLOCK,
    "Logical/UtMgr/UtMgr.typ": TYPES,
    "Logical/ut_calc/ANSIC.prg": objects(
        *(("File", name) for name in ("tests.c", "unused.c", "main.c", "V.var", "UnitTest.h"))
    ),
    "Logical/ut_calc/UnitTest.h": UNIT_TEST_H,
    "Logical/ut_calc/tests.c": TESTS_C,
    "Logical/ut_calc/unused.c": UNUSED_C,
    "Logical/ut_calc/main.c": MAIN_C,
    "Logical/ut_calc/V.var": "VAR suite : UtMgrTestSuite := (Name := 'suite'); END_VAR",
}


@pytest.fixture
def write(pytester):
    """``write(folder, tests)``: a project there, with this text as its tests.c."""
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")

    def call(folder, tests=TESTS_C):
        for name, text in {**FILES, "Logical/ut_calc/tests.c": tests}.items():
            path = pytester.path / folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")

    return call


def test_each_case_is_a_test_of_pytest(pytester, write):
    write("machine")
    result = pytester.runpytest_inprocess("machine", "-v", "-p", "no:cacheprovider")
    result.assert_outcomes(passed=1, failed=2)
    result.stdout.fnmatch_lines(
        [
            "*::calculations::adds PASSED*",
            "*::calculations::subtracts FAILED*",
            "*::forgotten::never FAILED*",
            "*Logical/ut_calc/tests.c:10: expected 1, was -1",
            "*Logical/ut_calc/unused.c:3: the program does not run this test case: *",
        ]
    )


def test_long_names_and_long_paths(pytester, write):
    folder, name = "/".join("abc" * 30 for _ in range(3)), "a_name_" * 15
    write(
        folder, TESTS_C.replace('"subtracts"', f'"{name}"').replace('"calculations"', f'"{name}"')
    )
    result = pytester.runpytest_inprocess(folder, "-v", "-p", "no:cacheprovider")
    result.assert_outcomes(passed=1, failed=2)
    result.stdout.fnmatch_lines(
        [
            f"*::{name}::{name} FAILED*",
            "*abcabc/Logical/ut_calc/tests.c:10: expected 1, was -1",
        ]
    )


def test_a_project_that_cannot_be_read_is_an_error(pytester):
    (pytester.path / "x.apj").write_text("<Project/>", "utf-8")
    result = pytester.runpytest_inprocess("-p", "no:cacheprovider")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*there is no folder Logical*"])
