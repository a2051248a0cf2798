"""Library LoopConR: scaling, limiting and filtering of REAL, as far as the formulas are common.

Controllers and models of plants (LCRPID, LCRPT1, ...) are not there: what they calculate is known
to their vendor only.
"""

from plcsim.library.loopconr.interface import *  # noqa: F403  # its constants
from plcsim.library.loopconr.signals import LCRLimit as LCRLimit
from plcsim.library.loopconr.signals import LCRLimScal as LCRLimScal
from plcsim.library.loopconr.signals import LCRMovAvgFlt as LCRMovAvgFlt
from plcsim.library.loopconr.signals import LCRScal as LCRScal
