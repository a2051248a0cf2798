"""Library runtime: the statuses that all asynchronous function blocks of the controller share."""

from plcsim.library.runtime.interface import *  # noqa: F403  # its constants
