"""Results on disk."""

from dataclasses import replace
from pathlib import Path

import pytest

pytest.importorskip("pyarrow", reason="the extra campaign is not installed")

from plcsim.campaign.errors import CampaignError
from plcsim.campaign.result import PlannedRun, Result, RunOutcome
from plcsim.campaign.store import About, Examples, ResultStore, read_folder

ABOUT = About("overflow.py", "c0ffee", 3, "1.0")
PASSED = Result(
    PlannedRun(0, 10, {"a.x": 0.1, "on": True}), RunOutcome.PASSED, margin=1.5, host_s=0.25
)
FAILED = Result(
    PlannedRun(1, 11, {"a.x": 1 / 3, "on": False}),
    RunOutcome.FAILED,
    "spilled",
    "no spill",
    -0.5,
    {"max a.x": 3, "name": "é"},
    0.5,
)


def test_what_was_written_is_read_exactly(tmp_path: Path) -> None:
    store = ResultStore(tmp_path / "r", ABOUT)
    store.add(FAILED)
    store.add(PASSED)
    store.complete()
    assert read_folder(tmp_path / "r") == (ABOUT, [PASSED, FAILED])


def test_an_interrupted_campaign_goes_on(tmp_path: Path) -> None:
    first = ResultStore(tmp_path / "r", ABOUT)
    first.add(PASSED)
    first.flush()
    second = ResultStore(tmp_path / "r", ABOUT)
    assert second.done == {0}
    second.add(FAILED)
    second.complete()
    assert sorted(f.name for f in (tmp_path / "r").iterdir()) == [
        "campaign.json",
        "results.parquet",
    ]
    assert ResultStore(tmp_path / "r", ABOUT).done == {0, 1}


def test_parts_with_other_columns_and_kinds_of_numbers_become_one_file(tmp_path: Path) -> None:
    store = ResultStore(tmp_path / "r", ABOUT)
    store.add(replace(PASSED, measured={"t": 1}))
    store.flush()
    store.add(replace(FAILED, measured={"t": 1.5, "u": True}))
    store.complete()
    _, results = read_folder(tmp_path / "r")
    assert [r.measured for r in results] == [{"t": 1.0}, {"t": 1.5, "u": True}]


def test_results_of_something_else_are_not_mixed(tmp_path: Path) -> None:
    ResultStore(tmp_path / "r", ABOUT)
    with pytest.raises(CampaignError, match=r"were changed; --fresh begins again"):
        ResultStore(tmp_path / "r", replace(ABOUT, content="other"))
    assert ResultStore(tmp_path / "r", replace(ABOUT, content="other"), fresh=True).done == set()


def test_a_folder_with_other_files_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("mine")
    for fresh in (False, True):
        with pytest.raises(CampaignError, match="other files"):
            ResultStore(tmp_path, ABOUT, fresh=fresh)
    assert (tmp_path / "thesis.txt").read_text() == "mine"


def test_a_broken_file_is_named(tmp_path: Path) -> None:
    ResultStore(tmp_path / "r", ABOUT)
    (tmp_path / "r" / "part-000000.parquet").write_bytes(b"PAR1 half a file")
    with pytest.raises(CampaignError, match=r"part-000000.parquet: cannot be read"):
        ResultStore(tmp_path / "r", ABOUT)


def test_one_name_of_two_kinds_is_told(tmp_path: Path) -> None:
    store = ResultStore(tmp_path / "r", ABOUT)
    store.add(replace(PASSED, measured={"t": 1}))
    store.add(replace(FAILED, measured={"t": "late"}))
    with pytest.raises(CampaignError, match="measured t: has values of several kinds"):
        store.complete()


def test_examples_are_kept_for_their_content(tmp_path: Path) -> None:
    Examples(tmp_path, "c0ffee").keep(FAILED)
    assert Examples(tmp_path, "c0ffee").get("no spill") == FAILED
    assert Examples(tmp_path, "other").get("no spill") is None
