"""One run of a campaign: a fresh controller on the virtual clock, judged and measured."""

from __future__ import annotations

import math
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from plcsim.campaign.errors import CampaignError
from plcsim.campaign.measures import scalar
from plcsim.campaign.result import Result, RunOutcome, shortened
from plcsim.core.errors import PlcError
from plcsim.program.fault import describe, location_of
from plcsim.recorder.testing.recorder import RecorderFixture
from plcsim.testing import Plc
from plcsim.testing.errors import ExpectationFailed
from plcsim.testing.target import find_project, project_target

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from plcsim.campaign.definition import Campaign
    from plcsim.campaign.measures import Meter
    from plcsim.campaign.requirements import Observation
    from plcsim.campaign.result import PlannedRun
    from plcsim.campaign.variables import Scalar
    from plcsim.testing.trace import Trace


class RequirementFailed(ExpectationFailed):
    """Something that a campaign requires did not hold.

    Attributes:
        requirement: its text.
    """

    requirement = ""


def project_of(campaign: Campaign, file: Path) -> Path:
    """Return the folder of the project that the campaign in ``file`` runs.

    Raises:
        PlcError: there is none.
    """
    here = file.resolve().parent
    return here / campaign.project if campaign.project else find_project(here)


@contextmanager
def fresh_plc(campaign: Campaign, file: Path, seed: int) -> Iterator[Plc]:
    """Load the project afresh and give a controller that has not booted.

    No module of a program lives longer than its run, so no run can see what another one left.

    Raises:
        PlcError: the project does not load.
    """
    application = project_target(project_of(campaign, file))
    try:
        yield Plc(application, seed=seed)
    finally:
        application.unload()


class SingleRun:
    """Does one run.

    Args:
        campaign: what is to be done.
        order: with which values.
        record: tags to record.
        bag: file that the whole run is recorded into; needs the extra ``record``.

    Attributes:
        trace: what was recorded.
    """

    def __init__(
        self,
        campaign: Campaign,
        order: PlannedRun,
        record: Sequence[str] = (),
        bag: Path | None = None,
    ) -> None:
        self._campaign, self._order, self._record, self._bag = campaign, order, record, bag
        self._watched: list[Observation] = []
        self._meters: dict[str, Meter] = {}
        self._measured: dict[str, Scalar | None] = {}
        self.trace: Trace | None = None

    def perform(self, file: Path) -> Result:
        """Do it; whatever goes wrong is told by the result.

        Args:
            file: of the campaign.
        """
        try:
            with fresh_plc(self._campaign, file, self._order.seed) as plc:
                self._run(plc)
        except RequirementFailed as err:
            return self._result(RunOutcome.FAILED, err, err.requirement)
        except AssertionError as err:
            return self._result(RunOutcome.FAILED, err)
        except Exception as err:  # whatever the code of the campaign raises
            return self._result(RunOutcome.ERROR, err)
        return self._result(RunOutcome.PASSED)

    def _run(self, plc: Plc) -> None:
        recorder = None if self._bag is None else RecorderFixture(plc, self._bag.parent)
        try:
            plc.boot()
            self._campaign.check_names(plc, self._order.values)
            self._watch(plc)
            for name, value in self._order.values.items():
                if plc.controller.tags.get(name) is not None:
                    plc[name] = value
            measured = self._campaign.perform(plc, dict(self._order.values))
            self._measured |= {name: scalar(name, value) for name, value in measured.items()}
            self._judge(plc)
        finally:
            self._measured |= {name: meter.value() for name, meter in self._meters.items()}
            if recorder is not None and self._bag is not None:
                recorder.save(self._bag.name)
            plc.close()

    def _watch(self, plc: Plc) -> None:
        if self._record:
            self.trace = plc.record(*self._record)
        self._watched = [requirement.watch(plc) for requirement in self._campaign.require]
        self._meters = {each.name: each.watch(plc) for each in self._campaign.measure}
        plc.always(partial(self._after_cycle, plc))

    def _after_cycle(self, plc: Plc) -> bool:
        for meter in self._meters.values():
            meter.after_cycle()
        for observation in self._watched:
            if not observation.after_cycle():
                time_s = plc.last_release_ns / 1e9
                self._fail(plc, observation, f"at {time_s:g} s")
        return True

    def _judge(self, plc: Plc) -> None:
        for observation in self._watched:
            if not observation.at_end():
                self._fail(plc, observation, "when the run was over")

    def _fail(self, plc: Plc, observation: Observation, when: str) -> None:
        margin = "" if math.isinf(observation.margin) else f", margin {observation.margin:.4g}"
        failure = RequirementFailed(
            f"{observation.text}: does not hold {when}{margin}", (), plc.explain(plc.recent())
        )
        failure.requirement = observation.text
        raise failure

    def _result(
        self, outcome: RunOutcome, error: BaseException | None = None, requirement: str = ""
    ) -> Result:
        return Result(
            self._order,
            outcome,
            shortened(message_of(error)),
            requirement,
            self._margin(),
            self._measured,
            details="\n".join(getattr(error, "__notes__", ())),
        )

    def _margin(self) -> float | None:
        margins = [o.margin for o in self._watched if math.isfinite(o.margin)]
        return min(margins, default=None)


def message_of(error: BaseException | None) -> str:
    """Return in one line what an exception of a run says, with the line that raised it."""
    if error is None:
        return ""
    if isinstance(error, ExpectationFailed | CampaignError):
        return str(error)
    place = location_of(error)
    text = str(error) if isinstance(error, PlcError) else describe(error)
    return f"{text} ({place})" if place else text
