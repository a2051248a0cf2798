"""The runner of the library UnitTest, with headers as a project has them."""

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError

HEADER = """
#ifndef UNIT_TEST_H
#define UNIT_TEST_H
#include <bur/plctypes.h>
#include "UtMgr.h"
typedef enum { ut_BUSY, ut_DONE, ut_ABORT } testStatusEnum;
typedef enum {
	stateStart, stateSetup, stateRun, stateTearDown, stateEnd, stateDefault
} testStateEnum;
typedef struct TestResult TestResult;
typedef struct {
	char *(*name)(void *);
	testStatusEnum (*run)(void *, TestResult *);
	int (*countTestCases)(void *);
} TestImplement;
typedef struct { const char *name; unsigned long mode; testStatusEnum (*test)(void); } TestFixture;
typedef struct {
	TestImplement *isa;
	const char *name;
	testStateEnum state;
	char abort;
	testStatusEnum (*setUp)(void), (*tearDown)(void);
	unsigned numberOfFixtuers;
	TestFixture *fixtuers;
	testStatusEnum (*setUpSuite)(void), (*tearDownSuite)(void);
	void (*cyclicSetCaller)(void);
	unsigned long mode;
} TestCaller;
typedef struct { BOOL active; TestCaller *set; } TestSetActive;
typedef struct { UINT nrOfTestSets, currentTestSet; TestSetActive *list; } TestSetList;
extern const TestImplement TestCallerImplement, TestCaseImplement;
extern TestSetList setList;
void addFailure(const char *, unsigned long, const char *);
void addPassed(const char *, unsigned long, const char *);
void addInfo(const char *, unsigned long, const char *);
void addAbort(const char *, unsigned long, const char *);
BOOL assertCondition(BOOL, const char *, unsigned long, const char *);
BOOL assertImplementationInt(int, int, unsigned long, const char *);
BOOL assertImplementationCStr(const char *, const char *, unsigned long, const char *);
BOOL assertImplementationDoublesWithin(double, double, double, unsigned long, const char *);
void utInit(struct UtMgrTestSuite *);
void utCyclic(struct UtMgrTestSuite *);
void utExit(struct UtMgrTestSuite *);
#endif
"""
TYPES = """
TYPE
    UtMgrLocationType : STRUCT
        TestSetName, TestCaseName, Line, Location, File : UDINT;
    END_STRUCT;
    UtMgrInformationalType : STRUCT
        TestCasesSinceActiveCounter, FailedAssertCounter : UDINT;
        PassedAssertCounter, InformationalMessageCounter : UDINT;
        LastKnownPassedLocation : UtMgrLocationType;
    END_STRUCT;
END_TYPE
"""
BLOCK = """
FUNCTION_BLOCK UtMgrTestSuite
    VAR_INPUT
        Enable : BOOL;
        Name : STRING[80];
        TestAborted, TestFinished : BOOL;
    END_VAR
    VAR_OUTPUT
        Active, TestActive : BOOL;
        Informational : UtMgrInformationalType;
        TestFinishedAck, TestFinishedDone : BOOL;
    END_VAR
END_FUNCTION_BLOCK
"""
TESTS = """
#include <UnitTest.h>
#include <string.h>
#define IS __LINE__, __FILE__
static int busy;
DINT calls[5];
static testStatusEnum set_up(void) { calls[0]++; return ut_DONE; }
static testStatusEnum tear_down(void) { calls[1]++; return ut_DONE; }
static testStatusEnum set_up_set(void) { return ++calls[2] < 3 ? ut_BUSY : ut_DONE; }
static testStatusEnum tear_down_set(void) { calls[3]++; return ut_DONE; }
static void each_cycle(void) { calls[4]++; }
static testStatusEnum good(void)
{
	assertImplementationInt(7, 3 + 4, IS);
	assertImplementationCStr("a", "a", IS);
	assertImplementationDoublesWithin(0.1, 1.0, 1.05, IS);
	return ut_DONE;
}
static testStatusEnum bad(void)
{
	assertImplementationInt(7, 8, IS);
	addInfo("a note", 0, 0);
	return ut_DONE;
}
static testStatusEnum slow(void) { return ++busy < 4 ? ut_BUSY : ut_DONE; }
static testStatusEnum gives_up(void) { addAbort("no sense", IS); return ut_ABORT; }
static TestFixture first[] = {
	{"good", 1, good}, {"bad", 1, bad}, {"left out", 0, bad}, {"slow", 1, slow}
};
static TestFixture second[] = {{"gives up", 1, gives_up}, {"never", 1, good}};
#define CALLER (TestImplement *)&TestCallerImplement
static TestCaller one = {CALLER, "one", stateStart, 0, set_up, tear_down, 4, first,
	set_up_set, tear_down_set, each_cycle, 1};
static TestCaller two = {CALLER, "two", stateStart, 0, 0, 0, 2, second, 0, 0, 0, 1};
static TestCaller off = {CALLER, "off", stateStart, 0, 0, 0, 2, second, 0, 0, 0, 1};
static TestSetActive sets[] = {{1, &one}, {0, &off}, {1, &two}};
TestSetList setList = {3, 0, sets};
"""
MAIN = """
#include <AsDefault.h>
#include <UnitTest.h>
void _INIT init(void) { utInit(&suite); }
void _CYCLIC run(void) { utCyclic(&suite); }
void _EXIT end(void) { utExit(&suite); }
"""
FILES = {
    "UnitTest.h": HEADER,
    "UtMgr/UtMgr.typ": TYPES,
    "UtMgr/UtMgr.fun": BLOCK,
    "main/tests.c": TESTS,
    "main/main.c": MAIN,
    "main/V.var": "VAR suite : UtMgrTestSuite := (Name := 'suite'); END_VAR",
    "plc.toml": '[task_class.1]\ncycle = "10ms"\nprograms = ["main"]\n[c]\ninclude = ["."]\n'
    '[libraries]\nstub = ["UtMgr"]\n',
}
PASSED, FAILED, ABORTED, SKIPPED = 1, 2, 3, 4


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


