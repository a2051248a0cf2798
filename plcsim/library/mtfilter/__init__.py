"""Library MTFilter: MTFilterMovingAverage; the design of the other filters is their vendor's."""

from plcsim.library.mtfilter.interface import *  # noqa: F403  # its types and constants
