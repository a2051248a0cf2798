"""Library DataObj: named blocks of memory, which a restart of the controller forgets."""

from plcsim.library.dataobj.interface import *  # noqa: F403  # its constants
