/* The runner of the library UnitTest: sets of test cases, one step in each cycle.
 *
 * It is compiled with the UnitTest.h that a project has, which says how test sets are laid out.
 * utInit, utCyclic and utExit are called by the units of the program; the tests begin with the first
 * cycle. What they find stands in the variable UnitTestReport of the program, a tag as its others. */

#include <UnitTest.h>
#include <stdio.h>
#include <string.h>

#define MOST_CASES 500
#define MOST_FINDINGS 200

enum plc_test_state { PLC_RUNNING, PLC_PASSED, PLC_FAILED, PLC_ABORTED, PLC_SKIPPED };
enum plc_finding { PLC_FAILURE, PLC_ABORT, PLC_INFORMATION };

typedef struct PlcTestCase {
	char Set[128];
	char Name[128];
	UDINT State; /* of plc_test_state */
	UDINT Asserts; /* that held */
} PlcTestCase;

typedef struct PlcTestFinding {
	UDINT Case; /* its number, from 0 */
	UDINT Kind; /* of plc_finding */
	UDINT Line;
	char File[256]; /* of a longer path the end */
	char Text[200];
} PlcTestFinding;

typedef struct PlcTestReport {
	BOOL Done;
	UDINT CaseCount; /* with those for which there is no room */
	UDINT FindingCount;
	UDINT Passed, Failed, Aborted, Skipped; /* test cases */
	PlcTestCase Cases[MOST_CASES];
	PlcTestFinding Findings[MOST_FINDINGS];
} PlcTestReport;

PlcTestReport UnitTestReport;

extern TestSetList setList;

static UtMgrTestSuite_typ *suite;
static TestCaller *set; /* that runs */
static unsigned fixture; /* of it */
static testStateEnum phase; /* of the test case */
static PlcTestCase *running; /* NULL between test cases */
static char is_aborted;

static void begin_case(const char *name)
{
	static PlcTestCase nobody;
	UDINT number = UnitTestReport.CaseCount++;
	running = number < MOST_CASES ? &UnitTestReport.Cases[number] : &nobody;
	strlcpy(running->Set, set->name, sizeof running->Set);
	strlcpy(running->Name, name, sizeof running->Name);
	running->State = PLC_RUNNING;
}

static void end_case(enum plc_test_state state)
{
	if (running->State == PLC_RUNNING)
		running->State = state;
	UnitTestReport.Passed += running->State == PLC_PASSED;
	UnitTestReport.Failed += running->State == PLC_FAILED;
	UnitTestReport.Aborted += running->State == PLC_ABORTED;
	UnitTestReport.Skipped += running->State == PLC_SKIPPED;
	running = NULL;
}

static void locate(unsigned long line, const char *file)
{
	UtMgrLocationType *place = &suite->Informational.LastKnownPassedLocation;
	place->TestSetName = (UDINT)set->name;
	place->TestCaseName = running ? (UDINT)running->Name : 0;
	place->Line = line;
	place->File = (UDINT)file;
}

/* The name of a file stands at the end of its path. */
static const char *end_of(const char *path, size_t size)
{
	size_t length = path ? strlen(path) : 0;
	return length < size ? (path ? path : "") : path + (length + 1 - size);
}

/* What a set's own setup or teardown finds becomes a test case of that name. */
static void find(enum plc_finding kind, const char *text, unsigned long line, const char *file)
{
	if (!set)
		return;
	if (!running)
		begin_case(set->state == stateSetup ? "setup of the set" : "teardown of the set");
	UDINT number = UnitTestReport.FindingCount++;
	if (number < MOST_FINDINGS) {
		PlcTestFinding *finding = &UnitTestReport.Findings[number];
		finding->Case = UnitTestReport.CaseCount - 1;
		finding->Kind = kind;
		finding->Line = line;
		strlcpy(finding->File, end_of(file, sizeof finding->File), sizeof finding->File);
		strlcpy(finding->Text, text, sizeof finding->Text);
	}
	if (kind == PLC_INFORMATION) {
		suite->Informational.InformationalMessageCounter++;
		return;
	}
	printf("%s.%s: %s:%lu: %s\n", set->name, running->Name, file ? file : "", line, text);
	suite->Informational.FailedAssertCounter++;
	running->State = kind == PLC_ABORT ? PLC_ABORTED : PLC_FAILED;
}

