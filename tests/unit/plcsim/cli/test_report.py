"""`plcsim report compare`: alarms, the bound on false ones, wrong files."""

import json
from random import Random

import pytest

from plcsim.cli.main import main
from plcsim.cli.report import FALSE_ALARMS, comparisons, read_samples
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
        ('{"schema": "plcsim-test-report/1"}', "is damaged: KeyError('tests')"),
        ('{"schema": "plcsim-test-report/1", "tests": [{}]}', "is damaged"),
        ('{"schema": "plcsim-test-report/1", "tests": [3]}', "is damaged"),
    ],
)
def test_wrong_files_are_named(tmp_path, content, text):
    file = tmp_path / "report.json"
    file.write_text(content)
    with pytest.raises(ConfigurationError) as caught:
        read_samples(file)
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
