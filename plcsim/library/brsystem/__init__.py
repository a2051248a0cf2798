"""Library brsystem: what programs ask of the system they run on.

A block that is declared and has no class here asks for what a simulated controller does not have:
permanent memory, modules of the hardware, a system configuration.
"""

from plcsim.library.brsystem.interface import *  # noqa: F403  # its constants
from plcsim.library.brsystem.memory import MEMInfo as MEMInfo
from plcsim.library.brsystem.memory import MEMxInfo as MEMxInfo
from plcsim.library.brsystem.system import BatteryInfo as BatteryInfo
from plcsim.library.brsystem.system import RTInfo as RTInfo
from plcsim.library.brsystem.system import SysInfo as SysInfo
from plcsim.library.brsystem.system import TARGETInfo as TARGETInfo
