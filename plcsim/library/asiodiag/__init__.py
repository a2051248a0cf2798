"""Library AsIODiag: this controller is simulated, and no module is plugged into it."""

from plcsim.library.asiodiag.interface import *  # noqa: F403  # its constants
from plcsim.library.asiodiag.modules import DiagCreateInfo as DiagCreateInfo
from plcsim.library.asiodiag.modules import DiagDisposeInfo as DiagDisposeInfo
from plcsim.library.asiodiag.modules import DiagGetNumInfo as DiagGetNumInfo
from plcsim.library.asiodiag.modules import DiagGetStrInfo as DiagGetStrInfo
