"""A campaign that is checked before anything runs."""

from collections.abc import Callable
from pathlib import Path

import pytest

for package in ("scipy", "pyarrow"):
    pytest.importorskip(package, reason="the extra campaign is not installed")

from plcsim.campaign.session import CampaignSession  # noqa: E402  # where it is installed
from plcsim.core.errors import PlcError  # noqa: E402  # likewise

Write = Callable[[str], Path]


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        ("variables={'ramp.stp': Uniform(0, 1)}", r"ramps.py: variables: ramp.stp is no tag; did"),
        ("variables={'speed': Uniform(0, 1)}", "and there is no scenario that it could be for"),
        ("variables={'ramp.trouble': Uniform(0, 1)}", r"ramps.py: tag ramp.trouble: "),
        ("measure=[Final('ramp.x')]", r"ramps.py: .*ramp.x"),
        ("project='nowhere'", "nowhere"),
        ("sampling=FromCsv('none.csv')", "none.csv: cannot be read"),
    ],
)
def test_what_does_not_fit_the_project(campaign_file: Write, arguments: str, error: str) -> None:
    file = campaign_file(f"campaign = Campaign(duration='1s', {arguments})")
    with pytest.raises(PlcError, match=error):
        CampaignSession(file)


def test_the_content_is_the_project_and_nothing_else(campaign_file: Write) -> None:
    file = campaign_file("campaign = Campaign(duration='1s')")
    first = CampaignSession(file).content
    (file.parent / "ramps.results").mkdir()
    (file.parent / "ramps.results" / "part-0.parquet").write_bytes(b"x")
    (file.parent / ".git").mkdir()
    (file.parent / ".git" / "index").write_bytes(b"x")
    assert CampaignSession(file).content == first
    (file.parent / "ramp" / "more.py").write_text("")
    assert CampaignSession(file).content != first


def test_the_content_is_the_same_wherever_it_is_unpacked(
    campaign_file: Write, tmp_path: Path
) -> None:
    content = CampaignSession(campaign_file("campaign = Campaign(duration='1s')")).content
    assert CampaignSession(content.unpack(tmp_path / "elsewhere")).content == content
