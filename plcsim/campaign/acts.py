"""What the commands of ``plcsim campaign`` do; imported where the extra ``campaign`` is there."""

from __future__ import annotations

import time
from contextlib import contextmanager
from dataclasses import replace
from importlib.util import find_spec
from typing import TYPE_CHECKING, Final

from plcsim.campaign.cluster import Cluster
from plcsim.campaign.definition import load_campaign
from plcsim.campaign.errors import CampaignError
from plcsim.campaign.order import order_of
from plcsim.campaign.picture import PICTURE_FILE, draw
from plcsim.campaign.progress import ProgressBar
from plcsim.campaign.result import RunOutcome
from plcsim.campaign.session import CampaignSession, results_folder
from plcsim.campaign.show import (
    causes_of,
    print_causes,
    print_example,
    print_measured,
    print_outcomes,
    print_result,
)
from plcsim.campaign.shrink import shrink
from plcsim.campaign.single_run import SingleRun
from plcsim.campaign.store import Examples, ResultStore, read_folder
from plcsim.cli.console import CommandConsole
from plcsim.cli.exit_codes import ExitCode
from plcsim.cli.output_file import check_output, write_output

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from plcsim.campaign.result import PlannedRun, Result
    from plcsim.campaign.show import FailureCause

MOST_EXAMPLES: Final = 3
"""Causes of which an example is shown, the most frequent ones."""


def run(options: argparse.Namespace) -> int:
    """Do the runs that are not done yet, and show what came of all."""
    session = CampaignSession(options.file)
    store = ResultStore(_folder(options), session.about(), fresh=options.fresh)
    console = CommandConsole()
    if store.done:
        console.print(f"{_folder(options)}: {len(store.done)} runs are done already")
    with _cluster(session, options.scheduler, options.processors) as cluster:
        with ProgressBar(console, session.runs, len(store.done), cluster) as progress:
            session.perform(cluster, store, progress.add)
        return _Shown(options, session, console).show(None if options.no_shrink else cluster)


def show(options: argparse.Namespace) -> int:
    """Show what came of a campaign so far."""
    session = CampaignSession(options.file)
    shown = _Shown(options, session, CommandConsole())
    if not shown.lacks_examples or options.no_shrink:
        return shown.show(None)
    with _cluster(session) as cluster:
        return shown.show(cluster)


def repeat(options: argparse.Namespace) -> int:
    """Do one run again in this process, and tell what happened."""
    check_output("--csv", options.csv)
    check_output("--bag", options.bag)
    if options.bag is not None and find_spec("rosbags") is None:
        raise CampaignError("--bag: needs rosbags: pip install 'plcsim[record]'")
    if options.csv is not None and not options.record:
        raise CampaignError("--csv: name with --record TAG what it is to hold")
    campaign = load_campaign(options.file)
    order = order_of(options, campaign, _folder(options))
    single = SingleRun(campaign, order, options.record, options.bag)
    started = time.perf_counter()
    result = replace(single.perform(options.file), host_s=time.perf_counter() - started)
    print_result(CommandConsole(), result)
    if options.csv is not None and single.trace is not None:
        write_output("--csv", options.csv, single.trace.to_csv())
    return ExitCode.DONE if result.outcome is RunOutcome.PASSED else ExitCode.FAILED


def _folder(options: argparse.Namespace) -> Path:
    return results_folder(options.file, options.output)


@contextmanager
def _cluster(
    session: CampaignSession, scheduler: str = "", processors: int = 0
) -> Iterator[Cluster]:
    limit_s = session.campaign.time_limit_ns / 1e9
    cluster = Cluster(session.content, limit_s, scheduler, processors)
    try:
        yield cluster
    finally:
        cluster.close()


class _Shown:
    """The results of a campaign, as they are shown."""

    def __init__(
        self, options: argparse.Namespace, session: CampaignSession, console: CommandConsole
    ) -> None:
        self._file, self._folder = options.file, _folder(options)
        self._session, self._console = session, console
        self._about, self._results = read_folder(self._folder)
        self._causes = causes_of(self._results)
        self._examples = Examples(self._folder, session.content.name)

    @property
    def lacks_examples(self) -> bool:
        """Whether there is a cause that nobody has looked for the smallest example of."""
        shown = self._causes[:MOST_EXAMPLES]
        return any(self._examples.get(cause.text) is None for cause in shown)

    def show(self, cluster: Cluster | None) -> int:
        """Print all; failures are made smaller where there is a cluster for it."""
        if self._about.content != self._session.content.name:
            self._console.print(f"{self._folder}: the campaign or its project has changed since")
        if not self._results:
            self._console.print(f"{self._folder}: no run is done yet")
            return ExitCode.FAILED
        planned = self._about.runs if self._session.planned else len(self._results)
        print_outcomes(self._console, self._results, planned)
        print_measured(self._console, self._results)
        if self._causes:
            print_causes(self._console, self._causes, len(self._results))
        for cause in self._causes[:MOST_EXAMPLES]:
            print_example(self._console, cause, self._example(cause, cluster), self._file)
        self._draw()
        return ExitCode.FAILED if self._causes else ExitCode.DONE

    def _draw(self) -> None:
        self._console.print()
        if self._results[0].order.values:
            picture = self._folder / PICTURE_FILE
            draw(self._results, picture, f"{self._file.stem}: {len(self._results)} runs")
            self._console.print(f"picture: {picture}", soft_wrap=True)
        self._console.print(f"results: {self._folder}", soft_wrap=True)

    def _example(self, cause: FailureCause, cluster: Cluster | None) -> Result | None:
        """Return the smallest example of a cause, found before or now."""
        known = self._examples.get(cause.text)
        if known is not None or cluster is None:
            return known

        def perform(orders: Sequence[PlannedRun]) -> dict[int, Result]:
            return {result.order.number: result for result in cluster.perform(orders)}

        simplest = shrink(cause.failures[0], self._session.campaign.variables, perform)
        self._examples.keep(simplest)
        return simplest
