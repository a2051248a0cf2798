"""Library AsSem: counting semaphores."""

from plcsim.library.assem.interface import *  # noqa: F403  # its constants
from plcsim.library.assem.semaphores import SemCreate as SemCreate
from plcsim.library.assem.semaphores import SemDelete as SemDelete
from plcsim.library.assem.semaphores import SemGetInfo as SemGetInfo
