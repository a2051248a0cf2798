"""Library AsUDP: UDP for programs, over the host's network or a virtual one.

As with AsTCP no call waits and every call gives a status. What is not there: multicast, time to
live and type of service; their ioctls give udpERR_INVALID_IOCTL.
"""

from plcsim.library.asudp.interface import *  # noqa: F403  # its types and constants
