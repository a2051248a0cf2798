"""Which values the runs of a campaign get: a grid, random numbers, sequences of SciPy, a file.

Every plan is a list that depends on the variables and the seed alone, so that run number N is the
same wherever and whenever it is done.
"""

from __future__ import annotations

import csv
import itertools
from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, Final, Protocol

import numpy as np

from plcsim.campaign.errors import CampaignError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

    from plcsim.campaign.variables import Scalar, VariedVariable

MOST_RUNS: Final = 1_000_000
"""Runs that a campaign may have; more is taken for a grid that nobody has counted."""

Values = dict[str, "Scalar"]


class Sampling(Protocol):
    """Chooses the values of every run."""

    def plan(
        self, variables: Mapping[str, VariedVariable], seed: int, folder: Path, /
    ) -> list[Values]:
        """Return the values of each run; files are relative to ``folder``."""


@dataclass(frozen=True)
class Grid:
    """Every combination.

    Args:
        steps: values of each `Uniform` and `Integer`, both ends among them; of a `Choice` all.
    """

    steps: int = 5

    def plan(
        self, variables: Mapping[str, VariedVariable], _seed: int, _folder: Path
    ) -> list[Values]:
        """Return every combination; the last variable changes fastest."""
        if self.steps < 1:
            raise CampaignError(f"Grid({self.steps}): at least 1 step")
        axes = [variable.steps(self.steps) for variable in variables.values()]
        _check_count(prod(len(axis) for axis in axes))
        return [dict(zip(variables, row, strict=True)) for row in itertools.product(*axes)]


@dataclass(frozen=True)
class Random:
    """Values drawn independently of each other.

    Args:
        runs: how many.
    """

    runs: int

    def plan(
        self, variables: Mapping[str, VariedVariable], seed: int, _folder: Path
    ) -> list[Values]:
        """Return the values of each run."""
        _check_count(self.runs)
        shares = np.random.default_rng(seed).random((self.runs, len(variables)))
        return values_at(variables, shares)


@dataclass(frozen=True)
class LatinHypercube:
    """Each variable's range is divided into as many parts as there are runs; each is met once.

    Args:
        runs: how many.
    """

    runs: int

    def plan(
        self, variables: Mapping[str, VariedVariable], seed: int, _folder: Path
    ) -> list[Values]:
        """Return the values of each run."""
        from scipy.stats import qmc  # noqa: PLC0415  # takes half a second

        _check_count(self.runs)
        shares = qmc.LatinHypercube(len(variables), rng=seed).random(self.runs)
        return values_at(variables, shares)


@dataclass(frozen=True)
class Sobol:
    """A scrambled Sobol sequence: fills the space more evenly than chance.

    Args:
        runs: how many; a power of two fills it best.
    """

    runs: int

    def plan(
        self, variables: Mapping[str, VariedVariable], seed: int, _folder: Path
    ) -> list[Values]:
        """Return the values of each run."""
        from scipy.stats import qmc  # noqa: PLC0415  # takes half a second

        _check_count(self.runs)
        if len(variables) > qmc.Sobol.MAXDIM:
            raise CampaignError(f"Sobol: at most {qmc.Sobol.MAXDIM} variables")
        power = max(0, (self.runs - 1).bit_length())
        shares = qmc.Sobol(len(variables), rng=seed).random_base2(power)[: self.runs]
        return values_at(variables, shares)


@dataclass(frozen=True)
class FromCsv:
    """The lines of a file, one run each; its first line names the variables.

    A column that holds numbers only is one of numbers, one that holds TRUE and FALSE only is one
    of BOOL, any other is text.

    Args:
        file: relative to the file of the campaign.
    """

    file: str

    def plan(
        self, variables: Mapping[str, VariedVariable], _seed: int, folder: Path
    ) -> list[Values]:
        """Return the values of each run; ``variables`` is to be empty."""
        if variables:
            raise CampaignError(f"FromCsv({self.file!r}): its columns are the variables; name none")
        path = folder / self.file
        try:
            with path.open(encoding="utf-8-sig", newline="") as text:
                rows = [row for row in csv.reader(text) if row]
        except (OSError, UnicodeDecodeError, csv.Error) as err:
            raise CampaignError(f"{path}: cannot be read: {err}") from None
        return _from_rows(path, rows)


def _from_rows(path: Path, rows: Sequence[Sequence[str]]) -> list[Values]:
    if len(rows) < 2:
        raise CampaignError(f"{path}: one line with the names, and at least one with values")
    head = [name.strip() for name in rows[0]]
    if "" in head or len(set(head)) < len(head):
        raise CampaignError(f"{path}:1: every column needs a name of its own")
    for line, row in enumerate(rows[1:], 2):
        if len(row) != len(head):
            raise CampaignError(f"{path}:{line}: {len(row)} cells under {len(head)} names")
    columns = [_typed([cell.strip() for cell in column]) for column in zip(*rows[1:], strict=True)]
    return [dict(zip(head, row, strict=True)) for row in zip(*columns, strict=True)]


def _typed(cells: Sequence[str]) -> Sequence[Scalar]:
    if all(cell.upper() in ("TRUE", "FALSE") for cell in cells):
        return [cell.upper() == "TRUE" for cell in cells]
    for kind in (int, float):
        try:
            return [kind(cell) for cell in cells]
        except ValueError:
            continue
    return cells


def values_at(
    variables: Mapping[str, VariedVariable], shares: Iterable[Sequence[float]]
) -> list[Values]:
    """Return the values of each row of shares, one column for each variable."""
    named = list(variables.items())
    return [
        {name: each.at(float(share)) for (name, each), share in zip(named, row, strict=True)}
        for row in shares
    ]


def _check_count(runs: int) -> None:
    if not 1 <= runs <= MOST_RUNS:
        raise CampaignError(f"{runs} runs: a campaign has 1 to {MOST_RUNS}")