void addFailure(const char *text, unsigned long line, const char *file)
{
	find(PLC_FAILURE, text, line, file);
}

void addAbort(const char *text, unsigned long line, const char *file)
{
	find(PLC_ABORT, text, line, file);
}

void addInfo(const char *text, unsigned long line, const char *file)
{
	find(PLC_INFORMATION, text, line, file);
}

void addPassed(const char *text, unsigned long line, const char *file)
{
	(void)text;
	if (!set)
		return;
	suite->Informational.PassedAssertCounter++;
	if (running)
		running->Asserts++;
	locate(line, file);
}

static BOOL judged(int holds, const char *text, unsigned long line, const char *file)
{
	(holds ? addPassed : addFailure)(text, line, file);
	return holds != 0;
}

BOOL assertCondition(BOOL condition, const char *message, unsigned long line, const char *file)
{
	return judged(condition, message, line, file);
}

BOOL assertImplementationInt(int expected, int actual, unsigned long line, const char *file)
{
	char text[60];
	snprintf(text, sizeof text, "expected %d, was %d", expected, actual);
	return judged(expected == actual, text, line, file);
}

BOOL assertImplementationCStr(
	const char *expected, const char *actual, unsigned long line, const char *file)
{
	char text[200];
	snprintf(text, sizeof text, "expected '%.80s', was '%.80s'", expected ? expected : "(null)",
	         actual ? actual : "(null)");
	return judged(expected && actual && !strcmp(expected, actual), text, line, file);
}

BOOL assertImplementationWStr(
	const unsigned short *expected, const unsigned short *actual, unsigned long line, const char *file)
{
	int at = 0;
	char text[100];
	if (!expected || !actual)
		return judged(0, "a WSTRING is a null pointer", line, file);
	while (expected[at] && expected[at] == actual[at])
		at++;
	snprintf(text, sizeof text, "character %d: expected 16#%04X, was 16#%04X", at, expected[at], actual[at]);
	return judged(expected[at] == actual[at], text, line, file);
}

BOOL assertImplementationMem(
	void *expected, void *actual, unsigned long size, unsigned long line, const char *file)
{
	const unsigned char *left = expected, *right = actual;
	unsigned long at = 0;
	char text[100];
	if (!expected || !actual || !size)
		return judged(0, size ? "memory to compare is a null pointer" : "no memory to compare", line, file);
	while (at < size && left[at] == right[at])
		at++;
	snprintf(text, sizeof text, "byte %lu: expected 16#%02X, was 16#%02X", at, at < size ? left[at] : 0,
	         at < size ? right[at] : 0);
	return judged(at == size, text, line, file);
}

/* NaN is equal to nothing; equal infinities are within anything. */
static int is_within(double delta, double expected, double actual)
{
	double difference = expected - actual;
	double bound = delta < 0 ? -delta : delta;
	return expected == actual || (difference <= bound && -difference <= bound);
}

BOOL assertImplementationDoublesWithin(
	const double delta, const double expected, const double actual, unsigned long line, const char *file)
{
	char text[150];
	snprintf(text, sizeof text, "expected %.17g, was %.17g", expected, actual);
	return judged(is_within(delta, expected, actual), text, line, file);
}

BOOL assertImplementationFloatsWithin(
	const float delta, const float expected, const float actual, unsigned long line, const char *file)
{
	char text[150];
	snprintf(text, sizeof text, "expected %.9g, was %.9g", (double)expected, (double)actual);
	return judged(is_within(delta, expected, actual), text, line, file);
}

static testStatusEnum called(testStatusEnum (*function)(void))
{
	return function ? function() : ut_DONE;
}

/* Returns whether the part of a test case is over; an abortion ends the set after its teardown. */
static int is_over(testStatusEnum (*function)(void), testStateEnum next)
{
	switch (called(function)) {
	case ut_BUSY:
		return 0;
	case ut_ABORT:
		is_aborted = 1;
		if (running && running->State == PLC_RUNNING)
			running->State = PLC_ABORTED;
		phase = phase == stateTearDown ? stateEnd : stateTearDown;
		return 1;
	default:
		phase = next;
		return 1;
	}
}

