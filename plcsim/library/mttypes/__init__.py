"""Library MTTypes: types that the libraries of control share."""

from plcsim.library.mttypes.interface import *  # noqa: F403  # its types
