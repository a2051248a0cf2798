"""The processes that do the runs of a campaign."""

import signal
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("distributed", reason="the extra campaign is not installed")

from plcsim.campaign import workers  # where it is installed
from plcsim.campaign.result import PlannedRun, RunOutcome  # likewise
from plcsim.campaign.workers import Runner  # likewise

CAMPAIGN = """
    campaign = Campaign(variables={"ramp.step": Uniform(0, 1)}, sampling=Random(1))

    @campaign.scenario
    def run(plc, values):
        plc.run("10ms")
"""


def test_ctrl_c_does_not_end_a_process_that_has_just_been_started(
    campaign_file: Callable[[str], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It reaches all of the group, and Python ends by it until somebody says otherwise."""

    class Interrupted(subprocess.Popen[bytes]):
        def __init__(self, *arguments: object, **options: object) -> None:
            super().__init__(*arguments, **options)  # type: ignore[call-overload]  # handed on as given
            self.send_signal(signal.SIGINT)

    file = campaign_file(CAMPAIGN)
    monkeypatch.setattr(workers.subprocess, "Popen", Interrupted)
    runner = Runner(file, file.parent)
    try:
        result = runner.perform(PlannedRun(1, 1, {"ramp.step": 0.5}), 100)
    finally:
        runner.end()
    assert result.outcome is RunOutcome.PASSED
