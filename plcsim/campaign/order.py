"""Which run ``plcsim campaign repeat`` is asked for."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from plcsim.campaign.errors import CampaignError
from plcsim.campaign.result import PlannedRun
from plcsim.campaign.search import Falsify
from plcsim.campaign.store import read_folder
from plcsim.core.suggestion import did_you_mean

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.campaign.definition import Campaign
    from plcsim.campaign.sampling import Values
    from plcsim.campaign.variables import Scalar


def order_of(options: argparse.Namespace, campaign: Campaign, folder: Path) -> PlannedRun:
    """Return the run with a number, with single values changed, or one of given values only.

    Raises:
        CampaignError: there is no such run, or a value has no name that the run knows.
    """
    order = _numbered(options, campaign, folder)
    values = _with(order.values, options.set)
    return replace(order, values=values, seed=order.seed if options.seed is None else options.seed)


def _numbered(options: argparse.Namespace, campaign: Campaign, folder: Path) -> PlannedRun:
    if options.number is None:
        values = {name: variable.simplest for name, variable in campaign.variables.items()}
        return PlannedRun(0, campaign.seed, values)
    if isinstance(campaign.sampling, Falsify):
        return _done(options.number, folder)
    planned = campaign.sampling.plan(campaign.variables, campaign.seed, options.file.parent)
    if not 0 <= options.number < len(planned):
        raise CampaignError(f"{options.number}: runs are numbered from 0 to {len(planned) - 1}")
    return PlannedRun(options.number, campaign.seed + options.number, planned[options.number])


def _done(number: int, folder: Path) -> PlannedRun:
    """Return a run of a search: only its results know its values."""
    _, results = read_folder(folder)
    for result in results:
        if result.order.number == number:
            return result.order
    raise CampaignError(f"{folder}: the search has done no run {number}")


def _with(values: Values, given: Sequence[str]) -> Values:
    changed = dict(values)
    for text in given:
        name, sign, value = text.partition("=")
        if not sign:
            raise CampaignError(f"--set {text}: give NAME=VALUE")
        if name not in values:
            hint = did_you_mean(name, values)
            raise CampaignError(f"--set {text}: the campaign does not vary {name}{hint}")
        changed[name] = _like(values[name], value, text)
    return changed


def _like(before: Scalar, value: str, text: str) -> Scalar:
    """Return a value of the kind that another one has."""
    if isinstance(before, str):
        return value
    try:
        if isinstance(before, bool):
            return {"TRUE": True, "FALSE": False}[value.upper()]
        return int(value) if isinstance(before, int) else float(value)
    except (KeyError, ValueError):
        raise CampaignError(f"--set {text}: {value!r} is not {_kind(before)}") from None


def _kind(value: Scalar) -> str:
    if isinstance(value, bool):
        return "TRUE or FALSE"
    return "a whole number" if isinstance(value, int) else "a number"
