"""`plcsim report compare`: alarms, the bound on false ones, wrong files."""

import json
from random import Random

import pytest

from plcsim.cli.main import main
from plcsim.cli.report import FALSE_ALARMS, comparisons, exact_costs, read_report
from plcsim.cli.report import samples as samples_of
from plcsim.core.errors import ConfigurationError


def samples(factor, seed, repeats=30, tests=1):
    random = Random(seed)
    return {
        (f"test_{n}", "cell"): [factor * random.lognormvariate(0, 0.08) for _ in range(repeats)]
        for n in range(tests)
    }


def alarms(found):
    return [c for c in found if c.worse]


def test_a_fifth_more_is_seen_over_30_repeats():
    seen = [alarms(comparisons(samples(1.0, n), samples(1.2, n + 1000))) for n in range(50)]
    assert sum(map(bool, seen)) >= 48


def test_equal_runs_raise_no_alarm_more_often_than_promised():
    runs = 200
    false = sum(
        bool(alarms(comparisons(samples(1.0, n, tests=5), samples(1.05, n + 1000, tests=5))))
        for n in range(runs)
    )
    assert false <= FALSE_ALARMS * runs


def test_a_faster_program_is_no_alarm():
    found = comparisons(samples(1.0, 1), samples(0.5, 2))
    assert not alarms(found)
    assert found[0].change == pytest.approx(-0.5, abs=0.1)


def test_what_only_one_run_has_is_left_out():
    before = samples(1.0, 1) | {("gone", "cell"): [1.0] * 30}
    assert [c.test for c in comparisons(before, samples(1.0, 2))] == ["test_0"]


def test_nothing_in_common():
    with pytest.raises(ConfigurationError, match="in common"):
        comparisons({("a", "p"): [1.0]}, {("b", "p"): [1.0]})


def test_too_few_repeats():
    with pytest.raises(ConfigurationError, match="4 repeats are too few"):
        comparisons(samples(1.0, 1, repeats=4), samples(1.0, 2))


def write(folder, factor, seed):
    folder.mkdir()
    tests = [
        {
            "group": test,
            "outcome": "passed",
            "programs": [{"name": program, "median_in_loops": value}],
        }
        for (test, program), values in samples(factor, seed).items()
        for value in values
    ]
    file = folder / "report.json"
    file.write_text(json.dumps({"schema": "plcsim-test-report/1", "tests": tests}))
    return folder


def test_the_command_is_a_gate(tmp_path, capsys):
    a, b, c = (write(tmp_path / n, f, s) for n, f, s in (("a", 1, 1), ("b", 1, 2), ("c", 1.5, 3)))
    assert main(["report", "compare", str(a), str(b)]) == 0
    assert "nothing got slower" in capsys.readouterr().out
    assert main(["report", "compare", str(a), str(c / "report.json")]) == 4
    assert "1 of 1 got slower" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "text"),
    [
        ("{", "cannot be read"),
        ("[]", "is no report of --plc-report"),
        ('{"schema": "plcsim-report/1"}', "is no report"),
        ('{"schema": "plcsim-test-report/1"}', "is damaged: it has no tests"),
        ('{"schema": "plcsim-test-report/1", "tests": [{}]}', "is damaged"),
        ('{"schema": "plcsim-test-report/1", "tests": [3]}', "is damaged"),
    ],
)
def test_wrong_files_are_named(tmp_path, content, text):
    file = tmp_path / "report.json"
    file.write_text(content)
    for read in (samples_of, exact_costs):
        with pytest.raises(ConfigurationError) as caught:
            read(read_report(file))
        assert text in str(caught.value)
        assert str(file) in str(caught.value)


def test_a_missing_report(tmp_path, capsys):
    assert main(["report", "compare", str(tmp_path / "x"), str(tmp_path)]) == 1
    assert "x: cannot be read" in capsys.readouterr().err


@pytest.mark.parametrize("share", ["-1", "much", "nan", "101"])
def test_a_wrong_share_is_wrong_usage(capsys, share):
    with pytest.raises(SystemExit) as ended:
        main(["report", "compare", "a", "b", f"--smallest={share}"])
    assert ended.value.code == 2
    assert f"'{share}' is no share such as 0.1" in capsys.readouterr().err


def exact(folder, *tests):
    """A report of compiled programs: (program, cycles, total, lines) of each test."""
    folder.mkdir()
    rows = [
        {
            "group": f"test_{program}",
            "outcome": "passed",
            "programs": [
                {
                    "name": program,
                    "cycles": cycles,
                    "median_in_loops": 0.5,
                    "instructions": {"total": total, "maximum": total // cycles},
                }
            ],
            "lines": {"Main.st": lines},
        }
        for program, cycles, total, lines in tests
    ]
    content = {"schema": "plcsim-test-report/1", "tests": rows}
    (folder / "report.json").write_text(json.dumps(content))
    return str(folder)


LINES = [[47, 100, "a := 1;"], [48, 100, "b := 2;"], [60, 900, "c := 3;"], [61, 90, "d := 4;"]]


def test_instructions_need_no_repeats(tmp_path, capsys):
    dearer = [*LINES[:1], [48, 200, "b := 2;"], [60, 3920, "c := 3;"], *LINES[3:]]
    before = exact(tmp_path / "a", ("conveyor", 10, 1190, LINES))
    after = exact(tmp_path / "b", ("conveyor", 10, 4310, dearer))
    assert main(["report", "compare", before, after]) == 4
    out = " ".join(capsys.readouterr().out.split())
    assert "+312 instructions a cycle in conveyor, 119 -> 431; Main.st line 48 to 60: +312" in out
    assert "1 of 1 got slower" in out
    assert main(["report", "compare", before, before]) == 0
    assert capsys.readouterr().out == "nothing got slower\n"
    assert main(["report", "compare", after, before]) == 0
    assert "-312 instructions a cycle" in capsys.readouterr().out


def test_a_growth_below_the_smallest_is_told_but_no_alarm(tmp_path, capsys):
    before = exact(tmp_path / "a", ("conveyor", 10, 1000, []))
    after = exact(tmp_path / "b", ("conveyor", 10, 1035, []))
    assert main(["report", "compare", before, after]) == 0
    assert "+3.5 instructions a cycle in conveyor, 100 -> 103.5 (test_conveyor)" in (
        " ".join(capsys.readouterr().out.split())
    )
    assert main(["report", "compare", "--smallest", "0", before, after]) == 4
