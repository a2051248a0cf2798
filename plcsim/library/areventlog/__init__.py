"""Library ArEventLog: logbooks of events.

``$arlogusr`` is there from the start, others are made by ArEventLogCreate; ``$arlogsys`` is the
controller's own logbook, which can be read. What programs write stands in that one too, as a line.
"""

from plcsim.library.areventlog.interface import *  # noqa: F403  # its types and constants
