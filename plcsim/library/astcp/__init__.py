"""Library AsTCP: TCP for programs, with the interface and the statuses of B&R's library.

``AsTCP.fun``, ``AsTCP.typ`` and ``AsTCP.var`` are the source of the interface. Where B&R's
behaviour is not known for certain, docs/decisions/0003-astcp-open-questions.md says what was
chosen; table [library.AsTCP] of plc.toml changes it.
"""

from plcsim.library.astcp.client import TcpClient as TcpClient
from plcsim.library.astcp.close import TcpClose as TcpClose
from plcsim.library.astcp.interface import *  # noqa: F403  # the constants and STRUCTs
from plcsim.library.astcp.ioctl import TcpIoctl as TcpIoctl
from plcsim.library.astcp.open import TcpOpen as TcpOpen
from plcsim.library.astcp.open import TcpOpenSsl as TcpOpenSsl
from plcsim.library.astcp.server import TcpServer as TcpServer
from plcsim.library.astcp.transfer import TcpRecv as TcpRecv
from plcsim.library.astcp.transfer import TcpSend as TcpSend
from plcsim.library.runtime import *  # noqa: F403  # all blocks have its statuses
