"""Campaigns: many runs of a project on the virtual clock, to find where it breaks.

A file defines a `Campaign`; ``plcsim campaign FILE`` runs it (docs/campaigns.md).
"""

from plcsim.campaign.definition import Campaign
from plcsim.campaign.errors import CampaignError
from plcsim.campaign.measures import Final, Maximum, Minimum, TimeUntil
from plcsim.campaign.requirements import Always, AtEnd, Eventually
from plcsim.campaign.sampling import FromCsv, Grid, LatinHypercube, Random, Sobol
from plcsim.campaign.search import Falsify
from plcsim.campaign.variables import Choice, Integer, Uniform

__all__ = [
    "Always",
    "AtEnd",
    "Campaign",
    "CampaignError",
    "Choice",
    "Eventually",
    "Falsify",
    "Final",
    "FromCsv",
    "Grid",
    "Integer",
    "LatinHypercube",
    "Maximum",
    "Minimum",
    "Random",
    "Sobol",
    "TimeUntil",
    "Uniform",
]
