"""A campaign that is done: what is planned, what is done already, the rest on the workers."""

from __future__ import annotations

import time
from contextlib import contextmanager
from importlib.metadata import version
from typing import TYPE_CHECKING, Final

from plcsim.campaign.content import RESULTS_SUFFIX, pack
from plcsim.campaign.definition import load_campaign
from plcsim.campaign.result import PlannedRun
from plcsim.campaign.search import Falsify
from plcsim.campaign.single_run import fresh_plc, project_of
from plcsim.campaign.store import About, ResultStore
from plcsim.core.errors import PlcError
from plcsim.project.plc_toml import read_project

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path

    from plcsim.campaign.cluster import Cluster
    from plcsim.campaign.definition import Campaign
    from plcsim.campaign.result import Result
    from plcsim.campaign.sampling import Values

FLUSH_PERIOD_S: Final = 2.0
"""Between two parts of the results on disk."""


class CampaignSession:
    """A campaign, loaded and checked, with what its workers need.

    Args:
        file: of the campaign.

    Raises:
        PlcError: the campaign or its project cannot be run; nothing has been run.

    Attributes:
        campaign: what the file defines.
        content: what travels to the workers.
        planned: the values of every run; empty for a search.
    """

    def __init__(self, file: Path) -> None:
        self.file = file
        self.campaign = load_campaign(file)
        project = read_project(project_of(self.campaign, file))
        libraries = [place.folder for place in project.layout.libraries]
        self.content = pack(file, [project.folder, project.layout.folder, *libraries])
        self.planned = self._plan()
        check(self.campaign, file, self.planned[0] if self.planned else self._middle())

    def _plan(self) -> list[Values]:
        sampling = self.campaign.sampling
        if isinstance(sampling, Falsify):
            return []
        return sampling.plan(self.campaign.variables, self.campaign.seed, self.file.parent)

    def _middle(self) -> Values:
        return {name: each.at(0.5) for name, each in self.campaign.variables.items()}

    @property
    def runs(self) -> int:
        """Runs that are planned; of a search the most that it may take."""
        sampling = self.campaign.sampling
        return sampling.runs if isinstance(sampling, Falsify) else len(self.planned)

    def about(self) -> About:
        """Return what its results are of."""
        return About(self.file.name, self.content.name, self.runs, version("plcsim"))

    def order(self, number: int) -> PlannedRun:
        """Return a run of the plan."""
        return PlannedRun(number, self.campaign.seed + number, self.planned[number])

    def perform(self, cluster: Cluster, store: ResultStore, tell: Callable[[Result], None]) -> None:
        """Do what is not done yet.

        Args:
            cluster: who does it.
            store: where results go, and where those lie that are there.
            tell: called with every result, in the order in which they come.
        """
        sampling = self.campaign.sampling
        if isinstance(sampling, Falsify):
            known = {result.order.number: result for result in store.results()}

            def generation(orders: Sequence[PlannedRun]) -> Iterable[Result]:
                new = [order for order in orders if order.number not in known]
                found = list(_kept(cluster.perform(new), store, tell))
                return [known[o.number] for o in orders if o.number in known] + found

            sampling.search(self.campaign.variables, self.campaign.seed, generation)
        else:
            left = (self.order(n) for n in range(len(self.planned)) if n not in store.done)
            for _ in _kept(cluster.perform(left), store, tell):
                pass
        store.complete()


def _kept(
    results: Iterable[Result], store: ResultStore, tell: Callable[[Result], None]
) -> Iterator[Result]:
    """Store results as they come; kill -9 loses those of `FLUSH_PERIOD_S` at most."""
    flushed_s = time.monotonic()
    try:
        for result in results:
            store.add(result)
            if time.monotonic() - flushed_s > FLUSH_PERIOD_S:
                store.flush()
                flushed_s = time.monotonic()
            tell(result)
            yield result
    finally:
        store.flush()


def check(campaign: Campaign, file: Path, values: Values) -> None:
    """Find out whether a campaign fits its project.

    Raises:
        PlcError: it does not; the file is named.
    """
    with _named(file), fresh_plc(campaign, file, campaign.seed) as plc:
        campaign.check_names(plc, values)
        for name, value in values.items():
            if plc.controller.tags.get(name) is not None:
                plc.tags.encode(name, value)
        for each in campaign.measure:
            each.watch(plc)


@contextmanager
def _named(file: Path) -> Iterator[None]:
    try:
        yield
    except PlcError as err:
        err.args = (f"{file}: {err}",)
        raise


def results_folder(file: Path, output: Path | None) -> Path:
    """Return where the results of a campaign lie."""
    return output or file.with_name(file.stem + RESULTS_SUFFIX)
