"""Library AsBrMath: mathematics of REAL."""

from plcsim.library.asbrmath.interface import *  # noqa: F403  # its constants
