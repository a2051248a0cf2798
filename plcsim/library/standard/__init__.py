"""Library standard: timers, counters, edges and bistables of IEC 61131-3.

Member names, types and order are those of B&R's library (``standard.fun``), so that programs
written for the controller find what they call; behaviour is that of IEC 61131-3. Time comes from
the release of the task class only, so all timers of a cycle agree. The bodies are compiled and one
for all languages: ``plcsim/ansi_c/libc/src/iec_blocks.c``.
"""

from plcsim.library.standard.interface import CTD as CTD
from plcsim.library.standard.interface import CTU as CTU
from plcsim.library.standard.interface import CTUD as CTUD
from plcsim.library.standard.interface import F_TRIG as F_TRIG
from plcsim.library.standard.interface import R_TRIG as R_TRIG
from plcsim.library.standard.interface import RF_TRIG as RF_TRIG
from plcsim.library.standard.interface import RS as RS
from plcsim.library.standard.interface import SEMA as SEMA
from plcsim.library.standard.interface import SR as SR
from plcsim.library.standard.interface import TOF as TOF
from plcsim.library.standard.interface import TON as TON
from plcsim.library.standard.interface import TP as TP
from plcsim.library.standard.interface import TOF_10ms as TOF_10ms
from plcsim.library.standard.interface import TON_10ms as TON_10ms
from plcsim.library.standard.interface import TP_10ms as TP_10ms