@pytest.fixture
def report(run):
    """``report(cycles)``: the report of the program's tests, and the program's own counters."""
    controller = run(FILES, cycles=0)

    def report(cycles):
        controller.run(cycles=cycles)
        tags = controller.tags
        return (tags.read(tags.find(f"main.{name}")) for name in ("UnitTestReport", "calls"))

    return report


def test_sets_run_step_by_step(report):
    found, calls = report(30)
    assert found["Done"]
    cases = [(c["Set"], c["Name"], c["State"]) for c in found["Cases"][: found["CaseCount"]]]
    assert cases == [
        ("one", "good", PASSED),
        ("one", "bad", FAILED),
        ("one", "left out", SKIPPED),
        ("one", "slow", PASSED),
        ("two", "gives up", ABORTED),
    ]
    assert [found[k] for k in ("Passed", "Failed", "Aborted", "Skipped")] == [2, 1, 1, 1]
    assert found["Cases"][0]["Asserts"] == 3
    assert list(calls) == [3, 3, 3, 1, 3 + 2 + 4 + 1]


def test_findings_have_their_place(report):
    found, _ = report(30)
    failure, note, abortion = found["Findings"][: found["FindingCount"]]
    assert (failure["Case"], failure["Kind"], failure["Text"]) == (1, 0, "expected 7, was 8")
    assert failure["File"].endswith("main/tests.c")
    assert failure["Line"] == TESTS.splitlines().index("	assertImplementationInt(7, 8, IS);") + 1
    assert (note["Kind"], note["Text"]) == (2, "a note")
    assert (abortion["Case"], abortion["Kind"], abortion["Text"]) == (4, 1, "no sense")
