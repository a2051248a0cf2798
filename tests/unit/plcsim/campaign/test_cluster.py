"""How many runs a worker gets at once."""

import pytest

pytest.importorskip("distributed", reason="the extra campaign is not installed")

from plcsim.campaign.cluster import MOST_AT_ONCE, batch_size  # where it is installed
from plcsim.campaign.result import PlannedRun, Result, RunOutcome  # likewise


@pytest.mark.parametrize(
    ("host_s", "size"), [(0.0, 1), (0.001, MOST_AT_ONCE), (0.01, 25), (0.1, 2), (0.2, 1), (9.0, 1)]
)
def test_short_runs_travel_together(host_s: float, size: int) -> None:
    results = [Result(PlannedRun(n, 0, {}), RunOutcome.PASSED, host_s=host_s) for n in range(3)]
    assert batch_size(results) == size
