"""Library AsArLog: logbooks as Automation Runtime had them before ArEventLog.

They are the logbooks of ArEventLog: what one library writes, the other finds by the same name.
"""

from plcsim.library.asarlog.interface import *  # noqa: F403  # its types and constants
