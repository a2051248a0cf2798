"""Library FileIO: files and directories on file devices.

Each device is a folder of the host, which [library.FileIO] names; no path leads out of it. The
blocks are asynchronous: BUSY in the first call, done in the second, in the same cycle or a later
one. Dates of files are those of the controller, so a run on the virtual clock can be repeated.
"""

from plcsim.library.fileio.interface import *  # noqa: F403  # its types and constants
