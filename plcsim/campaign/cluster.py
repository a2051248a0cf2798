"""Dask, which spreads the runs of a campaign over processors and machines."""

from __future__ import annotations

import contextlib
import itertools
import logging
import os
from collections import deque
from typing import TYPE_CHECKING, Any, Final

from distributed import Client, LocalCluster, as_completed
from distributed.scheduler import KilledWorker

from plcsim.campaign.errors import CampaignError
from plcsim.campaign.result import Result, RunOutcome
from plcsim.campaign.workers import Installation, perform, plugin_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from plcsim.campaign.content import Content
    from plcsim.campaign.result import PlannedRun

    Batch = tuple[PlannedRun, ...]

CONNECT_LIMIT_S: Final = 15
WORKERS_LIMIT_S: Final = 60
AHEAD: Final = 3
"""Runs that wait at a worker for each that is being done, so that none of them has to wait."""

BATCH_S: Final = 0.25
"""Seconds of work that are given to a worker at once: each message costs some ten milliseconds."""

MOST_AT_ONCE: Final = 50

MOST_LOSSES: Final = 5
"""Times that a run is begun again because its worker went, until the run itself is suspected."""


class Cluster:
    """Workers that do the runs of one campaign.

    Args:
        content: of the campaign.
        limit_s: seconds that a run may take on the host.
        scheduler: address of a Dask scheduler; "" for one in this process, with as many workers as
            this process may use processors.
        processors: of this process, 0 for all.

    Raises:
        CampaignError: there is no such scheduler, or it has no workers.
    """

    def __init__(
        self, content: Content, limit_s: float, scheduler: str = "", processors: int = 0
    ) -> None:
        logging.getLogger("distributed").setLevel(logging.CRITICAL)  # told in our own words
        self._content, self._limit_s = content, limit_s
        self._local: LocalCluster | None = None
        if not scheduler:
            count = processors or len(os.sched_getaffinity(0))
            self._local = LocalCluster(
                n_workers=1, threads_per_worker=count, processes=False, dashboard_address=None
            )
        try:
            self._client = Client(self._local or scheduler, timeout=CONNECT_LIMIT_S)
        except (OSError, ValueError) as err:
            raise CampaignError(f"--scheduler {scheduler}: cannot be reached: {err}") from None
        try:
            self._install(scheduler)
        except BaseException:
            self.close()
            raise

    def _install(self, scheduler: str) -> None:
        try:
            self._client.wait_for_workers(1, timeout=WORKERS_LIMIT_S)
        except TimeoutError:
            raise CampaignError(f"--scheduler {scheduler}: it has no workers") from None
        answers = self._client.register_plugin(Installation(self._content))
        for worker, answer in (answers or {}).items():
            if answer.get("status") == "error":
                error = answer.get("exception", "")
                raise CampaignError(f"worker {worker}: {getattr(error, 'data', error)}")

    @property
    def processors(self) -> int:
        """Runs that are done at a time now."""
        return sum(self._client.nthreads().values())

    def perform(self, orders: Iterable[PlannedRun]) -> Iterator[Result]:
        """Do runs; yield their results as they come.

        Only as many runs as are needed wait at the workers, however many there are.
        """
        waiting = iter(orders)
        again: deque[Batch] = deque()
        underway: dict[Any, Batch] = {}
        losses: dict[int, int] = {}
        size = 1
        done = as_completed(with_results=True, raise_errors=False)

        def submit() -> None:
            free = max(1, self.processors) * (1 + AHEAD) - len(underway)
            for _ in range(free):
                batch = again.popleft() if again else tuple(itertools.islice(waiting, size))
                if not batch:
                    return
                future = self._submit(batch)
                underway[future] = batch
                done.add(future)

        submit()
        for future, found in done:
            batch = underway.pop(future)
            first = batch[0].number
            if isinstance(found, list):
                yield from found
                size = batch_size(found)
            elif _is_loss(found) and losses.get(first, 0) < MOST_LOSSES:
                losses[first] = losses.get(first, 0) + 1
                again.append(batch)
            else:
                yield from (Result(order, RunOutcome.ERROR, _message(found)) for order in batch)
            submit()

    def _submit(self, batch: Batch) -> Any:
        return self._client.submit(perform, self._content.name, batch, self._limit_s, pure=False)

    def close(self) -> None:
        """Let the workers go; those of a scheduler that was there before stay."""
        with contextlib.suppress(OSError, TimeoutError):
            if self._local is None:
                self._client.unregister_worker_plugin(plugin_name(self._content.name))
            self._client.close()
        if self._local is not None:
            self._local.close()


def batch_size(results: Sequence[Result]) -> int:
    """Return how many runs to give to a worker at once, from those of the batch before."""
    longest_s = max(result.host_s for result in results)
    return max(1, min(MOST_AT_ONCE, int(BATCH_S / longest_s))) if longest_s else 1


def _is_loss(result: object) -> bool:
    """Whether a run has no result because of its worker."""
    error = result[1] if isinstance(result, tuple) else result
    return isinstance(error, KilledWorker | KeyError)


def _message(result: object) -> str:
    error = result[1] if isinstance(result, tuple) else result
    return str(error)
