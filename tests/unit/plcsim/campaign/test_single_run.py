"""One run of a campaign, judged and measured."""

from collections.abc import Callable
from pathlib import Path

import pytest

from plcsim.campaign.definition import load_campaign
from plcsim.campaign.result import PlannedRun, Result, RunOutcome
from plcsim.campaign.single_run import SingleRun

Write = Callable[[str], Path]

RAMP = """
    campaign = Campaign(
        duration="1s",
        variables={"ramp.step": Uniform(0, 10), "ramp.trouble": Integer(0, 3)},
        require=[
            Always("stays below 500", lambda plc: 500 - plc["ramp.value"]),
            AtEnd("has come to 50", lambda plc: plc["ramp.value"] - 50),
        ],
        measure=[
            Final("ramp.value"),
            Maximum("ramp.step"),
            Minimum("ramp.value"),
            TimeUntil({"ramp.value": 20.0}, "twenty"),
        ],
    )
"""


def perform(file: Path, **values: float) -> Result:
    order = PlannedRun(3, 5, {name.replace("_", "."): value for name, value in values.items()})
    return SingleRun(load_campaign(file), order).perform(file)


def test_a_run_that_holds_is_measured(campaign_file: Write) -> None:
    result = perform(campaign_file(RAMP), ramp_step=2.0)
    assert result.outcome is RunOutcome.PASSED
    assert result.margin == 150
    assert result.measured == {
        "ramp.value": 200,
        "max ramp.step": 2,
        "min ramp.value": 2,
        "twenty": pytest.approx(0.095),
    }
    assert result.cause == ""


def test_what_has_always_to_hold_ends_the_run(campaign_file: Write) -> None:
    result = perform(campaign_file(RAMP), ramp_step=8.0)
    assert result.outcome is RunOutcome.FAILED
    assert result.message == "stays below 500: does not hold at 0.625 s, margin -4"
    assert result.cause == "stays below 500"
    assert result.margin == -4
    assert result.measured["ramp.value"] == 504
    assert "ramp.value" in result.details


def test_what_has_to_hold_at_the_end(campaign_file: Write) -> None:
    result = perform(campaign_file(RAMP), ramp_step=0.25)
    assert result.message == "has come to 50: does not hold when the run was over, margin -25"
    assert result.measured["twenty"] == pytest.approx(0.795)


def test_what_has_to_hold_once(campaign_file: Write) -> None:
    file = campaign_file(
        """
        campaign = Campaign(
            variables={"ramp.step": Uniform(0, 10)},
            duration="100ms",
            require=[Eventually("meets 6", lambda plc: -abs(plc["ramp.value"] - 6))],
        )
        """
    )
    assert perform(file, ramp_step=2.0).outcome is RunOutcome.PASSED
    missed = perform(file, ramp_step=5.0)
    assert (missed.outcome, missed.margin) == (RunOutcome.FAILED, -1)


def test_service_is_a_failure_grouped_by_its_reason(campaign_file: Write) -> None:
    result = perform(campaign_file(RAMP), ramp_step=1.0, ramp_trouble=1)
    assert result.outcome is RunOutcome.FAILED
    assert "division by zero" in result.message
    assert "main.py" in result.message


def test_a_scenario_and_what_it_returns(campaign_file: Write) -> None:
    file = campaign_file(
        """
        campaign = Campaign(variables={"goal": Uniform(0, 10), "ramp.step": Uniform(0, 10)})

        @campaign.scenario
        def run(plc, values):
            took_ns = plc.until(lambda: plc["ramp.value"] >= values["goal"], within="1s")
            assert plc["ramp.value"] == values["goal"], "goes beyond"
            return {"took_ms": took_ns / 1e6}
        """
    )
    good = perform(file, goal=4.0, ramp_step=2.0)
    assert (good.outcome, good.measured) == (RunOutcome.PASSED, {"took_ms": 15.0})
    bad = perform(file, goal=5.0, ramp_step=2.0)
    assert bad.outcome is RunOutcome.FAILED
    assert "goes beyond" in bad.message
    never = perform(file, goal=9.0, ramp_step=0.0)
    assert never.outcome is RunOutcome.FAILED
    assert never.cause.startswith("waited …")


def test_errors_of_the_campaign_say_nothing_of_the_program(campaign_file: Write) -> None:
    file = campaign_file(
        """
        campaign = Campaign(variables={"speed": Uniform(0, 1)})

        @campaign.scenario
        def run(plc, values):
            raise KeyError(values["speed"])
        """
    )
    result = perform(file, speed=0.5)
    assert result.outcome is RunOutcome.ERROR
    assert result.message.startswith("KeyError: 0.5")
    assert "ramps.py:7" in result.message


def test_the_same_run_is_the_same_again(campaign_file: Write) -> None:
    file = campaign_file(
        """
        campaign = Campaign(variables={"ramp.step": Uniform(0, 10)}, measure=[Final("ramp.value")])

        @campaign.scenario
        def run(plc, values):
            plc.faults.noise("ramp.value", 1.0)
            plc.run("200ms")
        """
    )
    first = perform(file, ramp_step=1.0)
    assert perform(file, ramp_step=1.0) == first
    assert first.measured["ramp.value"] != 20
