"""A campaign as its file says it."""

from __future__ import annotations

import importlib.util
import sys
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from plcsim.campaign.errors import CampaignError
from plcsim.campaign.sampling import Random
from plcsim.core.duration import parse_duration_ns
from plcsim.core.suggestion import did_you_mean
from plcsim.program.fault import describe, location_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from plcsim.campaign.measures import Measure
    from plcsim.campaign.requirements import Requirement
    from plcsim.campaign.sampling import Sampling
    from plcsim.campaign.search import Falsify
    from plcsim.campaign.variables import Scalar, VariedVariable
    from plcsim.testing import Plc

    Scenario = Callable[[Plc, dict[str, Scalar]], Mapping[str, Scalar] | None]

NAME: Final = "campaign"
"""What a file calls the campaign that it defines."""


@dataclass
class Campaign:
    """What is varied, what is run, what is measured, and what counts as failed.

    Args:
        variables: what is varied. A name that is a tag is stored in it after the INITs; the others
            are for the scenario.
        duration: how long each run takes on the controller's clock, such as ``"60s"``, where there
            is no scenario.
        sampling: which values the runs get, or how they are searched for.
        require: what has to hold.
        measure: what is measured of each run.
        project: the folder with plc.toml, relative to the file; by default the one that the file
            lies in.
        seed: of the sampling; run number N has the seed ``seed + N`` for network and noise.
        time_limit: a run that takes longer on the host is ended, and counts as hung.

    Raises:
        CampaignError: something of it cannot be.
    """

    variables: Mapping[str, VariedVariable] = field(default_factory=dict)
    duration: str = ""
    sampling: Sampling | Falsify = field(default_factory=lambda: Random(100))
    require: Sequence[Requirement] = ()
    measure: Sequence[Measure] = ()
    project: str = ""
    seed: int = 0
    time_limit: str = "60s"
    _scenario: Scenario | None = None

    def __post_init__(self) -> None:
        self.duration_ns = _duration_ns("duration", self.duration) if self.duration else 0
        self.time_limit_ns = _duration_ns("time_limit", self.time_limit)
        names = [each.name for each in self.measure]
        if len(set(names)) < len(names):
            raise CampaignError("measure: two of them have the same name")

    def scenario(self, function: Scenario) -> Scenario:
        """Take a function as what happens in a run (a decorator).

        The function gets the controller, booted, with the tags of ``variables`` stored, as tests
        have it from the fixture ``plc``; and the values of this run by name. What it returns, by
        name, is measured as well; an AssertionError is a failure.
        """
        if self.duration_ns:
            raise CampaignError("duration: the scenario says how long it runs; leave it out")
        self._scenario = function
        return function

    def perform(self, plc: Plc, values: dict[str, Scalar]) -> Mapping[str, Scalar]:
        """Do one run on a controller that has booted; return what the scenario measured."""
        if self._scenario is None:
            plc.advance(self.duration_ns)
            return {}
        return self._scenario(plc, values) or {}

    def check(self) -> None:
        """Find out whether it is complete.

        Raises:
            CampaignError: it is not.
        """
        if self._scenario is None and not self.duration_ns:
            raise CampaignError("duration: say how long a run takes, or write a scenario")

    def check_names(self, plc: Plc, values: Mapping[str, Scalar]) -> None:
        """Find out whether the tags of a run are there.

        Raises:
            CampaignError: a variable is no tag, and no scenario asks for it.
        """
        for name in values:
            if plc.controller.tags.get(name) is not None or (
                self._scenario is not None and "." not in name
            ):
                continue
            hint = did_you_mean(name, plc.tags.paths())
            raise CampaignError(
                f"variables: {name} is no tag{hint}"
                + ("" if self._scenario else ", and there is no scenario that it could be for")
            )


def _duration_ns(name: str, text: str) -> int:
    try:
        span_ns = parse_duration_ns(text)
    except (ValueError, TypeError, AttributeError) as err:
        raise CampaignError(f"{name}: {err}") from None
    if span_ns <= 0:
        raise CampaignError(f"{name}: {text!r} is to be above 0")
    return span_ns


def load_campaign(file: Path) -> Campaign:
    """Import the file of a campaign.

    Raises:
        CampaignError: it cannot be imported, or holds no complete campaign; the line is named.
    """
    campaign = getattr(_module_of(file), NAME, None)
    if not isinstance(campaign, Campaign):
        raise CampaignError(f"{file}: has no {NAME} = Campaign(...)")
    try:
        campaign.check()
    except CampaignError as err:
        raise CampaignError(f"{file}: {err}") from None
    return campaign


def _module_of(file: Path) -> Any:
    spec = importlib.util.spec_from_file_location(f"plcsim_campaign_{file.stem}", file)
    if spec is None or spec.loader is None or not file.is_file():
        hint = did_you_mean(file.name, ("show", "repeat", "run")) if not file.suffix else ""
        raise CampaignError(f"{file}: there is no such Python file{hint}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
    except SyntaxError as err:
        raise CampaignError(f"{file}:{err.lineno}: {err.msg}") from None
    except Exception as err:  # whatever the file does
        raise CampaignError(f"{location_of(err) or file}: {describe(err)}") from None
    return module
