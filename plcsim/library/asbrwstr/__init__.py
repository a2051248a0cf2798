"""Library AsBrWStr: strings of 16-bit characters by their addresses."""

from plcsim.library.asbrwstr.interface import *  # noqa: F403  # its constants
