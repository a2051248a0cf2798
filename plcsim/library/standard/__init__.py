"""Library standard: timers, counters, edges and bistables of IEC 61131-3.

Member names, types and order are those of B&R's library (``standard.fun``), so that programs
written for the controller find what they call; behaviour is that of IEC 61131-3. Time comes from
the release of the task class only, so all timers of a cycle agree.
"""

from plcsim.library.standard.bistables import RS, SR
from plcsim.library.standard.counters import CTD, CTU, CTUD
from plcsim.library.standard.edges import F_TRIG, R_TRIG
from plcsim.library.standard.timers import TOF, TON, TP

__all__ = ["CTD", "CTU", "CTUD", "F_TRIG", "RS", "R_TRIG", "SR", "TOF", "TON", "TP"]
