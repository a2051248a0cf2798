"""A campaign as its file says it, and what is wrong with it."""

from collections.abc import Callable
from pathlib import Path

import pytest

from plcsim.campaign import CampaignError
from plcsim.campaign.definition import load_campaign

Write = Callable[[str], Path]


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("x = 1", r"ramps.py: has no campaign = Campaign"),
        ("campaign = Campaign()", r"ramps.py: duration: say how long a run takes"),
        ("campaign = Campaign(duration='soon')", r"ramps.py:2: duration: "),
        ("campaign = Campaign(duration='0s')", r"'0s' is to be above 0"),
        ("campaign = Campaign(", r"ramps.py:2: '\(' was never closed"),
        ("\nimport no_such_module", r"ramps.py:3: ModuleNotFoundError"),
        (
            "campaign = Campaign(duration='1s', measure=[Final('a'), Final('a')])",
            "two of them have the same name",
        ),
        (
            "campaign = Campaign(duration='1s')\ncampaign.scenario(print)",
            "the scenario says how long it runs",
        ),
    ],
)
def test_what_is_wrong_is_told_with_its_line(campaign_file: Write, text: str, error: str) -> None:
    with pytest.raises(CampaignError, match=error):
        load_campaign(campaign_file(text))


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(CampaignError, match=r"no such Python file; did you mean show\?"):
        load_campaign(tmp_path / "shwo")
