"""Interleavings: all of them, a sample, the first that breaks an invariant."""

import pytest

from plcsim.testing import ExpectationFailed, PlcTestError
from plcsim.testing.interleavings import Interleaving, Overrun, interleavings

pytest_plugins = ["pytester"]

MS = 1_000_000


def every(plc, classes=(), step=5 * MS, overrun_cycles=0, most=1000, seed=0):
    return list(interleavings(plc.application.setup, classes, step, overrun_cycles, most, seed))


def test_offsets_of_all_classes_are_combined(new_plc):
    found = every(new_plc(10, 20))
    assert [one.first_release_ns for one in found] == [
        {1: 0, 2: 0},
        {1: 0, 2: 5 * MS},
        {1: 5 * MS, 2: 0},
        {1: 5 * MS, 2: 5 * MS},
    ]


def test_every_program_overruns_in_each_of_its_first_cycles(new_plc):
    found = {one.overrun for one in every(new_plc(10, 20), overrun_cycles=2)}
    assert found == {None} | {
        Overrun(program, cycle, cost)
        for program in ("Cell", "Cell2")
        for cycle in (1, 2)
        for cost in (5 * MS, 15 * MS)
    }


def test_a_sample_is_chosen_by_the_seed_and_keeps_the_order(new_plc):
    plc = new_plc(10, 20)
    whole = every(plc, step=MS, overrun_cycles=2)
    sample = every(plc, step=MS, overrun_cycles=2, most=30, seed=1)
    assert len(sample) == 30
    assert sample == every(plc, step=MS, overrun_cycles=2, most=30, seed=1)
    assert sample != every(plc, step=MS, overrun_cycles=2, most=30, seed=2)
    assert [whole.index(one) for one in sample] == sorted(whole.index(one) for one in sample)


def test_a_sample_of_very_many_is_quick(new_plc):
    plc = new_plc(100, 1000, 1000)
    assert len(every(plc, step=MS, overrun_cycles=10, most=50)) == 50


def test_a_step_of_0(new_plc):
    with pytest.raises(PlcTestError, match="step must be above 0"):
        every(new_plc(10, 20), step=0)


@pytest.mark.parametrize(
    ("cycles", "classes", "text"),
    [((10,), (), "at least two"), ((10, 20), (1,), "at least two"), ((10, 20), (1, 4), "class 4")],
)
def test_wrong_classes(new_plc, cycles, classes, text):
    with pytest.raises(PlcTestError, match=text):
        every(new_plc(*cycles), classes)


def test_an_interleaving_reads_well():
    one = Interleaving({1: 0, 4: 3 * MS}, Overrun("slow", 2, 15 * MS))
    assert str(one) == (
        "task class 1 first released at 0 ns, task class 4 first released at 3 ms, "
        "slow takes 15 ms in its cycle 2"
    )


def test_every_controller_starts_afresh_and_its_classes_meet_otherwise(new_plc):
    seen = set()
    for plc in new_plc(10, 20).every_interleaving(step="5ms", overrun_cycles=1):
        assert plc["Cell.count"] == 0
        trace = plc.record("Cell.count", "Cell2.count")
        plc.run("60ms")
        seen.add(trace.to_csv())
    assert len(seen) == 8


def test_overruns_on_purpose_do_not_lead_to_service(new_plc):
    seen = 0
    for plc in new_plc(10, 20).every_interleaving(step="5ms", overrun_cycles=1):
        plc.cost("Cell", "40ms", cycle=3)
        plc.run("100ms")
        seen += len(plc.controller.violations)
    assert seen >= 20


def test_the_first_that_breaks_the_invariant_is_reported(new_plc):
    plc = new_plc(10, 20)
    broken = lambda one: one["Cell.count"] >= 2 * one["Cell2.count"] - 1  # noqa: E731

    def scenario():
        for one in plc.every_interleaving(step="5ms", overrun_cycles=2, invariant=broken):
            one.run("200ms")

    with pytest.raises(ExpectationFailed, match=r"interleaving: task class 1 first released"):
        scenario()


def test_a_plain_assert_in_the_loop_names_the_interleaving_too(pytester):
    pytester.makefile(
        ".toml",
        plc='[task_class.1]\ncycle = "10ms"\nprograms = ["a"]\n'
        '[task_class.2]\ncycle = "20ms"\nprograms = ["b"]\n',
    )
    for name in "ab":
        (pytester.mkdir(name) / "main.py").write_text(
            "from plcsim import Program\nfrom st_types import DINT, var\n"
            "class P(Program):\n    n = var(DINT)\n"
            "    def cyclic(self):\n        self.n += 1\n"
        )
    pytester.makepyfile(
        """
        def test_it(plc):
            for one in plc.every_interleaving():
                one.run("100ms")
                assert one["a.n"] == 10
        """
    )
    result = pytester.runpytest_inprocess("-p", "no:hypothesispytest")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["interleaving: *a takes 15 ms in its cycle 1", "*a.n*"])
