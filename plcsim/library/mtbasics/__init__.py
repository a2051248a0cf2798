"""Library MTBasics: blocks of control, as far as their formulas are common.

MTBasicsPID, MTBasicsPT1, MTBasicsLimiter, MTBasicsTimeDelay and MTBasicsPWM are there; each says
what it calculates. The step is the cycle time of the task class that calls. Tuning, transfer
functions and the rest are not there: what they calculate is known to their vendor only.
"""

from plcsim.library.mtbasics.interface import *  # noqa: F403  # its types and constants