static void begin_next_case(void)
{
	begin_case(set->fixtuers[fixture].name);
	suite->Informational.TestCasesSinceActiveCounter++;
	phase = stateSetup;
}

static void step_case(void)
{
	const TestFixture *test = &set->fixtuers[fixture];
	if (!running)
		begin_next_case();
	if (phase == stateSetup && !is_over(set->setUp, stateRun))
		return;
	if (phase == stateRun && !is_over(test->test, stateTearDown))
		return;
	if (phase == stateTearDown && !is_over(set->tearDown, stateEnd))
		return;
	end_case(PLC_PASSED);
	fixture++;
}

/* Skips test cases that are not to run; returns whether there is one left. */
static int is_one_left(void)
{
	for (; fixture < set->numberOfFixtuers && !is_aborted; fixture++) {
		if (set->mode && set->fixtuers[fixture].mode)
			return 1;
		begin_case(set->fixtuers[fixture].name);
		end_case(PLC_SKIPPED);
	}
	return 0;
}

static void step_setup(void)
{
	switch (called(set->setUpSuite)) {
	case ut_BUSY:
		return;
	case ut_ABORT:
		is_aborted = 1;
		break;
	default:
		break;
	}
	if (running)
		end_case(is_aborted ? PLC_ABORTED : PLC_PASSED);
	set->state = stateRun;
}

static void step_teardown(void)
{
	if (called(set->tearDownSuite) == ut_BUSY)
		return;
	if (running)
		end_case(PLC_PASSED);
	set->state = stateEnd;
}

static void begin_set(TestCaller *next)
{
	set = next;
	fixture = 0;
	is_aborted = 0;
	running = NULL;
	set->abort = 0;
	set->state = set->mode ? stateSetup : stateRun;
}

/* One step of the set that runs: one of its setup, a test case or its teardown. */
static void step_set(void)
{
	if (set->state == stateSetup && set->setUpSuite)
		step_setup();
	else if (is_one_left())
		step_case();
	else if (set->mode && set->tearDownSuite)
		set->state = stateTearDown, step_teardown();
	else
		set->state = stateEnd;
	if (set->cyclicSetCaller && set->mode)
		set->cyclicSetCaller();
}

void utInit(UtMgrTestSuite_typ *given)
{
	suite = given;
	suite->Enable = 1;
	suite->Active = 1;
	suite->TestActive = 1;
	memset(&suite->Informational, 0, sizeof suite->Informational);
	memset(&UnitTestReport, 0, sizeof UnitTestReport);
	setList.currentTestSet = 0;
	set = NULL;
}

static void finish(void)
{
	UnitTestReport.Done = 1;
	suite->TestActive = 0;
	suite->TestFinished = suite->TestFinishedAck = suite->TestFinishedDone = 1;
	printf("%s: %lu passed, %lu failed, %lu aborted, %lu skipped\n", (char *)suite->Name,
	       (unsigned long)UnitTestReport.Passed, (unsigned long)UnitTestReport.Failed,
	       (unsigned long)UnitTestReport.Aborted, (unsigned long)UnitTestReport.Skipped);
}

void utCyclic(UtMgrTestSuite_typ *given)
{
	suite = given;
	if (UnitTestReport.Done)
		return;
	while (!set) {
		if (setList.currentTestSet >= setList.nrOfTestSets) {
			finish();
			return;
		}
		if (setList.list[setList.currentTestSet].active)
			begin_set(setList.list[setList.currentTestSet].set);
		else
			setList.currentTestSet++;
	}
	step_set();
	if (set->state == stateEnd) {
		set = NULL;
		setList.currentTestSet++;
	}
}

void utExit(UtMgrTestSuite_typ *given) { given->Enable = given->Active = given->TestActive = 0; }

static char *name_of(void *test) { return (char *)((TestCaller *)test)->name; }
static int count_of(void *test) { return (int)((TestCaller *)test)->numberOfFixtuers; }
static testStatusEnum run_test(void *test, TestResult *result) { return (void)test, (void)result, ut_DONE; }

const TestImplement TestCallerImplement = {name_of, run_test, count_of};
const TestImplement TestCaseImplement = {name_of, run_test, count_of};
