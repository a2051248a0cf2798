"""Library astime: date and time of the controller, and conversions.

The controller's date runs with its clock: it stands still within a cycle, and on the virtual clock
it is the same in every run (``start_date`` in [plc], 2000-01-01 by default). Local time is UTC plus
``utc_offset`` of [library.astime]; there is no daylight saving time.
"""

from plcsim.library.astime.clock import DTExSetTime as DTExSetTime
from plcsim.library.astime.clock import DTSetTime as DTSetTime
from plcsim.library.astime.clock import DTStructureGetTime as DTStructureGetTime
from plcsim.library.astime.clock import DTStructureSetTime as DTStructureSetTime
from plcsim.library.astime.clock import UtcDTGetTime as UtcDTGetTime
from plcsim.library.astime.interface import *  # noqa: F403  # its types and constants
from plcsim.library.astime.interface import DTGetTime as DTGetTime
