"""Which values the runs of a campaign get."""

from pathlib import Path

import pytest

from plcsim.campaign import (
    CampaignError,
    Choice,
    FromCsv,
    Grid,
    Integer,
    LatinHypercube,
    Random,
    Sobol,
    Uniform,
)
from plcsim.campaign.sampling import MOST_RUNS, Sampling

HERE = Path()
VARIABLES = {"a": Uniform(0, 1), "b": Choice(False, True)}


def test_a_grid_is_every_combination() -> None:
    rows = Grid(3).plan(VARIABLES, 0, HERE)
    assert [(r["a"], r["b"]) for r in rows] == [(a, b) for a in (0, 0.5, 1) for b in (False, True)]


@pytest.mark.parametrize("sampling", [Random(50), LatinHypercube(50), Sobol(50)])
def test_the_seed_decides(sampling: Sampling) -> None:
    pytest.importorskip("scipy", reason="the extra campaign is not installed")
    first = sampling.plan(VARIABLES, 1, HERE)
    assert len(first) == 50
    assert sampling.plan(VARIABLES, 1, HERE) == first
    assert sampling.plan(VARIABLES, 2, HERE) != first


def test_a_latin_hypercube_meets_every_part_once() -> None:
    pytest.importorskip("scipy", reason="the extra campaign is not installed")
    rows = LatinHypercube(20).plan({"a": Integer(0, 19), "b": Uniform(0, 20)}, 5, HERE)
    assert sorted(r["a"] for r in rows) == list(range(20))
    assert sorted(int(float(r["b"])) for r in rows) == list(range(20))


@pytest.mark.parametrize("sampling", [Random(0), Grid(0), Random(MOST_RUNS + 1), Grid(10**7)])
def test_too_few_and_too_many_runs_are_refused(sampling: Sampling) -> None:
    with pytest.raises(CampaignError):
        sampling.plan({"a": Uniform(0, 1)}, 0, HERE)


def test_lines_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "cases.csv").write_text("p.speed,p.on,name,n\n1.5,TRUE,a,1\n2,FALSE,7,-2\n")
    assert FromCsv("cases.csv").plan({}, 0, tmp_path) == [
        {"p.speed": 1.5, "p.on": True, "name": "a", "n": 1},
        {"p.speed": 2.0, "p.on": False, "name": "7", "n": -2},
    ]


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("", "one line with the names"),
        ("a\n", "one line with the names"),
        ("a,a\n1,2\n", r"cases.csv:1: every column needs a name"),
        ("a,b\n1,2\n3\n", r"cases.csv:3: 1 cells under 2 names"),
    ],
)
def test_a_wrong_file_is_told_with_its_line(tmp_path: Path, text: str, error: str) -> None:
    (tmp_path / "cases.csv").write_text(text)
    with pytest.raises(CampaignError, match=error):
        FromCsv("cases.csv").plan({}, 0, tmp_path)
    with pytest.raises(CampaignError, match="cannot be read"):
        FromCsv("others.csv").plan({}, 0, tmp_path)
