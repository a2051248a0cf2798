"""The search for a run that fails, led by how far each run was from failing.

Falsification as for temporal logic: the margin of the requirements (`plcsim.campaign.requirements`)
is made as small as it gets by differential evolution (SciPy); a value below 0 is a failure found.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from plcsim.campaign.errors import CampaignError
from plcsim.campaign.result import PlannedRun, RunOutcome
from plcsim.campaign.sampling import values_at

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from plcsim.campaign.result import Result
    from plcsim.campaign.variables import VariedVariable

GENERATION: Final = 8
"""Runs of a generation for each variable, within the limits below."""

_SMALLEST_GENERATION, _LARGEST_GENERATION = 16, 128


@dataclass(frozen=True)
class Falsify:
    """Looks for a run that fails, and ends with the first generation that has one.

    Args:
        runs: at most so many, rounded up to whole generations.
    """

    runs: int = 500

    def search(
        self,
        variables: Mapping[str, VariedVariable],
        seed: int,
        perform: Callable[[Sequence[PlannedRun]], Iterable[Result]],
    ) -> None:
        """Search.

        Args:
            variables: what may be chosen.
            seed: of the search, and of the first run.
            perform: does runs and returns their results in any order.

        Raises:
            CampaignError: there is nothing to vary.
        """
        if not variables:
            raise CampaignError("Falsify: name the variables that may be chosen")
        _Search(variables, seed, perform).run(self.runs)


class _Found(Exception):  # noqa: N818  # ends the search; nothing is wrong
    """A generation has a failure."""


class _Search:
    def __init__(
        self,
        variables: Mapping[str, VariedVariable],
        seed: int,
        perform: Callable[[Sequence[PlannedRun]], Iterable[Result]],
    ) -> None:
        self._variables, self._seed, self._perform = variables, seed, perform
        self._number = 0

    def run(self, most: int) -> None:
        from scipy.optimize import differential_evolution  # noqa: PLC0415  # takes half a second

        dimensions = len(self._variables)
        size = min(max(GENERATION * dimensions, _SMALLEST_GENERATION), _LARGEST_GENERATION)
        try:
            differential_evolution(
                lambda _: 0.0,  # never called: _generation takes whole generations
                [(0.0, 1.0)] * dimensions,
                maxiter=max(0, math.ceil(most / size) - 1),
                popsize=math.ceil(size / dimensions),
                tol=0,
                rng=self._seed,
                polish=False,
                updating="deferred",
                workers=self._generation,
                init="sobol",
            )
        except _Found:
            return

    def _generation(self, _function: Any, points: Iterable[Sequence[float]]) -> list[float]:
        values = values_at(self._variables, points)
        first, self._number = self._number, self._number + len(values)
        orders = [
            PlannedRun(number, self._seed + number, each)
            for number, each in enumerate(values, first)
        ]
        results = {result.order.number: result for result in self._perform(orders)}
        if any(result.outcome is not RunOutcome.PASSED for result in results.values()):
            raise _Found
        margins = (results[order.number].margin for order in orders)
        return [math.inf if margin is None else margin for margin in margins]
