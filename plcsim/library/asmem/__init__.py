"""Library AsMem: partitions of memory."""

from plcsim.library.asmem.interface import *  # noqa: F403  # its constants
from plcsim.library.asmem.partitions import AsMemPartAlloc as AsMemPartAlloc
from plcsim.library.asmem.partitions import AsMemPartAllocClear as AsMemPartAllocClear
from plcsim.library.asmem.partitions import AsMemPartCreate as AsMemPartCreate
from plcsim.library.asmem.partitions import AsMemPartDestroy as AsMemPartDestroy
from plcsim.library.asmem.partitions import AsMemPartFree as AsMemPartFree
from plcsim.library.asmem.partitions import AsMemPartInfo as AsMemPartInfo
from plcsim.library.asmem.partitions import AsMemPartRealloc as AsMemPartRealloc
