"""Campaigns: many runs of a project on the virtual clock, to find where it breaks.

A file defines a `Campaign`; ``plcsim campaign FILE`` runs it (docs/campaigns.md).
"""

from typing import TYPE_CHECKING

from plcsim.core.lazy import lazy_names

if TYPE_CHECKING:
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

__getattr__ = lazy_names(
    __name__,
    {
        "Always": "plcsim.campaign.requirements",
        "AtEnd": "plcsim.campaign.requirements",
        "Campaign": "plcsim.campaign.definition",
        "CampaignError": "plcsim.campaign.errors",
        "Choice": "plcsim.campaign.variables",
        "Eventually": "plcsim.campaign.requirements",
        "Falsify": "plcsim.campaign.search",
        "Final": "plcsim.campaign.measures",
        "FromCsv": "plcsim.campaign.sampling",
        "Grid": "plcsim.campaign.sampling",
        "Integer": "plcsim.campaign.variables",
        "LatinHypercube": "plcsim.campaign.sampling",
        "Maximum": "plcsim.campaign.measures",
        "Minimum": "plcsim.campaign.measures",
        "Random": "plcsim.campaign.sampling",
        "Sobol": "plcsim.campaign.sampling",
        "TimeUntil": "plcsim.campaign.measures",
        "Uniform": "plcsim.campaign.variables",
    },
)
