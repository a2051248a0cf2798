"""Budgets: smallest cost of each cycle, speed of the machine, what the plugin does with them."""

import pytest

from plcsim.testing import PlcTestError
from plcsim.testing.budget import (
    Breach,
    Budget,
    CycleMeasurement,
    breaches,
    budget_of,
    describe_breaches,
    quantile_of,
)

pytest_plugins = ["pytester"]

REFERENCE_NS = 10_000


def measured(*runs, calibration_ns=REFERENCE_NS):
    measurement = CycleMeasurement()
    for run in runs:
        measurement.add({"cell": run}, [calibration_ns] * 10)
    return measurement


def test_a_marker_gives_the_limits():
    assert budget_of({"p99": "200us", "worst": "1ms", "program": "cell"}) == Budget(
        {"p99": 200_000, "worst": 1_000_000}, "cell"
    )


def test_a_limit_may_be_a_number_of_instructions():
    given = {"p50": "1us", "p99": "12_000 instructions", "worst": "1 instruction"}
    assert budget_of(given) == Budget({"p50": 1000}, "", {"p99": 12_000, "worst": 1})
    assert breaches(budget_of({"worst": "1 instruction"}), measured([5]), REFERENCE_NS) == []


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"worst": "many instructions"}, "cycle_budget: worst: 'many instructions' is not a durat"),
        ({}, "no limit: give one of p50"),
        ({"p98": "1ms"}, "p98: give one of"),
        ({"p99": "fast"}, "cycle_budget: p99: 'fast' is not a duration"),
    ],
)
def test_wrong_markers_are_named(given, text):
    with pytest.raises(PlcTestError, match=text):
        budget_of(given)


def test_a_quantile_is_the_smallest_value_that_enough_do_not_exceed():
    assert [quantile_of(range(1, 101), q) for q in (0.5, 0.99, 1.0)] == [50, 99, 100]
    assert quantile_of([7], 0.5) == 7


def test_a_disturbance_in_one_run_does_not_count():
    quiet = [1_000] * 100
    disturbed = [1_000] * 40 + [900_000] * 20 + [1_000] * 40
    budget = Budget({"p99": 2_000, "worst": 2_000})
    assert breaches(budget, measured(disturbed), REFERENCE_NS) != []
    assert breaches(budget, measured(disturbed, quiet), REFERENCE_NS) == []


def test_what_is_slow_in_every_run_counts():
    slow = [1_000] * 99 + [5_000]
    budget = Budget({"p99": 2_000, "worst": 2_000})
    found = breaches(budget, measured(slow, slow, slow), REFERENCE_NS)
    assert found == [Breach("cell", "worst", 5_000, 2_000)]


def test_a_slow_machine_neither_fails_a_good_program_nor_a_fast_one_passes_a_bad_one():
    budget = Budget({"p50": 2_000})
    slow_machine = measured([3_000] * 20, calibration_ns=2 * REFERENCE_NS)
    fast_machine = measured([1_500] * 20, calibration_ns=REFERENCE_NS // 2)
    assert breaches(budget, slow_machine, REFERENCE_NS) == []
    assert breaches(budget, fast_machine, REFERENCE_NS) == [Breach("cell", "p50", 3_000, 2_000)]


def test_disturbed_runs_of_the_loop_do_not_make_the_machine_slow():
    measurement = CycleMeasurement()
    measurement.add({"cell": [3_000] * 20}, [REFERENCE_NS] * 10 + [9 * REFERENCE_NS] * 30)
    assert breaches(Budget({"p50": 2_000}), measurement, REFERENCE_NS) != []


def test_too_few_cycles_for_a_percentile():
    with pytest.raises(PlcTestError, match="p99 needs 100 cycles at least; cell ran 99"):
        breaches(Budget({"p99": 1}), measured([1] * 99), REFERENCE_NS)


def test_an_unknown_program():
    with pytest.raises(PlcTestError, match="no program 'x'; there are cell"):
        breaches(Budget({"worst": 1}, "x"), measured([1]), REFERENCE_NS)


def test_runs_of_different_length_are_refused():
    with pytest.raises(PlcTestError, match="ran 2 cycles in one run of the test and 3 in the next"):
        measured([1, 1], [1, 1, 1])


def test_the_description_names_program_figure_limit_and_machine():
    measurement = measured([3_000] * 20, calibration_ns=15_000)
    text = describe_breaches([Breach("cell", "p50", 2_000, 1_000)], measurement, REFERENCE_NS)
    assert "program cell is over its budget: p50 of 20 cycles is 2 us, limit 1 us" in text
    assert "1.50 times as long" in text


@pytest.fixture
def budget_run(pytester):
    def run(marker, body="plc.run('2s')", *arguments):
        pytester.makepyfile(
            f"""
            import pytest
            from plcsim import Program
            from st_types import DINT, var

            runs = []

            class Worker(Program):
                x = var(DINT)

                def cyclic(self):
                    for _ in range(50):
                        self.x = self.x + 1

            @pytest.mark.cycle_budget({marker})
            @pytest.mark.plc(program=Worker)
            def test_worker(plc):
                runs.append(1)
                {body}

            def test_after():
                print("runs:", len(runs))
            """
        )
        return pytester.runpytest_inprocess("-p", "no:hypothesispytest", "-s", *arguments)

    return run


def test_a_program_within_its_budget_passes_in_one_run(budget_run):
    result = budget_run('p50="50ms", p99="100ms", worst="10s"')
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(["*runs: 1"])


def test_a_program_over_its_budget_fails_after_all_runs_and_says_why(budget_run):
    result = budget_run('p50="10ns"')
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(
        ["*runs: 7", "program Worker is over its budget: p50 of 200 cycles *", "*in 7 runs"]
    )


def test_junit_has_the_properties_of_one_run(budget_run, pytester):
    budget_run('p50="10ns"', "plc.run('2s')", "--junitxml=junit.xml")
    text = (pytester.path / "junit.xml").read_text()
    assert text.count('"plc.time_ns"') == 1


def test_a_test_that_fails_by_itself_is_run_once(budget_run):
    result = budget_run('p50="10ns"', "assert plc['Worker.x'] == 1")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*runs: 1", "*assert 0 == 1"])


def test_too_few_cycles_fail_the_test_with_that_reason(budget_run):
    result = budget_run('p99="1s"', "plc.run('100ms')")
    result.stdout.fnmatch_lines(["cycle_budget: p99 needs 100 cycles at least; Worker ran 10"])


def test_the_reference_machine_can_be_another(budget_run, pytester):
    pytester.makeini("[pytest]\nplc_calibration = 100s\n")
    budget_run('p50="10us"').assert_outcomes(passed=1, failed=1)


def test_a_wrong_reference_is_an_error_of_use(budget_run, pytester):
    pytester.makeini("[pytest]\nplc_calibration = quick\n")
    assert budget_run('p50="1s"').ret != 0
