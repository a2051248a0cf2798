"""Library AsMath: mathematics of REAL."""

from plcsim.library.asmath.interface import *  # noqa: F403  # its constants
